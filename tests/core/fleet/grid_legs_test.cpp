#include <gtest/gtest.h>

#include <algorithm>

#include "core/fleet/tables/layout.hpp"
#include "tests/core/fleet/traffic_halls.hpp"

// Drives over free floor where no lane leads: ordinary legs, which hold their floor.
namespace pulseline::fleet::testing {
namespace {

using plant::VehicleId;

const VehicleId kV1("V1");

/// The small hall without lanes, and a wall between stations 1 and 2 with a gap for one vehicle at
/// its northern end.
plant::Plant hall_without_lanes() {
    plant::Plant plant = small_plant();
    plant.edges.clear();
    plant.nodes.clear();
    for (auto& station : plant.stations) station.node = {};
    plant.vehicle_types.front().motion_modes.push_back(plant::MotionMode::kFree);
    plant.areas.push_back({plant::AreaId("wall"),
                           plant::AreaKind::kObstacle,
                           "Wall",
                           plant.halls.front().id,
                           {{17, 0}, {19, 0}, {19, 36.5}, {17, 36.5}},
                           {}});
    return plant;
}

NewOrder order_to(int station) {
    NewOrder order;
    order.vehicle = kV1;
    NewStep step;
    step.station_number = station;
    order.steps.push_back(step);
    return order;
}

TEST(GridLegs, AreShownBeforeTheyAreOrdered) {
    World world(hall_without_lanes());
    confirm_poses(world);

    const Preview preview = world.fleet->preview(order_to(2), world.now);

    EXPECT_TRUE(preview.accepted) << preview.problem.value_or(Error{}).what;
    ASSERT_EQ(preview.steps.size(), 1u);
    EXPECT_EQ(preview.steps.front().chosen, plant::MotionMode::kLinear);
    const auto& options = preview.steps.front().options;
    const auto linear =
        std::ranges::find(options, plant::MotionMode::kLinear, &planning::ModeOption::mode);
    ASSERT_NE(linear, options.end());
    ASSERT_TRUE(linear->plan);
    EXPECT_FALSE(linear->plan->swept.empty());
}

TEST(GridLegs, AreDrivenToTheirStationWithoutWaitingForAPlan) {
    World world(hall_without_lanes());
    world.plans_at_once = false;
    confirm_poses(world);

    const auto order = world.order("V1", {2});
    ASSERT_TRUE(order) << order.error().what;
    world.run(1);

    EXPECT_TRUE(world.questions.empty());
    const auto view = world.fleet->vehicle(kV1, world.now);
    ASSERT_TRUE(view && view->leg);
    EXPECT_EQ(view->leg->mode, plant::MotionMode::kLinear);
    EXPECT_FALSE(view->leg->granted_area.empty());
    EXPECT_LT(view->leg->granted_points, view->leg->path.size()) << "the rest is still to come";
    world.run(300);
    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << order_of(world, "V1").reason.code;
}

TEST(GridLegs, HoldTheirFloorAgainstOthers) {
    World world(hall_without_lanes());
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {2}));
    FakeVehicle& first = world.vehicle("V1");
    for (int i = 0; i < 2000 && first.state.pose->y_m < 35; ++i) world.run(0.1);
    ASSERT_GE(first.state.pose->y_m, 35) << "in the gap";
    first.stands = true;
    first.state.driving = false;

    ASSERT_TRUE(world.order("V2", {1}));
    world.run(120);
    EXPECT_NE(order_of(world, "V2").state, JobState::kEnded);
    EXPECT_FALSE(world.fleet->traffic(world.now).stopped) << "the monitor finds nothing";

    first.stands = false;
    world.run(600);
    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << order_of(world, "V1").reason.code;
    EXPECT_EQ(order_of(world, "V2").state, JobState::kEnded) << order_of(world, "V2").reason.code;
    EXPECT_FALSE(world.fleet->traffic(world.now).stopped);
}

TEST(GridLegs, AreBegunAnewFromWhereTheVehicleStandsAfterARestart) {
    World world(hall_without_lanes());
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {2}));
    FakeVehicle& first = world.vehicle("V1");
    for (int i = 0; i < 2000 && first.state.pose->y_m < 30; ++i) world.run(0.1);

    world.crash_server();
    world.run(15);
    if (world.fleet->vehicle(kV1, world.now)->needs_resume) {
        ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    }
    world.run(300);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << order_of(world, "V1").reason.code;
    EXPECT_FALSE(world.fleet->traffic(world.now).stopped);
}

TEST(GridLegs, WaitForClosedFloorThatHasNoWayRound) {
    World world(hall_without_lanes());
    confirm_poses(world);
    NewClosure closure;
    closure.name = "Gap";
    closure.hall = world.plant.halls.front().id;
    closure.outline = {{17, 35}, {19, 35}, {19, 40}, {17, 40}};
    const auto closed = world.fleet->close_floor(closure, "op", world.now);
    ASSERT_TRUE(closed);

    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);
    EXPECT_EQ(order_of(world, "V1").reason.code, "floor_closed");

    ASSERT_TRUE(world.fleet->reopen_floor(closed->id, "op", world.now));
    world.run(300);
    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << order_of(world, "V1").reason.code;
}

TEST(GridLegs, TheLayoutIsCheckedForStationsThatTheyDoNotLeadTo) {
    const auto unreachable = [](const plant::Plant& plant) {
        return std::ranges::count(check_layout(plant), "unreachable", &Reason::code);
    };
    plant::Plant plant = hall_without_lanes();
    EXPECT_EQ(unreachable(plant), 0);
    plant.areas.back().outline = {{17, 0}, {19, 0}, {19, 40}, {17, 40}};
    EXPECT_GT(unreachable(plant), 0);
}

TEST(GridLegs, AreRefusedWithAReasonWhereTheFloorIsCutOff) {
    plant::Plant plant = hall_without_lanes();
    plant.areas.back().outline = {{17, 0}, {19, 0}, {19, 40}, {17, 40}};
    World world(plant);
    confirm_poses(world);
    NewOrder request = order_to(2);
    request.steps.front().mode = plant::MotionMode::kLinear;

    const auto refused = world.order(request);

    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "no_floor_way");
    EXPECT_EQ(refused.error().field, "/steps/0/motion_mode");
}

}  // namespace
}  // namespace pulseline::fleet::testing
