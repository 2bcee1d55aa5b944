#include <algorithm>

#include <gtest/gtest.h>

#include "core/vda5050/actions.hpp"
#include "tests/core/fleet/fleet_world.hpp"

// Vehicles that have stopped of themselves.
namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");

/// On its way V1 stops for an error of its own.
void stop_v1(World& world) {
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(0.8);
    FakeVehicle& vehicle = world.vehicle("V1");
    ASSERT_FALSE(vehicle.state.node_states.empty());
    vehicle.state.errors.push_back({"machineSilent", true, "its machine is silent", {}});
    vehicle.stands = true;
    world.run(2);
}

int resumed(const World& world) {
    const auto& answers = world.vehicles.at(kV1).state.action_states;
    return static_cast<int>(
        std::ranges::count(answers, vda5050::kStopPause, &vda5050::ActionState::type));
}

TEST(FatalError, WhoHasStoppedForOneGoesOnOnlyByAPersonEvenWhenItIsOver) {
    World world;
    stop_v1(world);
    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
    EXPECT_EQ(world.only_order().reason.code, "vehicle_error");
    EXPECT_TRUE(world.store.vehicles.at(kV1).needs_resume);

    FakeVehicle& vehicle = world.vehicle("V1");
    vehicle.state.errors.clear();
    world.run(10);
    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    vehicle.stands = false;
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST(FatalError, APersonsWordReachesTheVehicleAndIsAskedForAgainWhereItDoesNotHelp) {
    World world;
    stop_v1(world);
    ASSERT_EQ(resumed(world), 0);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    EXPECT_FALSE(world.fleet->vehicle(kV1, world.now)->needs_resume);
    world.run(2);
    EXPECT_EQ(resumed(world), 1) << "without its own error it goes on by this alone";
    EXPECT_TRUE(world.store.vehicles.at(kV1).needs_resume);
    EXPECT_EQ(world.count_events("vehicle.needs_resume"), 2);
    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
}

// It is asked where it stands, and that is enough for one that was on no way.
TEST(FatalError, WhoIsLostWhereItStandsNeedsOnlyToBeToldWhere) {
    World world;
    world.connect_all();
    FakeVehicle& vehicle = world.vehicle("V1");
    vehicle.sees_codes = false;
    vehicle.state.cameras.clear();
    vehicle.state.position_initialized = false;
    vehicle.state.errors.push_back({"contoursLost", true, "its map is another", {}});
    world.run(2);
    ASSERT_TRUE(world.fleet->init_position(kV1, {*vehicle.state.pose}, "op", world.now));
    vehicle.state.errors.clear();
    world.run(2);
    EXPECT_FALSE(world.store.vehicles.at(kV1).needs_resume);
}

TEST(FatalError, WhatPassesByItselfNeedsNobody) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(0.8);
    world.vehicle("V1").state.errors.push_back({"poseVague", false, "it knows little", {}});
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
    EXPECT_EQ(world.count_events("vehicle.needs_resume"), 0);
}

}  // namespace
}  // namespace pulseline::fleet::testing
