#include "core/planning/legs/leg_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/core/planning/leg_world.hpp"

namespace pulseline::planning {
namespace {

using geometry::Polygon;
using geometry::Pose2;
using kinematics::Segment;
using plant::MotionMode;

template <class T>
T value(const Error& error, const std::string& name) {
    for (const Param& param : error.reason.params) {
        if (param.name == name) return std::get<T>(param.value);
    }
    ADD_FAILURE() << "no parameter " << name << " in " << error.reason.code;
    return {};
}

const ModeOption& option(const std::vector<ModeOption>& options, MotionMode mode) {
    return *std::find_if(options.begin(), options.end(),
                         [&](const ModeOption& o) { return o.mode == mode; });
}

/// Least distance of the moving body to the plant's obstacles and walls, by fine simulation.
double simulated_clearance(const plant::Plant& plant, const plant::VehicleType& type,
                           const std::vector<Segment>& segments) {
    double least = 1e9;
    for (const Segment& segment : segments) {
        for (int i = 0; i <= 60; ++i) {
            const auto body =
                geometry::transformed(kinematics::pose_at(segment, i / 60.0), type.footprint);
            for (const auto& area : plant.areas) {
                if (area.kind == plant::AreaKind::kZone) continue;
                least = std::min(least, geometry::distance(body, area.outline));
            }
            const auto& hall = plant.halls.front().outline;
            for (std::size_t k = 0; k < hall.size(); ++k) {
                least = std::min(least,
                                 geometry::distance(body, {hall[k], hall[(k + 1) % hall.size()]}));
            }
        }
    }
    return least;
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

TEST(LegPlanner, DrivesStraightWhenTheWayIsFree) {
    LegWorld world(8);
    const LegPlanner planner(world.plant());

    const auto options = planner.assess_modes(world.request("platform", 1, 3), {});

    ASSERT_EQ(options.size(), 3u);
    EXPECT_EQ(options[0].mode, MotionMode::kLinear);
    EXPECT_EQ(options[1].mode, MotionMode::kFixedAxisRotation);
    EXPECT_EQ(options[2].mode, MotionMode::kSelfRotation);
    ASSERT_TRUE(options[0].plan);
    EXPECT_TRUE(options[0].plan->route.empty());
    EXPECT_DOUBLE_EQ(options[0].plan->length_m, 40);
    EXPECT_EQ(options[0].plan->turns, 1);
    EXPECT_DOUBLE_EQ(options[0].plan->cost, 410);
    EXPECT_EQ(options[0].plan->swept.size(), 1u);
    EXPECT_EQ(options[2].plan.error().reason.code, "not_in_place");
}

TEST(LegPlanner, SuggestsTheFeasibleModeWithTheLeastTime) {
    LegWorld world(8);
    const LegPlanner planner(world.plant());
    auto request = world.request("platform", 1, 3);

    const auto options = planner.assess_modes(request, {});

    const LegPlan* fastest = nullptr;
    for (const ModeOption& each : options) {
        if (each.plan && (!fastest || each.plan->duration_s < fastest->duration_s)) {
            fastest = &*each.plan;
        }
    }
    ASSERT_TRUE(fastest);
    EXPECT_EQ(std::count_if(options.begin(), options.end(), [](auto& o) { return o.suggested; }),
              1);
    EXPECT_TRUE(option(options, fastest->mode).suggested);
    EXPECT_EQ(planner.plan_leg(request)->mode, fastest->mode);
    request.mode = MotionMode::kSelfRotation;
    EXPECT_EQ(planner.plan_leg(request).error().reason.code, "not_in_place");
    request.mode = MotionMode::kFree;
    EXPECT_EQ(planner.plan_leg(request).error().reason.code, "mode_not_supported");
}

TEST(LegPlanner, CountsTheAutomaticChoiceAsNoModeOfItsOwn) {
    LegWorld world(8);
    auto& modes = world.plant().vehicle_types.front().motion_modes;
    modes = {MotionMode::kAuto, MotionMode::kSelfRotation};
    const LegPlanner planner(world.plant());

    const auto options = planner.assess_modes(world.request("platform", 1, 3), {});
    const auto plan = planner.plan_leg(world.request("platform", 1, 3));

    ASSERT_EQ(options.size(), 1u);
    EXPECT_EQ(options[0].mode, MotionMode::kSelfRotation);
    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().reason.code, "not_in_place");
}

TEST(LegPlanner, DrivesToAPoseThatIsNoStation) {
    LegWorld world(8);
    const LegPlanner planner(world.plant());
    auto request = world.request("platform", 1, 3);
    request.target = {};
    request.target_pose = Pose2{30, 50, 0.3};

    const auto free = planner.plan_leg(request);
    request.target_pose = Pose2{80, 50, 0};
    const auto options = planner.assess_modes(request, {});

    ASSERT_TRUE(free) << free.error().what;
    expect_joined(*free, request.start, {30, 50, 0.3});
    // The pillar is between: no lane leads to a pose, so that is what bars the direct way.
    ASSERT_FALSE(option(options, MotionMode::kLinear).plan);
    const Error& why = option(options, MotionMode::kLinear).plan.error();
    EXPECT_EQ(why.reason.code, "blocked");
    EXPECT_EQ(value<std::string>(why, "by"), "pillar");
}

TEST(LegPlanner, TellsWhatTheWheelsDoWithinTheLimitsOfLanes) {
    LegWorld world(8);
    plant::VehicleType& platform = world.plant().vehicle_types.front();
    for (const double x_m : {-4.8, 4.8}) platform.wheels.push_back({"drive", {x_m, 0}, true, true});
    const auto free = LegPlanner(world.plant()).assess_modes(world.request("platform", 1, 3), {});
    for (plant::RoadmapEdge& edge : world.plant().edges) edge.max_speed_mps = 0.1;
    const LegPlanner planner(world.plant());

    const auto along_a_lane = planner.assess_modes(world.request("platform", 1, 3), {});
    const auto by_lanes = planner.assess_modes(world.request("platform", 1, 2), {});

    const auto& fast = *option(free, MotionMode::kLinear).plan;
    const auto& direct = *option(along_a_lane, MotionMode::kLinear).plan;
    const auto& slow = *option(by_lanes, MotionMode::kLinear).plan;
    ASSERT_TRUE(direct.route.empty());
    ASSERT_FALSE(slow.route.empty());
    ASSERT_TRUE(fast.wheels && direct.wheels && slow.wheels);
    EXPECT_NEAR(fast.wheels->speed_mps, platform.max_speed_mps, 1e-9);
    EXPECT_NEAR(fast.wheels->steering_rad, kPi / 2, 1e-9);  // to turn on the spot
    // Turns at the nodes are no driving on a lane.
    const double turning_mps = 4.8 * platform.max_turn_rate_radps;
    EXPECT_NEAR(slow.wheels->speed_mps, std::max(0.1, turning_mps), 1e-9);
    EXPECT_NEAR(direct.wheels->speed_mps, std::max(0.1, turning_mps), 1e-9);
    EXPECT_GT(direct.duration_s, fast.duration_s);
}

TEST(LegPlanner, TakesTheRoadmapWhenTheStraightWayIsBlocked) {
    LegWorld world(8);
    const LegPlanner planner(world.plant());
    const auto request = world.request("platform", 1, 2);

    const auto plan = option(planner.assess_modes(request, {}), MotionMode::kLinear).plan;

    ASSERT_TRUE(plan) << plan.error().what;
    const std::vector<plant::NodeId> route{plant::NodeId("a"), plant::NodeId("b"),
                                           plant::NodeId("c"), plant::NodeId("d")};
    EXPECT_EQ(plan->route, route);
    EXPECT_DOUBLE_EQ(plan->length_m, 100);
    EXPECT_EQ(plan->turns, 3);  // off the station, at b and at c
    EXPECT_DOUBLE_EQ(plan->cost, 10 * 100 + 3 * 10);
    expect_joined(*plan, request.start, {80, 50, kPi / 2});
    EXPECT_GE(plan->clearance_m, 0.5);
    const double simulated = simulated_clearance(world.plant(), *request.type, plan->segments);
    EXPECT_LE(plan->clearance_m, simulated + 1e-9);
    EXPECT_NEAR(plan->clearance_m, simulated, 0.01);
}

TEST(LegPlanner, RefusesThePlatformWhereTheTugFits) {
    LegWorld world(3);
    const LegPlanner planner(world.plant());

    const auto tug = planner.plan_leg(world.request("tug", 1, 2));
    const auto platform = planner.plan_leg(world.request("platform", 1, 2));

    ASSERT_TRUE(tug) << tug.error().what;
    ASSERT_FALSE(platform);
    EXPECT_EQ(platform.error().reason.code, "footprint_too_large");
    EXPECT_EQ(value<std::string>(platform.error(), "edge"), "b-c");
    EXPECT_NEAR(value<double>(platform.error(), "clearance_m"), 0.25, 1e-9);
    EXPECT_EQ(value<double>(platform.error(), "limit_m"), 0.5);
}

TEST(LegPlanner, NamesWhatBlocksAnArc) {
    LegWorld world(8);
    auto request = world.request("platform", 1, 3);
    request.mode = MotionMode::kFixedAxisRotation;

    // The half circle of radius 20 m about (20, 30) passes the pillar at 17.8 m and less.
    const auto refused = LegPlanner(world.plant()).plan_leg(request);
    std::erase_if(world.plant().areas, [](const auto& area) { return area.id.str() == "pillar"; });
    const auto accepted = LegPlanner(world.plant()).plan_leg(request);

    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, Errc::kUnreachable);
    EXPECT_EQ(refused.error().reason.code, "blocked");
    EXPECT_EQ(value<std::string>(refused.error(), "by"), "pillar");
    EXPECT_EQ(value<double>(refused.error(), "limit_m"), 0.5);
    EXPECT_LT(value<double>(refused.error(), "clearance_m"), 0.5);
    EXPECT_NEAR(value<double>(refused.error(), "at_x_m"), 34, 1 + 1e-9);
    EXPECT_NEAR(value<double>(refused.error(), "at_y_m"), 19, 1 + 1e-9);
    ASSERT_TRUE(accepted) << accepted.error().what;
    EXPECT_NEAR(accepted->length_m, kPi * 20, 1e-9);
}

TEST(LegPlanner, KeepsZonesAndLanesOpen) {
    LegWorld world(8);
    world.area("zone", {{15, 20}, {25, 20}, {25, 40}, {15, 40}}, plant::AreaKind::kZone);
    const LegPlanner planner(world.plant());
    EXPECT_TRUE(planner.plan_leg(world.request("platform", 1, 3))->route.empty());
}

TEST(LegPlanner, HeadingLineRefusalReachesTheCaller) {
    LegWorld world(8);
    world.plant().stations[2].pose = {45, 10.2, 0};
    const LegPlanner planner(world.plant());
    auto request = world.request("platform", 1, 3);
    request.mode = MotionMode::kFixedAxisRotation;

    const auto plan = planner.plan_leg(request);

    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().reason.code, "target_on_heading_line");
    EXPECT_GT(value<double>(plan.error(), "radius_m"), 200);
    EXPECT_EQ(value<double>(plan.error(), "limit_m"), 200);
}

