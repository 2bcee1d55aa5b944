#include "core/planning/legs/grid_leg.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/planning/room/disc_distances.hpp"
#include "tests/core/planning/floor_world.hpp"
#include "tests/core/planning/leg_world.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Polygon;
using geometry::Pose2;
using kinematics::Segment;
using plant::MotionMode;

constexpr double kClearance_m = 0.2;
constexpr double kRounding_m = 1e-6;

/// Least distance of the driving body to walls, obstacles and `more`, by fine simulation.
double least_clearance_m(const plant::Plant& plant, const plant::VehicleType& type,
                         const LegPlan& plan, const std::vector<Polygon>& more = {}) {
    std::vector<Polygon> solid = more;
    for (const auto& area : plant.areas) solid.push_back(area.outline);
    const auto& hall = plant.halls.front().outline;
    for (std::size_t k = 0; k < hall.size(); ++k) {
        solid.push_back({hall[k], hall[(k + 1) % hall.size()]});
    }
    double least_m = 1e9;
    for (const Segment& segment : plan.segments) {
        const int steps = 2 + static_cast<int>(std::abs(segment.length_m) / 0.05) +
                          static_cast<int>(std::abs(segment.turn_rad) / 0.02);
        for (int i = 0; i <= steps; ++i) {
            const double share = static_cast<double>(i) / steps;
            const auto body =
                geometry::transformed(kinematics::pose_at(segment, share), type.footprint);
            for (const auto& outline : solid) {
                least_m = std::min(least_m, geometry::distance(body, outline));
            }
        }
    }
    return least_m;
}

void expect_joined(const LegPlan& plan, const Pose2& from, const Pose2& to) {
    Pose2 pose = from;
    for (const Segment& segment : plan.segments) {
        EXPECT_LT(geometry::distance(segment.start.position(), pose.position()), 1e-9);
        EXPECT_LT(std::abs(wrap(segment.start.heading_rad - pose.heading_rad)), 1e-9);
        pose = segment.end;
    }
    EXPECT_LT(geometry::distance(pose.position(), to.position()), 1e-9);
    EXPECT_LT(std::abs(wrap(pose.heading_rad - to.heading_rad)), 1e-9);
}

/// A wall across the hall at x = 20 with a gap of 4 m at its upper end.
FloorWorld with_gap() {
    FloorWorld world;
    world.box("wall", 19.5, 0, 20.5, 26);
    world.station(1, {34, 6, 0});
    return world;
}
const Pose2 kWestOfWall{6, 6, 0};

/// Rectangles strewn over the hall, none near the station or the first place.
FloorWorld strewn(std::uint32_t seed) {
    FloorWorld world;
    world.station(1, {35, 25, 0.4});
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(2, 36);
    std::uniform_real_distribution<double> y(2, 26);
    std::uniform_real_distribution<double> size(0.5, 4);
    for (int i = 0; i < 14; ++i) {
        const Point2 at{x(random), y(random)};
        const double wide_m = size(random);
        const double high_m = size(random);
        const bool at_end = at.x_m < 8 && at.y_m < 8;
        if (at_end || (at.x_m + wide_m > 31 && at.y_m + high_m > 21)) continue;
        world.box("box" + std::to_string(i), at.x_m, at.y_m, at.x_m + wide_m, at.y_m + high_m);
    }
    return world;
}
const Pose2 kInTheCorner{3.37, 3.11, 0.83};

TEST(GridLeg, GoesRoundWhatIsInTheWayWhereNoLaneLeads) {
    FloorWorld world = with_gap();
    const LegPlanner planner(world.plant());
    for (const char* type : {"measuring", "tug"}) {
        auto request = world.request(type, kWestOfWall, 1);

        const auto plan = planner.plan_leg(request);

        ASSERT_TRUE(plan) << plan.error().what;
        EXPECT_EQ(plan->mode, MotionMode::kLinear) << "and no free manoeuvre";
        EXPECT_TRUE(plan->route.empty());
        expect_joined(*plan, kWestOfWall, {34, 6, 0});
        EXPECT_GE(least_clearance_m(world.plant(), *request.type, *plan),
                  kClearance_m - kRounding_m);
        request.mode = MotionMode::kLinear;
        EXPECT_EQ(planner.plan_leg(request)->segments, plan->segments);
    }
}

