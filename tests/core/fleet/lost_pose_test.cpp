#include <gtest/gtest.h>

#include "tests/core/fleet/fleet_world.hpp"

// Vehicles that do not know any more where they stand.
namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");
const plant::VehicleId kV2("V2");

/// V1 stands on its way and does not know where any more.
void lose_v1(World& world) {
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(0.8);
    FakeVehicle& vehicle = world.vehicle("V1");
    ASSERT_FALSE(vehicle.state.node_states.empty());
    vehicle.state.position_initialized = false;
    vehicle.sees_codes = false;
    vehicle.state.cameras.clear();
    vehicle.stands = true;
    world.run(2);
}

/// From now on it moves again, and reads codes.
void find_v1(World& world) {
    world.vehicle("V1").stands = false;
    world.vehicle("V1").sees_codes = true;
}

TEST(LostPose, ALegIsKeptUntilItIsKnownWhereItsVehicleStands) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(0.8);
    ASSERT_TRUE(world.store.vehicles.at(kV1).has_leg);

    world.vehicle("V1").restart();
    world.vehicle("V1").sees_codes = false;
    world.run(5);
    EXPECT_TRUE(world.store.vehicles.at(kV1).has_leg) << "its base is the floor it may stand on";

    const Pose2 pose = *world.vehicle("V1").state.pose;
    ASSERT_TRUE(world.fleet->init_position(kV1, {pose}, "op", world.now));
    world.run(2);
    EXPECT_FALSE(world.store.vehicles.at(kV1).has_leg);
}

TEST(LostPose, OnTheWayTheOrderGoesOnFromWhereAPersonSaysAndOnlyThen) {
    World world;
    lose_v1(world);
    FakeVehicle& vehicle = world.vehicle("V1");
    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
    EXPECT_EQ(world.only_order().reason.code, "pose_lost");
    EXPECT_TRUE(vehicle.state.node_states.empty()) << "it has given up its way";
    EXPECT_TRUE(world.store.vehicles.at(kV1).has_leg) << "its base is the floor it may stand on";

    ASSERT_TRUE(world.fleet->init_position(kV1, {*vehicle.state.pose}, "op", world.now));
    world.run(2);
    EXPECT_FALSE(world.store.vehicles.at(kV1).has_leg);
    EXPECT_EQ(world.only_order().state, JobState::kInterrupted) << "a place moves nothing";
    find_v1(world);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);

    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

// It neither ended nor could anybody say where the vehicle stands, each for want of the other.
TEST(LostPose, ACancelledOrderEndsOnceAPersonSaysWhereItsVehicleStands) {
    World world;
    lose_v1(world);

    ASSERT_TRUE(world.fleet->cancel_order(world.only_order().id, {}, "op", world.now));
    world.run(2);
    ASSERT_TRUE(
        world.fleet->init_position(kV1, {*world.vehicle("V1").state.pose}, "op", world.now));
    world.run(2);

    EXPECT_FALSE(world.store.vehicles.at(kV1).has_leg);
    EXPECT_EQ(world.only_order().state, JobState::kAborted);
}

/// A way planned from where a person has pointed to would begin beside where it stands.
TEST(LostPose, AnOrderWaitsUntilItsVehicleHasFoundItselfFromWhereAPersonPointed) {
    World world;
    world.connect_all();
    FakeVehicle& vehicle = world.vehicle("V1");
    const Pose2 pose = *vehicle.state.pose;
    vehicle.restart();
    vehicle.sees_codes = false;
    vehicle.state.cameras.clear();
    world.run(2);
    ASSERT_TRUE(world.order("V1", {3}));
    ASSERT_TRUE(world.fleet->init_position(kV1, {pose}, "op", world.now));
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    vehicle.state.deviation_range_m = 0.2;
    world.run(30);
    EXPECT_EQ(world.only_order().reason.code, "pose_vague");
    EXPECT_EQ(vehicle.orders_received, 0);

    vehicle.state.deviation_range_m = 0.06;
    vehicle.sees_codes = true;
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST(LostPose, TheOrderGoesOnAlsoWhenTheServerWasRestartedMeanwhile) {
    World world;
    lose_v1(world);

    world.crash_server();
    world.run(2);
    ASSERT_TRUE(world.store.vehicles.at(kV1).has_leg);
    ASSERT_TRUE(
        world.fleet->init_position(kV1, {*world.vehicle("V1").state.pose}, "op", world.now));
    world.run(2);
    find_v1(world);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);

    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST(LostPose, WhoIsLetGoOnBeforeItsPlaceIsSaidWaitsForThat) {
    World world;
    lose_v1(world);
    find_v1(world);
    world.vehicle("V1").sees_codes = false;
    const int steps = world.vehicle("V1").node_steps;

    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(10);
    EXPECT_EQ(world.vehicle("V1").node_steps, steps);
    ASSERT_TRUE(
        world.fleet->init_position(kV1, {*world.vehicle("V1").state.pose}, "op", world.now));
    world.vehicle("V1").sees_codes = true;
    world.run(60);

    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST(LostPose, WhoFindsItselfAgainWaitsForAPersonAllTheSame) {
    World world;
    lose_v1(world);
    find_v1(world);
    const int steps = world.vehicle("V1").node_steps;

    world.vehicle("V1").state.position_initialized = true;
    world.run(10);
    EXPECT_EQ(world.vehicle("V1").node_steps, steps);
    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);

    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST(LostPose, ACancelThatWaitsForThePlaceIsNotToldAsUnconfirmed) {
    World world;
    lose_v1(world);
    world.run(30);
    EXPECT_EQ(world.count_events("vehicle.action_unconfirmed"), 0);
}

// "Cancel its order first" would be the wrong advice: it has been told to already.
TEST(LostPose, WhoSaysItsPlaceBeforeTheWayIsGivenUpIsToldToSayItAgain) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(0.8);
    FakeVehicle& vehicle = world.vehicle("V1");
    vehicle.stands = true;
    vehicle.sees_codes = false;
    vehicle.state.cameras.clear();
    vehicle.state.position_initialized = false;
    for (int i = 0; i < 50 && world.fleet->vehicle(kV1, world.now)->pose_known; ++i) world.run(0.1);

    const auto said = world.fleet->init_position(kV1, {*vehicle.state.pose}, "op", world.now);

    ASSERT_FALSE(said);
    EXPECT_EQ(said.error().reason.code, "vehicle_busy");
    EXPECT_NE(said.error().what.find("again in a moment"), std::string::npos) << said.error().what;
    world.run(2);
    EXPECT_TRUE(world.fleet->init_position(kV1, {*vehicle.state.pose}, "op", world.now));
}

TEST(LostPose, TheFloorIsKeptOverARestart) {
    World world;
    world.connect_all();
    world.vehicle("V2").sees_codes = false;
    world.vehicle("V2").restart();
    world.run(2);
    ASSERT_FALSE(world.fleet->vehicle(kV2, world.now)->pose_known);

    world.crash_server();
    world.run(1);
    ASSERT_TRUE(world.order("V1", {4}));
    world.run(60);

    EXPECT_EQ(world.only_order().state, JobState::kRunning);
    EXPECT_EQ(world.only_order().reason.code, "floor_held");
}

}  // namespace
}  // namespace pulseline::fleet::testing