TEST(LegPlanner, StandingVehiclesLowerTheClearanceOnly) {
    LegWorld world(8);
    const LegPlanner planner(world.plant());
    const auto request = world.request("platform", 1, 3);
    const StandingBody other{plant::VehicleId("V9"),
                             {geometry::transformed({20, 30, 0}, geometry::rectangle(3, 3))}};

    const auto options = planner.assess_modes(request, {other});

    ASSERT_TRUE(options[0].plan);
    EXPECT_EQ(options[0].plan->clearance_m, 0);
    EXPECT_EQ(options[0].plan->nearest, "V9");
}

TEST(LegPlanner, LeavesATightPlaceButNeverGetsNearer) {
    LegWorld world(8);
    world.area("rack", {{10, 11.6}, {30, 11.6}, {30, 13}, {10, 13}});  // 0.35 m beside station 1
    world.plant().stations[2].pose = {40, 10, 0};
    const LegPlanner planner(world.plant());
    auto request = world.request("platform", 1, 3);
    request.mode = MotionMode::kLinear;

    const auto along = planner.assess_modes(request, {})[0].plan;
    request.start.y_m = 10.30;  // 0.05 m: nothing drives by itself
    const auto touching = planner.plan_leg(request);

    ASSERT_TRUE(along) << along.error().what;
    EXPECT_NEAR(along->clearance_m, 0.35, 1e-9);
    EXPECT_EQ(along->nearest, "rack");
    EXPECT_FALSE(touching);
}

