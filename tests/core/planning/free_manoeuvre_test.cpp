#include "core/planning/manoeuvre/free_manoeuvre.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/planning/manoeuvre/manoeuvre_sampling.hpp"

namespace pulseline::planning {
namespace {

using geometry::Polygon;
using geometry::Pose2;
using kinematics::Segment;
using plant::MotionMode;

plant::VehicleType vehicle(const char* id, Polygon footprint, double radius_m, double clearance_m,
                           std::vector<MotionMode> modes) {
    plant::VehicleType type;
    type.id = plant::VehicleTypeId(id);
    type.name = id;
    type.footprint = std::move(footprint);
    type.min_turn_radius_m = radius_m;
    type.clearance_m = clearance_m;
    type.motion_modes = std::move(modes);
    return type;
}

/// 60 m x 30 m: a wall at x = 30 with a gap of 5 m, a box open to the east about (50, 7), a pillar;
/// a platform that only steers, a differential and a Mecanum vehicle.
struct World {
    plant::Plant plant;

    World() {
        plant::Hall hall;
        hall.id = plant::HallId("hall");
        hall.outline = {{0, 0}, {60, 0}, {60, 30}, {0, 30}};
        plant.halls.push_back(hall);
        area("south", {{29, 0}, {31, 0}, {31, 12}, {29, 12}});
        area("north", {{29, 17}, {31, 17}, {31, 30}, {29, 30}});
        area("pillar", {{12, 14}, {13, 14}, {13, 15}, {12, 15}});
        plant.vehicle_types = {
            vehicle("platform", geometry::rectangle(6, 2), 4, 0.5, {MotionMode::kFree}),
            vehicle("differential", geometry::rectangle(1.6, 1.1), 0, 0.2,
                    {MotionMode::kSelfRotation, MotionMode::kLinear, MotionMode::kFree}),
            vehicle("mecanum", geometry::rectangle(3.2, 2.1), 0, 0.2,
                    {MotionMode::kLateral, MotionMode::kFree})};
        plant.vehicle_types[1].kinematics = plant::Kinematics::kDifferential;
        plant.vehicle_types[2].kinematics = plant::Kinematics::kMecanum;
    }
    void area(const char* id, Polygon outline) {
        plant.areas.push_back({plant::AreaId(id),
                               plant::AreaKind::kObstacle,
                               id,
                               plant.halls.front().id,
                               std::move(outline),
                               {}});
    }
    FreeFloor floor() const { return {plant, plant.halls.front()}; }
    FreeManoeuvreRequest request(std::size_t type, const Pose2& start, const Pose2& goal) const {
        FreeManoeuvreRequest request;
        request.type = &plant.vehicle_types[type];
        request.start = start;
        request.goal = goal;
        return request;
    }
};

StandingBody parked(const char* id, const Pose2& pose) {
    return {plant::VehicleId(id), {geometry::transformed(pose, geometry::rectangle(6, 2))}};
}

double param(const Error& error, const std::string& name) {
    for (const Param& one : error.reason.params) {
        if (one.name == name) return std::get<double>(one.value);
    }
    ADD_FAILURE() << "no " << name;
    return 0;
}

std::string by(const Error& error) {
    for (const Param& one : error.reason.params) {
        if (one.name == "by") return std::get<std::string>(one.value);
    }
    return "";
}

void expect_chain(const FreeManoeuvreRequest& request, const std::vector<Segment>& segments) {
    ASSERT_FALSE(segments.empty());
    EXPECT_EQ(segments.front().start, request.start);
    EXPECT_NEAR(segments.back().end.x_m, request.goal.x_m, 1e-9);
    EXPECT_NEAR(segments.back().end.y_m, request.goal.y_m, 1e-9);
    EXPECT_NEAR(wrap(segments.back().end.heading_rad - request.goal.heading_rad), 0, 1e-9);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const Segment& segment = segments[i];
        EXPECT_EQ(segment.start, i > 0 ? segments[i - 1].end : request.start);
        // What is said of the way leads to what is said of its end.
        const Pose2 almost = kinematics::pose_at(segment, 1 - 1e-9);
        EXPECT_LT(geometry::distance(almost.position(), segment.end.position()), 1e-6);
        EXPECT_LT(std::abs(wrap(almost.heading_rad - segment.end.heading_rad)), 1e-6);
        EXPECT_GT(segment.duration_s, 0);
    }
}

void expect_drivable(const plant::VehicleType& type, const std::vector<Segment>& segments) {
    const bool spot = type.min_turn_radius_m == 0;
    for (const Segment& segment : segments) {
        if (segment.kind == Segment::Kind::kRotate) {
            EXPECT_TRUE(spot);
        } else if (segment.kind == Segment::Kind::kArc) {
            const double radius = geometry::distance(segment.start.position(), segment.centre);
            EXPECT_GE(radius, type.min_turn_radius_m - 1e-9);
            EXPECT_NEAR(std::abs(segment.length_m), radius * std::abs(segment.turn_rad), 1e-9);
            EXPECT_LE(std::abs(segment.turn_rad), kPi / 2 + 1e-9);
            // The heading is tangential and turns the way the centre lies.
            const auto centre = inverse(segment.start) * segment.centre;
            EXPECT_NEAR(centre.x_m, 0, 1e-9);
            EXPECT_EQ(segment.turn_rad > 0, (centre.y_m > 0) == (segment.length_m > 0));
        } else if (type.kinematics != plant::Kinematics::kMecanum) {
            EXPECT_TRUE(segment.direction_rad == 0 ||
                        std::abs(std::abs(segment.direction_rad) - kPi) < 1e-9);
        }
    }
}

/// Room at a pose to begin and end in: there is always a way then.
bool has_room(const World& world, const FreeManoeuvreRequest& request, const Pose2& pose) {
    const Obstacles obstacles(world.plant, world.plant.halls.front());
    const Polygon body = geometry::transformed(pose, request.type->footprint);
    const double room_m = request.type->clearance_m + 0.8;
    return obstacles.keeps({body}, obstacles.limits(room_m)) &&
           std::all_of(request.standing.begin(), request.standing.end(),
                       [&](const StandingBody& other) {
                           return geometry::distance(body, other.outline.front()) >= room_m;
                       });
}

/// The body at places 5 cm apart keeps its clearance, by the exact distances of polygons.
void expect_clear(const World& world, const FreeManoeuvreRequest& request,
                  const std::vector<Segment>& segments) {
    const Obstacles obstacles(world.plant, world.plant.halls.front());
    const double clearance_m = request.type->clearance_m;
    const auto limits = obstacles.limits(clearance_m);
    for (const Segment& segment : segments) {
        const double way = std::abs(segment.length_m) + 6 * std::abs(segment.turn_rad);
        const int steps = 1 + static_cast<int>(way / 0.05);
        for (int i = 0; i <= steps; ++i) {
            const Polygon body = geometry::transformed(
                kinematics::pose_at(segment, double(i) / steps), request.type->footprint);
            ASSERT_TRUE(obstacles.keeps({body}, limits));
            for (const StandingBody& other : request.standing) {
                ASSERT_GE(geometry::distance(body, other.outline.front()), clearance_m - 1e-9);
            }
        }
    }
}

TEST(FreeManoeuvre, IsAnExactDrivableAndClearWay) {
    const World world;
    const FreeFloor floor = world.floor();
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> x(0, 60);
    std::uniform_real_distribution<double> y(0, 30);
    std::uniform_real_distribution<double> turn(-kPi, kPi);
    const std::vector<StandingBody> standing{parked("P1", {40, 22, 0.6}), parked("P2", {20, 6, 2})};
    for (std::size_t type = 0; type < 3; ++type) {
        int planned = 0;
        for (int i = 0; planned < 25; ++i) {
            ASSERT_LT(i, 400);
            auto request = world.request(type, {x(random), y(random), turn(random)},
                                         {x(random), y(random), turn(random)});
            request.standing = standing;
            if (!has_room(world, request, request.start) ||
                !has_room(world, request, request.goal)) {
                continue;
            }
            const auto found = plan_free_manoeuvre(floor, request);
            ASSERT_TRUE(found) << found.error().what << " at " << i << " of type " << type;
            ++planned;
            EXPECT_EQ(found->motion.mode, MotionMode::kFree);
            expect_chain(request, found->motion.segments);
            expect_drivable(*request.type, found->motion.segments);
            expect_clear(world, request, found->motion.segments);
        }
    }
}

TEST(FreeManoeuvre, DependsOnNothingButTheRequest) {
    const World world;
    const FreeFloor floor = world.floor();
    const auto request = world.request(0, {8, 6, 2.5}, {50, 24, -1});
    const auto first = plan_free_manoeuvre(floor, request);
    ASSERT_TRUE(first);

    for (int i = 0; i < 5; ++i) {
        ASSERT_TRUE(plan_free_manoeuvre(floor, world.request(0, {50, 8, i * 0.5}, {8, 24, 1})));
    }
    const auto again = plan_free_manoeuvre(world.floor(), request);

    ASSERT_TRUE(again);
    EXPECT_EQ(again->motion.segments, first->motion.segments);
    EXPECT_EQ(again->tests, first->tests);
}

TEST(FreeManoeuvre, GoesStraightWhereThatIsFree) {
    const World world;
    const auto found =
        plan_free_manoeuvre(world.floor(), world.request(0, {5, 25, 0}, {20, 25, 0}));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->found, FreeManoeuvre::Found::kDirectly);
    ASSERT_EQ(found->motion.segments.size(), 1u);
    EXPECT_NEAR(found->motion.length_m, 15, 1e-9);
}

