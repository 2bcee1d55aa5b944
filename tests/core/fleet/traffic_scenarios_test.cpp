#include <gtest/gtest.h>

#include "tests/core/fleet/traffic_halls.hpp"

// Vehicles that meet: the fleet's side of core/traffic, with obedient vehicles.
namespace pulseline::fleet::testing {
namespace {

using plant::VehicleId;

TEST(TrafficScenarios, TwoThatWantEachOthersPlaceMeetHeadOnAndOneUsesTheBay) {
    World world(corridor());
    confirm_poses(world);

    ASSERT_TRUE(world.order("V1", {2}));
    ASSERT_TRUE(world.order("V2", {1}));
    world.run(600);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << order_of(world, "V1").reason.code;
    EXPECT_EQ(order_of(world, "V2").state, JobState::kEnded) << order_of(world, "V2").reason.code;
    EXPECT_FALSE(world.fleet->traffic(world.now).stopped);
}

TEST(TrafficScenarios, WhoWaitsIsInTheWaitForGraphWithWhomItWaitsFor) {
    World world(corridor());
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {2}));
    ASSERT_TRUE(world.order("V2", {1}));

    bool seen = false;
    for (int i = 0; i < 600 && !seen; ++i) {
        world.run(0.5);
        for (const auto& wait : world.fleet->traffic(world.now).waits) {
            seen |= wait.vehicle != wait.waits_for && !wait.waits_for.empty() &&
                    wait.reason.code == "floor_held";
        }
    }
    EXPECT_TRUE(seen);
}

TEST(TrafficScenarios, WhoHasNothingToDoAnyMoreWaitsForNobody) {
    World world(corridor());
    confirm_poses(world);
    close_lane(world, 35, 45);
    ASSERT_TRUE(world.order("V1", {2}));
    ASSERT_TRUE(world.order("V2", {1}));
    world.run(30);
    ASSERT_FALSE(world.fleet->traffic(world.now).waits.empty());

    for (const auto& order : world.fleet->orders())
        ASSERT_TRUE(world.fleet->cancel_order(order.id, std::nullopt, "op", world.now));
    world.run(120);

    EXPECT_TRUE(world.fleet->traffic(world.now).waits.empty());
}

TEST(TrafficScenarios, AnOrdersExpectedEndHasNeverPassed) {
    World world(corridor());
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {2, 1}));
    ASSERT_TRUE(world.order("V2", {1, 2}));
    bool was_expected = false;
    for (int i = 0; i < 6000; ++i) {
        world.run(0.1);
        if (i == 150) close_lane(world, 35, 45);
        for (const auto& order : world.fleet->orders()) {
            if (!order.expected) continue;
            was_expected = true;
            ASSERT_GT(*order.expected, world.now) << order.number << " at step " << i;
        }
        for (const auto& view : world.fleet->vehicles(world.now)) {
            if (view.leg && view.leg->expected) {
                ASSERT_GE(*view.leg->expected, world.now);
            }
        }
    }
    EXPECT_TRUE(was_expected);
}

TEST(TrafficScenarios, AnOrderThatHasWaitedLongGoesBeforeYoungerOnesForTheSameStation) {
    World world(plant_of({{"west", 10, 40, 1},
                          {"goal", 60, 40, 2},
                          {"east", 90, 40, 3},
                          {"fork", 45, 40},
                          {"bay", 45, 52, 4},
                          {"way", 75, 40},
                          {"hole", 75, 52, 5}},
                         {{"west", "fork"},
                          {"fork", "bay"},
                          {"fork", "goal"},
                          {"goal", "way"},
                          {"way", "hole"},
                          {"way", "east"}},
                         3));
    confirm_poses(world);
    auto& broken = world.vehicle("V2").state.errors;
    broken.push_back({"driveFault", true, "hot", {}});
    world.run(1);
    ASSERT_TRUE(world.order("V1", {2}));
    world.run(90);
    ASSERT_EQ(order_of(world, "V1").reason.code, "floor_held");

    ASSERT_TRUE(world.order("V3", {2}));  // it stands nearer
    world.run(5);
    EXPECT_EQ(order_of(world, "V3").reason.code, "goes_first");
    broken.clear();
    ASSERT_TRUE(world.fleet->resume_fleet({VehicleId("V2")}, "op", world.now));
    world.run(300);

    for (const char* id : {"V1", "V3"})
        EXPECT_EQ(order_of(world, id).state, JobState::kEnded) << order_of(world, id).reason.code;
}