TEST(LegPlanner, BacksOutOfABayInWhichItCannotTurn) {
    LegWorld world(8);
    // Station 1 ends up in a bay 4 m wide, open to the north; the platform stands in it.
    world.area("left", {{10, 1}, {18, 1}, {18, 22}, {10, 22}});
    world.area("right", {{22, 1}, {30, 1}, {30, 22}, {22, 22}});
    world.plant().stations[0].pose = {20, 10, kPi / 2};
    const LegPlanner planner(world.plant());

    const auto in = planner.plan_leg(world.request("platform", 2, 1));
    const auto out = planner.plan_leg(world.request("platform", 1, 2));

    ASSERT_TRUE(in) << in.error().what;
    ASSERT_TRUE(out) << out.error().what;
    EXPECT_LT(in->segments.back().length_m, 0);  // backwards: it has to face north there
    EXPECT_GT(out->segments.front().length_m, 0);
    EXPECT_GE(simulated_clearance(world.plant(), world.plant().vehicle_types[0], in->segments),
              0.5);
}

TEST(LegPlanner, DrivesStraightAheadOrBackFirstWhereItIsAskedTo) {
    LegWorld world(8);
    world.area("rack", {{36, 6}, {38, 6}, {38, 14}, {36, 14}});  // ahead of station 1
    LegPlanner planner(world.plant());
    const auto request = world.request("platform", 1, 3);

    for (const double first_m : {3.0, -4.0}) {
        const auto plan = planner.plan_leg_after(first_m, request);
        ASSERT_TRUE(plan) << plan.error().what;
        expect_joined(*plan, request.start, {20, 50, 0});
        EXPECT_EQ(plan->segments.front().kind, Segment::Kind::kStraight);
        EXPECT_DOUBLE_EQ(plan->segments.front().length_m, first_m);
        auto later = request;
        later.start = {20 + first_m, 10, 0};
        later.from_station = {};
        const auto rest = planner.plan_leg(later);
        EXPECT_NEAR(plan->length_m, rest->length_m + std::abs(first_m), 1e-9);
        EXPECT_NEAR(plan->cost, rest->cost + world.plant().routing.k_same * std::abs(first_m),
                    1e-9);
    }
    planner.set_closures({{"wet", "wet", request.hall, {{{27, 8}, {28, 8}, {28, 12}, {27, 12}}}}});
    EXPECT_EQ(planner.plan_leg_after(3, request)->closures, std::vector<std::string>{"wet"});
    const auto into_the_rack = planner.plan_leg_after(11, request);
    ASSERT_FALSE(into_the_rack);
    EXPECT_EQ(into_the_rack.error().reason.code, "blocked");
    EXPECT_EQ(value<std::string>(into_the_rack.error(), "by"), "rack");
}