TEST(FreeManoeuvre, AMecanumVehicleMovesSidewaysIntoItsPlace) {
    const World world;
    const auto found =
        plan_free_manoeuvre(world.floor(), world.request(2, {45, 10, 0}, {45, 16, 0}));
    ASSERT_TRUE(found);
    ASSERT_EQ(found->motion.segments.size(), 1u);
    EXPECT_NEAR(found->motion.segments.front().direction_rad, kPi / 2, 1e-9);
}

TEST(FreeManoeuvre, NamesWhatBlocksTheStartAndTheGoal) {
    const World world;
    const FreeFloor floor = world.floor();

    auto request = world.request(0, {10, 10, 0}, {50, 20, 0});
    request.standing = {parked("P7", {50, 21, 0.5})};
    const auto goal = plan_free_manoeuvre(floor, request);
    ASSERT_FALSE(goal);
    EXPECT_EQ(goal.error().reason.code, "goal_blocked");
    EXPECT_EQ(by(goal.error()), "P7");
    EXPECT_EQ(param(goal.error(), "clearance_m"), 0);
    EXPECT_EQ(param(goal.error(), "limit_m"), 0.5);
    EXPECT_NEAR(param(goal.error(), "at_x_m"), 50, 1e-9);

    const auto start = plan_free_manoeuvre(floor, world.request(0, {12, 13.05, 0}, {50, 20, 0}));
    ASSERT_FALSE(start);
    EXPECT_EQ(start.error().reason.code, "start_blocked");
    EXPECT_EQ(by(start.error()), "pillar");

    const auto wall = plan_free_manoeuvre(floor, world.request(0, {10, 10, 0}, {50, 28.9, 0}));
    ASSERT_FALSE(wall);
    EXPECT_EQ(wall.error().reason.code, "goal_blocked");
    EXPECT_EQ(by(wall.error()), "wall");
    EXPECT_NEAR(param(wall.error(), "clearance_m"), 0.1, 1e-9);

    const auto there = plan_free_manoeuvre(floor, world.request(0, {10, 10, 0}, {10, 10, 0}));
    ASSERT_FALSE(there);
    EXPECT_EQ(there.error().reason.code, "already_there");
}