TEST(TrafficScenarios, FourThatWantTheNextOnesPlaceGoRoundOverACrossing) {
    World world(plant_of({{"west", 10, 40, 1},
                          {"north", 40, 70, 2},
                          {"east", 70, 40, 3},
                          {"south", 40, 10, 4},
                          {"crossing", 40, 40},
                          {"bay", 60, 60, 5}},
                         {{"west", "crossing"},
                          {"north", "crossing"},
                          {"east", "crossing"},
                          {"south", "crossing"},
                          {"crossing", "bay"}},
                         4));
    confirm_poses(world);

    for (int i = 1; i <= 4; ++i) {
        ASSERT_TRUE(world.order("V" + std::to_string(i), {i % 4 + 1}));
    }
    world.run(1500);

    for (int i = 1; i <= 4; ++i) {
        const auto order = order_of(world, "V" + std::to_string(i));
        EXPECT_EQ(order.state, JobState::kEnded) << i << " " << order.reason.code;
    }
    EXPECT_FALSE(world.fleet->traffic(world.now).stopped);
}

TEST(TrafficScenarios, ABrokenDownVehicleOnTheShortWayIsPassedOnTheLongOne) {
    plant::Plant plant = two_ways();
    plant.vehicles[1].home = plant::StationId("s3");
    World world(plant);
    confirm_poses(world);
    world.vehicle("V2").state.errors.push_back({"driveFault", true, "no drive", {}});
    world.run(1);

    ASSERT_TRUE(world.order("V1", {2}));
    world.run(600);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << order_of(world, "V1").reason.code;
}

/// V1 in the west of the only lane, V2 at home in its middle, a bay beside it.
plant::Plant one_lane() {
    return plant_of(
        {{"west", 10, 40, 1}, {"middle", 40, 40, 2}, {"east", 70, 40, 3}, {"bay", 40, 52, 4}},
        {{"west", "middle"}, {"middle", "east"}, {"middle", "bay"}}, 2);
}

TEST(TrafficScenarios, AVehicleThatHasNotToldWhereItStandsIsPresumedAtHome) {
    World world(one_lane());
    world.connect_all();
    world.vehicle("V1").state.position_initialized = true;
    world.run(1);
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(120);
    EXPECT_EQ(order_of(world, "V1").reason.code, "floor_held");
    EXPECT_EQ(world.vehicle("V1").state.pose->x_m, 10);

    world.vehicle("V2").state.position_initialized = true;
    world.run(600);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << "V2 made way";
}

TEST(TrafficScenarios, WhoIsFoundAtTheHomeOfOneThatHasNotToldWhereItStandsHasTheFloor) {
    World world(one_lane());
    world.connect_all();
    world.vehicle("V1").state.pose->x_m = 40;
    world.vehicle("V1").state.position_initialized = true;
    world.run(1);
    ASSERT_TRUE(world.order("V1", {3}));

    world.run(600);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << order_of(world, "V1").reason.code;
    EXPECT_EQ(world.count_events("vehicle.floor_conflict"), 0);
}

TEST(TrafficScenarios, OnTheOnlyRoadABreakdownIsWaitedForWithItsName) {
    plant::Plant plant = plant_of(
        {{"west", 10, 40, 1}, {"east", 70, 40, 2}, {"middle", 40, 40, 3}, {"far", 90, 40, 4}},
        {{"west", "middle"}, {"middle", "east"}, {"east", "far"}}, 2);
    plant.vehicles[1].home = plant::StationId("s3");
    World world(plant);
    confirm_poses(world);
    world.vehicle("V2").state.errors.push_back({"driveFault", true, "no drive", {}});
    world.run(1);
    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);
    ASSERT_EQ(order_of(world, "V1").state, JobState::kRunning);
    EXPECT_EQ(order_of(world, "V1").reason.code, "floor_held");

    world.vehicle("V2").state.errors.clear();
    ASSERT_TRUE(world.fleet->resume_fleet({VehicleId("V2")}, "op", world.now));
    world.run(600);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << "it made way once it could";
}