TEST(LegPlanner, FindsItsWayFromBesideTheRoadmap) {
    LegWorld world(8);
    const LegPlanner planner(world.plant());
    auto request = world.request("platform", 1, 2);
    request.from_station = {};
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> x(8, 40);
    std::uniform_real_distribution<double> y(8, 52);
    std::uniform_real_distribution<double> turn(-kPi, kPi);
    for (int i = 0; i < 40; ++i) {
        request.start = {x(random), y(random), turn(random)};
        // Beside the pillar there may be no room to turn towards any node.
        if (geometry::distance(request.start.position(), {34, 19}) < 7.5) continue;
        const auto plan = option(planner.assess_modes(request, {}), MotionMode::kLinear).plan;
        ASSERT_TRUE(plan) << plan.error().what;
        expect_joined(*plan, request.start, {80, 50, kPi / 2});
        EXPECT_GE(simulated_clearance(world.plant(), *request.type, plan->segments), 0.5 - 1e-9);
    }
}

TEST(LegPlanner, OneWayLanesAndTypesBound) {
    LegWorld world(8);
    auto& edges = world.plant().edges;
    for (auto& edge : edges) {
        if (edge.id.str() == "b-c") edge.vehicle_types = {plant::VehicleTypeId("tug")};
    }
    const auto forbidden = LegPlanner(world.plant()).plan_leg(world.request("platform", 1, 2));
    std::erase_if(edges, [](const auto& e) { return e.id.str() == "b-c"; });
    const auto missing = LegPlanner(world.plant()).plan_leg(world.request("platform", 1, 2));

    ASSERT_FALSE(forbidden);
    EXPECT_EQ(forbidden.error().reason.code, "no_route");
    EXPECT_EQ(value<std::string>(forbidden.error(), "blocked_by"), "b-c");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().reason.code, "no_route");
    EXPECT_EQ(value<std::string>(missing.error(), "from"), "st1");
    EXPECT_EQ(value<std::string>(missing.error(), "to"), "st2");
    EXPECT_TRUE(LegPlanner(world.plant()).plan_leg(world.request("platform", 2, 1)));
}