TEST(FreeManoeuvre, LeavesAStartThatIsNearerThanTheClearance) {
    const World world;
    auto request = world.request(0, {10, 5, 0}, {20, 20, 1});
    request.standing = {parked("P1", {3.6, 5, 0})};  // 0.4 m behind it, not 0.5
    const auto found = plan_free_manoeuvre(world.floor(), request);
    ASSERT_TRUE(found);
    expect_chain(request, found->motion.segments);
    expect_drivable(*request.type, found->motion.segments);
}

TEST(FreeManoeuvre, SaysSoWhenTheGoalIsEnclosed) {
    World world;
    world.area("door", {{29, 11.9}, {31, 11.9}, {31, 17.1}, {29, 17.1}});
    const auto found =
        plan_free_manoeuvre(world.floor(), world.request(0, {10, 20, 0}, {50, 20, 0}));
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().reason.code, "no_free_way");
    EXPECT_TRUE(std::get<bool>(found.error().reason.params.front().value));
    EXPECT_FALSE(found.error().what.empty());
}

TEST(FreeManoeuvre, GivesUpWithinItsWork) {
    // A slot that the body's inner disc gets into, but not the body round the corner before it:
    // nothing proves that there is no way, so the search has to end by its limit.
    World world;
    world.area("left", {{44, 4}, {46, 4}, {46, 13}, {44, 13}});
    world.area("right", {{49.4, 4}, {51.4, 4}, {51.4, 13}, {49.4, 13}});
    world.area("top", {{44, 11.8}, {51.4, 11.8}, {51.4, 13}, {44, 13}});
    auto request = world.request(0, {10, 20, 0}, {47.7, 8, kPi / 2});
    request.time_limit_s = 0.05;
    const auto found = plan_free_manoeuvre(world.floor(), request);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().reason.code, "no_free_way");
    EXPECT_FALSE(std::get<bool>(found.error().reason.params.front().value));
    EXPECT_EQ(param(found.error(), "time_limit_s"), 0.05);
}