TEST(TrafficScenarios, AStateThatWasOvertakenChangesNothing) {
    World world(corridor());
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(1);
    const auto id = VehicleId("V1");
    vda5050::StateMessage older = world.vehicle("V1").state;
    older.header_id = 7;
    world.run(1);
    vda5050::StateMessage newer = world.vehicle("V1").state;
    newer.header_id = 8;
    world.fleet->vehicle_state(id, newer, world.now);
    const auto before = world.fleet->vehicle(id, world.now);
    older.order_id.clear();  // from before it had the order

    world.fleet->vehicle_state(id, older, world.now);

    const auto after = world.fleet->vehicle(id, world.now);
    EXPECT_FALSE(after->needs_resume);
    EXPECT_EQ(after->state.header_id, 8);
    EXPECT_EQ(after->pose->x_m, before->pose->x_m);
    EXPECT_EQ(order_of(world, "V1").state, JobState::kRunning);
}

TEST(TrafficScenarios, APauseThatOutlivedItsDriveEndsWithResume) {
    World world;
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {2, 3}));
    const auto id = world.only_order().id;
    auto& vehicle = world.vehicle("V1");
    while (vehicle.state.last_node_id != "s2" && world.ticks < 5000) world.run(0.1);
    ASSERT_EQ(world.stored(id).current_step, 0u);
    // It makes its stop while the order to pause is on its way.
    ASSERT_TRUE(world.fleet->pause_order(id, std::nullopt, "op", world.now));
    for (int actions = 0; actions < 3; ++actions) vehicle.step();
    world.fleet->vehicle_state(VehicleId("V1"), vehicle.state, world.now);
    world.run(5);
    ASSERT_EQ(world.stored(id).state, JobState::kInterrupted);
    ASSERT_EQ(world.stored(id).current_step, 1u);
    ASSERT_TRUE(vehicle.state.paused);

    ASSERT_TRUE(world.fleet->resume_order(id, std::nullopt, "op", world.now));
    world.run(600);

    EXPECT_EQ(world.stored(id).state, JobState::kEnded) << world.stored(id).reason.code;
}

/// V1 on its way to the bay waits before floor that is closed until `door` is reopened.
struct BeforeADoor {
    World world{corridor()};
    Closure door;
    std::size_t released = 0;

    BeforeADoor() {
        confirm_poses(world);
        EXPECT_TRUE(world.order("V1", {3}));
        world.run(2);
        door = close_lane(world, 30, 33);
        world.run(60);
        released = leg().released_nodes;
        EXPECT_GT(released, 1u);
        EXPECT_LT(released, leg().nodes.size()) << "it waits before the door";
    }
    const Leg& leg() const { return world.store.vehicles.at(VehicleId("V1")).leg_data; }
};

TEST(TrafficScenarios, ASilentVehicleGetsNoFloorThatBecomesFree) {
    BeforeADoor at;
    at.world.connected[VehicleId("V1")] = false;
    at.world.run(4);
    ASSERT_EQ(at.world.fleet->vehicle(VehicleId("V1"), at.world.now)->link, Link::kLate);

    ASSERT_TRUE(at.world.fleet->reopen_floor(at.door.id, "op", at.world.now));
    at.world.run(20);

    EXPECT_EQ(at.leg().released_nodes, at.released);
}

TEST(TrafficScenarios, AVehicleWithItsSafetyStopPulledGetsNoFloorThatBecomesFree) {
    BeforeADoor at;
    at.world.vehicle("V1").state.e_stop = "MANUAL";
    at.world.run(2);

    ASSERT_TRUE(at.world.fleet->reopen_floor(at.door.id, "op", at.world.now));
    at.world.run(20);

    EXPECT_EQ(at.leg().released_nodes, at.released);
}

}  // namespace
}  // namespace pulseline::fleet::testing