TEST(GridLeg, HasNoNeedlessCorners) {
    FloorWorld world = with_gap();
    const LegPlanner planner(world.plant());

    const auto plan = planner.plan_leg(world.request("measuring", kWestOfWall, 1));

    ASSERT_TRUE(plan) << plan.error().what;
    const auto straights =
        std::ranges::count(plan->segments, Segment::Kind::kStraight, &Segment::kind);
    EXPECT_LE(straights, 3);
    EXPECT_LE(plan->turns, 3);
    // Along the taut line over both corners of the wall's end, the body's width farther out.
    EXPECT_LT(plan->length_m, 1.1 * (2 * std::hypot(13.5, 21) + 1));
}

TEST(GridLeg, TurnsNothingThatNeedNotTurn) {
    FloorWorld world = with_gap();
    const LegPlanner planner(world.plant());
    const auto turned_rad = [&](const char* type) {
        const auto plan = planner.plan_leg(world.request(type, kWestOfWall, 1));
        double sum_rad = 0;
        for (const auto& segment : plan.value().segments) sum_rad += std::abs(segment.turn_rad);
        return sum_rad;
    };

    EXPECT_LT(turned_rad("measuring"), 1e-9) << "it keeps its heading and drives sideways";
    EXPECT_GT(turned_rad("tug"), 1) << "which drives ahead and back only";
}

TEST(GridLeg, KeepsClearOnEverySegmentOfStrewnFloors) {
    int found = 0;
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
        FloorWorld world = strewn(seed);
        const LegPlanner planner(world.plant());
        for (const char* type : {"measuring", "tug"}) {
            auto request = world.request(type, kInTheCorner, 1);
            request.mode = MotionMode::kLinear;
            const auto plan = planner.plan_leg(request);
            if (!plan) continue;
            ++found;
            expect_joined(*plan, kInTheCorner, {35, 25, 0.4});
            EXPECT_GE(least_clearance_m(world.plant(), *request.type, *plan),
                      kClearance_m - kRounding_m)
                << "seed " << seed;
            if (std::string(type) == "measuring") continue;
            for (const Segment& segment : plan->segments) {
                const double off = std::abs(wrap(2 * segment.direction_rad));
                EXPECT_TRUE(segment.kind != Segment::Kind::kStraight || off < 1e-9);
            }
        }
    }
    EXPECT_GE(found, 76) << "of 80";
}

/// The search knows four directions, so its way may lead past the other side of something: up to
/// the root of two longer than the shortest, before it is smoothed.
TEST(GridLeg, IsNeverMuchLongerThanTheShortestWay) {
    constexpr double kLonger = 1.42;
    constexpr double kMore_m = 1.0;
    double longest = 0;
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
        FloorWorld world = strewn(seed);
        const LegPlanner planner(world.plant());
        for (const char* type : {"measuring", "tug"}) {
            auto request = world.request(type, kInTheCorner, 1);
            request.mode = MotionMode::kLinear;
            const auto plan = planner.plan_leg(request);
            if (!plan) continue;
            // Wherever the circle around the body goes the body does.
            const FloorField field(world.plant(), world.plant().halls.front(), 3);
            const double reach_m = plant::reach_m({request.type->footprint});
            const DiscDistances ways(field, reach_m + kClearance_m, {35, 25});
            const double shortest_m = ways.from(kInTheCorner.position());
            if (!std::isfinite(shortest_m)) continue;
            EXPECT_LE(plan->length_m, kLonger * shortest_m + kMore_m) << "seed " << seed;
            longest = std::max(longest, plan->length_m / shortest_m);
        }
    }
    RecordProperty("longest", std::to_string(longest));
}

TEST(GridLeg, LeadsRoundClosedFloorAndBackAgain) {
    FloorWorld world;
    world.box("wall", 19.5, 6, 20.5, 24);
    world.station(1, {34, 14, 0});
    LegPlanner planner(world.plant());
    const auto request = world.request("measuring", {6, 14, 0}, 1);
    const auto open = planner.plan_leg(request);
    ASSERT_TRUE(open) << open.error().what;
    const bool north = std::ranges::any_of(
        open->segments, [](const Segment& segment) { return segment.end.y_m > 24; });
    const Polygon closed = north ? Polygon{{18, 24}, {22, 24}, {22, 30}, {18, 30}}
                                 : Polygon{{18, 0}, {22, 0}, {22, 6}, {18, 6}};

    planner.set_closures({{"c", "c", plant::HallId("hall"), {closed}, 0.1}});
    const auto round = planner.plan_leg(request);
    planner.set_closures({});
    const auto again = planner.plan_leg(request);

    ASSERT_TRUE(round) << round.error().what;
    EXPECT_TRUE(round->closures.empty());
    EXPECT_GE(least_clearance_m(world.plant(), *request.type, *round, {closed}), 0.1);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->segments, open->segments);
}