TEST(LegPlanner, RefusesAStationOfOtherTypesAndAnUnknownOne) {
    LegWorld world(8);
    world.plant().stations[1].vehicle_types = {plant::VehicleTypeId("tug")};
    const LegPlanner planner(world.plant());
    auto request = world.request("platform", 1, 2);
    EXPECT_EQ(planner.plan_leg(request).error().reason.code, "station_not_for_type");
    request.target = plant::StationId("st99");
    EXPECT_EQ(planner.plan_leg(request).error().reason.code, "unknown_station");
}

TEST(LegPlanner, ListsTheTypesOwnModesInOrder) {
    LegWorld world(8);
    const auto options = LegPlanner(world.plant()).assess_modes(world.request("tug", 1, 3), {});
    ASSERT_EQ(options.size(), 3u);
    EXPECT_EQ(options[0].mode, MotionMode::kLinear);
    EXPECT_EQ(options[1].mode, MotionMode::kLateral);
    EXPECT_TRUE(options[1].plan);  // station 3 lies right beside
    EXPECT_EQ(options[2].mode, MotionMode::kFree);
    EXPECT_TRUE(options[2].plan);
    EXPECT_FALSE(options[2].suggested) << "not while something else is feasible";
}

TEST(LegPlanner, AFactsheetsFasterTypeKeepsTheWayAndShortensTheTime) {
    LegWorld world(8);
    const LegPlanner planner(world.plant());
    auto request = world.request("platform", 1, 2);
    plant::VehicleType fast = *request.type;
    fast.max_speed_mps *= 10;
    fast.max_accel_mps2 *= 100;
    fast.max_turn_rate_radps *= 10;
    fast.max_turn_accel_radps2 *= 100;
    const auto slow_plan = planner.plan_leg(request);
    request.type = &fast;

    const auto fast_plan = planner.plan_leg(request);

    ASSERT_TRUE(slow_plan && fast_plan);
    EXPECT_NEAR(fast_plan->duration_s, slow_plan->duration_s / 10, 1e-9);
    EXPECT_EQ(fast_plan->route, slow_plan->route);
}

}  // namespace
}  // namespace pulseline::planning