TEST(FreeManoeuvre, EndsAlsoWhereAStandingBodyLeavesTheGoalJustItsClearance) {
    World world;
    world.area("left", {{44, 4}, {46, 4}, {46, 13}, {44, 13}});
    world.area("right", {{49.4, 4}, {51.4, 4}, {51.4, 13}, {49.4, 13}});
    world.area("top", {{44, 11.8}, {51.4, 11.8}, {51.4, 13}, {44, 13}});
    auto request = world.request(0, {10, 20, 0}, {47.7, 8, kPi / 2});
    // The exact distance at the goal is 0.513 m: enough, but not to the lattice of the field.
    request.standing = {
        {plant::VehicleId("P1"), {{{46, 7}, {46.187, 7}, {46.187, 7.5}, {46, 7.5}}}}};
    request.time_limit_s = 0.05;
    const auto found = plan_free_manoeuvre(world.floor(), request);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().reason.code, "no_free_way");
}

TEST(FreeManoeuvre, RefusesAClearanceLargerThanTheFloorWasBuiltFor) {
    const World world;
    auto type = world.plant.vehicle_types.front();
    type.clearance_m = 4;
    auto request = world.request(0, {10, 10, 0}, {20, 20, 0});
    request.type = &type;
    const auto found = plan_free_manoeuvre(world.floor(), request);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().reason.code, "clearance_too_large");
}

TEST(SamplingSearch, FindsAWayByEachPlannerAndTheSameOneAgain) {
    const World world;
    const FreeFloor floor = world.floor();
    const plant::VehicleType& type = world.plant.vehicle_types.front();
    const Steering steering(type);
    const Pose2 start{8, 6, 2.5};
    const Pose2 goal{50, 24, -1};
    for (const auto planner : {SamplingPlanner::kRrtConnect, SamplingPlanner::kBiEst}) {
        std::vector<Moves> answers;
        for (const std::uint64_t seed : {5u, 6u, 5u}) {
            const ManoeuvreRoom room(
                {floor.obstacles, floor.field, floor.bodies[0].body, floor.bodies[0].check}, {},
                start, goal);
            answers.push_back(
                sampling_search({steering, room, start, goal}, planner, seed, 2'000'000));
            ASSERT_FALSE(answers.back().empty());
            const auto segments = segments_of(start, answers.back(), goal);
            EXPECT_FALSE(room.conflict_along(segments));
        }
        const auto same = [](const Moves& a, const Moves& b) {
            return std::equal(
                a.begin(), a.end(), b.begin(), b.end(), [](const Move& m, const Move& n) {
                    return m.kind == n.kind && m.amount == n.amount && m.curvature == n.curvature;
                });
        };
        EXPECT_TRUE(same(answers[0], answers[2]));
        EXPECT_FALSE(same(answers[0], answers[1]));
    }
}

}  // namespace
}  // namespace pulseline::planning