TEST(GridLeg, LeadsOverClosedFloorWhereThereIsNoWayRoundAndSaysSo) {
    FloorWorld world = with_gap();
    LegPlanner planner(world.plant());
    planner.set_closures(
        {{"c", "c", plant::HallId("hall"), {{{19, 25}, {21, 25}, {21, 30}, {19, 30}}}, 0.1}});

    const auto plan = planner.plan_leg(world.request("measuring", kWestOfWall, 1));

    ASSERT_TRUE(plan) << plan.error().what;
    EXPECT_EQ(plan->closures, std::vector<std::string>{"c"});
}

TEST(GridLeg, TakesTheFloorWhereClosedFloorBarsAStraightWayButKeepsToLanes) {
    FloorWorld world;
    world.station(1, {34, 14, 0});
    LegPlanner on_floor(world.plant());
    on_floor.set_closures(
        {{"c", "c", plant::HallId("hall"), {{{18, 10}, {22, 10}, {22, 18}, {18, 18}}}, 0.1}});
    LegWorld lanes(24);
    LegPlanner on_lanes(lanes.plant());
    on_lanes.set_closures(
        {{"c", "c", plant::HallId("hall"), {{{40, 29}, {44, 29}, {44, 31}, {40, 31}}}, 0.1}});

    const auto round = on_floor.plan_leg(world.request("measuring", {6, 14, 0}, 1));
    const auto waits = on_lanes.plan_leg(lanes.request("tug", 1, 2));

    ASSERT_TRUE(round) << round.error().what;
    EXPECT_TRUE(round->closures.empty());
    EXPECT_EQ(round->mode, MotionMode::kLinear);
    ASSERT_TRUE(waits) << waits.error().what;
    EXPECT_FALSE(waits->route.empty());
    EXPECT_EQ(waits->closures, std::vector<std::string>{"c"});
}

TEST(GridLeg, LeavesLanesOnlyWhereNoneLeadsThere) {
    LegWorld world(24);
    const auto on_lanes = LegPlanner(world.plant()).plan_leg(world.request("tug", 1, 2));
    auto& edges = world.plant().edges;
    std::erase_if(edges, [](const auto& edge) { return edge.id.str() == "b-c"; });
    const LegPlanner planner(world.plant());

    const auto over_floor = planner.plan_leg(world.request("tug", 1, 2));
    const auto lane_bound = planner.plan_leg(world.request("platform", 1, 2));

    ASSERT_TRUE(on_lanes) << on_lanes.error().what;
    EXPECT_FALSE(on_lanes->route.empty());
    ASSERT_TRUE(over_floor) << over_floor.error().what;
    EXPECT_TRUE(over_floor->route.empty());
    EXPECT_EQ(over_floor->mode, MotionMode::kLinear);
    ASSERT_FALSE(lane_bound) << "its type lists no free manoeuvres";
    EXPECT_EQ(lane_bound.error().reason.code, "no_route");
}

TEST(GridLeg, SaysThatTheFloorIsCutOff) {
    FloorWorld world;
    world.box("wall", 19.5, 0, 20.5, 30);
    world.station(1, {34, 6, 0});
    const LegPlanner planner(world.plant());
    auto request = world.request("measuring", kWestOfWall, 1);
    request.mode = MotionMode::kLinear;

    const auto plan = planner.plan_leg(request);

    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().code, Errc::kUnreachable);
    EXPECT_EQ(plan.error().reason.code, "no_floor_way");
    const auto& params = plan.error().reason.params;
    const auto by = std::ranges::find(params, "blocked_by", &Param::name);
    ASSERT_NE(by, params.end());
    EXPECT_EQ(std::get<std::string>(by->value), "obstacles");
}

TEST(GridLeg, IsTheSameWhateverWasPlannedBefore) {
    FloorWorld world = strewn(7);
    world.station(2, {20, 3, 1});
    LegPlanner busy(world.plant());
    busy.set_closures(
        {{"c", "c", plant::HallId("hall"), {{{18, 10}, {22, 10}, {22, 18}, {18, 18}}}, 0.1}});
    (void)busy.plan_leg(world.request("measuring", {35, 25, 0.4}, 2));
    busy.set_closures({});
    const LegPlanner fresh(world.plant());
    const LegPlanner other = busy.again();
    auto request = world.request("measuring", kInTheCorner, 1);
    request.mode = MotionMode::kLinear;

    const auto first = fresh.plan_leg(request);

    ASSERT_TRUE(first) << first.error().what;
    EXPECT_EQ(busy.plan_leg(request)->segments, first->segments);
    EXPECT_EQ(other.plan_leg(request)->segments, first->segments);
    EXPECT_EQ(fresh.plan_leg(request)->segments, first->segments);
}

