#include "core/fleet/fleet.hpp"

#include <gtest/gtest.h>

#include "tests/core/fleet/fleet_world.hpp"

// What a restart of the server or of a vehicle leaves, and what it needs a person for.
namespace pulseline::fleet::testing {
namespace {

using plant::VehicleId;

const VehicleId kV1("V1");

TEST(Fleet, AfterAServerRestartNothingIsReleasedUntilAPersonAllowsIt) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(0.5);
    ASSERT_TRUE(world.store.vehicles.at(kV1).has_leg);
    const auto released = world.store.vehicles.at(kV1).leg_data.released_nodes;

    world.crash_server();
    world.run(60);

    EXPECT_EQ(world.store.vehicles.at(kV1).leg_data.released_nodes, released);
    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
    EXPECT_EQ(world.only_order().reason.code, "server_restarted");

    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
    EXPECT_EQ(world.store.stops.size(), 1u);
}

TEST(Fleet, AStopMeasuredWhileTheServerWasDownIsTakenOnce) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {2}));
    while (!world.store.vehicles.contains(kV1) ||
           world.store.vehicles.at(kV1).leg_data.released_nodes !=
               world.store.vehicles.at(kV1).leg_data.nodes.size()) {
        world.run(0.1);
    }

    while (world.vehicle("V1").step()) {
    }
    world.crash_server();
    world.run(5);

    EXPECT_EQ(world.store.stops.size(), 1u);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
}

TEST(Fleet, AVehicleThatRestartsInMidLegWaitsForPoseAndPerson) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(0.8);

    world.vehicle("V1").restart();
    world.run(20);

    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
    EXPECT_EQ(world.only_order().reason.code, "vehicle_lost_order");
    EXPECT_FALSE(world.fleet->vehicle(kV1, world.now)->pose_known);
    const int steps = world.vehicle("V1").node_steps;

    // A person looks where it stands, says so, and lets it move.
    const Pose2 pose = *world.vehicle("V1").state.pose;
    ASSERT_TRUE(world.fleet->init_position(kV1, {pose}, "op", world.now));
    world.run(2);
    EXPECT_EQ(world.vehicle("V1").node_steps, steps) << "a position moves nothing";
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
}

TEST(Fleet, AVehicleOnItsCodesIsToldItsPose) {
    World world;
    world.connect_all();

    world.run(1);

    EXPECT_TRUE(world.fleet->vehicle(kV1, world.now)->pose_known);
    EXPECT_EQ(world.store.vehicles.at(kV1).at_station, plant::StationId("s1"));
}

TEST(Fleet, CrashesAtEveryMomentLoseAndDoubleNothing) {
    for (int moment = 0; moment < 150; ++moment) {
        SCOPED_TRACE(moment);
        World world;
        world.connect_all();
        ASSERT_TRUE(world.order("V1", {2, 3, 2}));
        world.run(0.15 * moment);
        const bool finished = is_final(world.only_order().state);
        const auto id = world.only_order().id;

        world.crash_server();
        const auto& record = world.store.vehicles.at(kV1);
        const auto base_end = record.has_leg ? record.leg_data.released_nodes : 0;
        world.run(15);
        if (!finished && world.store.vehicles.at(kV1).has_leg) {
            EXPECT_EQ(world.store.vehicles.at(kV1).leg_data.released_nodes, base_end);
        }
        if (world.fleet->vehicle(kV1, world.now)->needs_resume) {
            ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
        }
        world.run(90);

        ASSERT_EQ(world.store.orders.size(), 1u);
        EXPECT_EQ(world.store.orders.at(id).state, JobState::kEnded);
        int inside = 0;
        for (const auto& stop : world.store.stops) inside += stop.inside ? 1 : 0;
        EXPECT_EQ(inside, 3) << "one good stop a step";
    }
}

}  // namespace
}  // namespace pulseline::fleet::testing