TEST(GridLeg, BeginsAnywhereOnACell) {
    FloorWorld world = with_gap();
    const LegPlanner planner(world.plant());
    std::mt19937 random(3);
    std::uniform_real_distribution<double> off(-0.4, 0.4);
    std::uniform_real_distribution<double> heading(-kPi, kPi);
    for (int i = 0; i < 20; ++i) {
        const Pose2 from{6 + off(random), 6 + off(random), heading(random)};
        for (const char* type : {"measuring", "tug"}) {
            const auto plan = planner.plan_leg(world.request(type, from, 1));
            ASSERT_TRUE(plan) << plan.error().what;
            expect_joined(*plan, from, {34, 6, 0});
        }
    }
}

TEST(GridLeg, LeavesAPlaceWhereItCannotTurnAndEndsAtOne) {
    FloorWorld world;
    world.box("wall", 19.5, 4, 20.5, 30);
    // Bays of 1.9 m: a body of 1.4 m keeps 0.25 m to both sides.
    world.box("west bay", 2, 26, 4.05, 30);
    world.box("west bay too", 5.95, 26, 8, 30);
    world.box("east bay", 32, 26, 34.05, 30);
    world.box("east bay too", 35.95, 26, 38, 30);
    world.station(1, {35, 28.5, kPi / 2});
    const LegPlanner planner(world.plant());
    for (const double heading : {kPi / 2, -kPi / 2}) {
        const Pose2 from{5, 28.5, heading};
        const auto request = world.request("measuring", from, 1);

        const auto plan = planner.plan_leg(request);

        ASSERT_TRUE(plan) << plan.error().what;
        EXPECT_EQ(plan->mode, MotionMode::kLinear);
        expect_joined(*plan, from, {35, 28.5, kPi / 2});
        EXPECT_GE(least_clearance_m(world.plant(), *request.type, *plan),
                  kClearance_m - kRounding_m);
    }
}

TEST(GridLeg, EndsAsNearToAWallAsTheBodyMayStand) {
    FloorWorld world = with_gap();
    // 5 mm more than the clearance: less than the fast tests of the search allow.
    world.station(2, {34, 0.7 + kClearance_m + 0.005, 0});
    const LegPlanner planner(world.plant());
    const Pose2 from{6, 0.7 + kClearance_m + 0.005, 0};
    const auto request = world.request("measuring", from, 2);

    const auto plan = planner.plan_leg(request);

    ASSERT_TRUE(plan) << plan.error().what;
    EXPECT_EQ(plan->mode, MotionMode::kLinear);
    expect_joined(*plan, from, {34, 0.905, 0});
    EXPECT_GE(least_clearance_m(world.plant(), *request.type, *plan), kClearance_m - kRounding_m);
}

TEST(GridLeg, LeadsThroughAHugeHall) {
    FloorWorld world(600, 400);
    for (int i = 1; i < 6; ++i) {
        const double low_m = i % 2 == 0 ? 0 : 20;
        world.box("wall" + std::to_string(i), 100.0 * i, low_m, 100.0 * i + 1, low_m + 380);
    }
    world.station(1, {590, 200, 0});
    const LegPlanner planner(world.plant());
    const Pose2 from{10, 200, 0};
    const auto request = world.request("measuring", from, 1);

    const auto plan = planner.plan_leg(request);

    ASSERT_TRUE(plan) << plan.error().what;
    expect_joined(*plan, from, {590, 200, 0});
    EXPECT_GE(least_clearance_m(world.plant(), *request.type, *plan), kClearance_m - kRounding_m);
}

TEST(GridLeg, IsShownAmongTheModesWithItsFloor) {
    FloorWorld world = with_gap();
    const LegPlanner planner(world.plant());
    const auto request = world.request("measuring", kWestOfWall, 1);

    const auto options = planner.assess_modes(request, {});

    const auto linear = std::ranges::find(options, MotionMode::kLinear, &ModeOption::mode);
    ASSERT_NE(linear, options.end());
    ASSERT_TRUE(linear->plan) << linear->plan.error().what;
    EXPECT_TRUE(linear->suggested);
    EXPECT_EQ(linear->plan->segments, planner.plan_leg(request)->segments);
    EXPECT_GT(linear->plan->swept_area_m2, 0);
    EXPECT_GE(linear->plan->clearance_m, kClearance_m - kRounding_m);
}

}  // namespace
}  // namespace pulseline::planning
