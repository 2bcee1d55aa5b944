#include "core/fleet/fleet.hpp"

#include <gtest/gtest.h>

#include "tests/core/fleet/fleet_world.hpp"

// What the silence of a vehicle means for it and for those who have its orders.
namespace pulseline::fleet::testing {
namespace {

using plant::VehicleId;

const VehicleId kV1("V1");

TEST(Fleet, AnOrderForAGoneVehicleIsRefused) {
    World world;
    world.connect_all();
    world.connected[kV1] = false;
    world.fleet->vehicle_disconnected(kV1, world.now);
    world.run(61);

    const auto refused = world.order("V1", {2});

    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, Errc::kConflict);
    EXPECT_EQ(refused.error().reason.code, "vehicle_gone");
}

TEST(Fleet, SilenceIsLateLostGone) {
    World world;
    world.connect_all();
    world.connected[kV1] = false;

    world.run(3);
    EXPECT_EQ(world.fleet->vehicle(kV1, world.now)->link, Link::kLate);
    world.run(8);
    EXPECT_EQ(world.fleet->vehicle(kV1, world.now)->link, Link::kLost);
    world.run(50);
    EXPECT_EQ(world.fleet->vehicle(kV1, world.now)->link, Link::kGone);
}

TEST(Fleet, NoSilenceCountsWhileTheStoreFailsOfThoseWhoAreGoneEither) {
    World world;
    world.connect_all();
    world.connected[kV1] = false;
    world.fleet->vehicle_disconnected(kV1, world.now);
    world.run(1);
    world.fleet->store_failed({"disk_full", world.now}, world.now);
    world.now += std::chrono::seconds(20);
    world.fleet->store_works_again(world.now);
    world.run(5);
    EXPECT_EQ(world.fleet->vehicle(kV1, world.now)->link, Link::kLate);
    world.run(5);
    EXPECT_EQ(world.fleet->vehicle(kV1, world.now)->link, Link::kLost);
}

TEST(Fleet, NoBaseIsExtendedToASilentVehicle) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.vehicles_move = false;
    world.run(1);
    const auto released = world.store.vehicles.at(kV1).leg_data.released_nodes;
    ASSERT_LT(released, world.store.vehicles.at(kV1).leg_data.nodes.size());
    world.connected[kV1] = false;
    world.vehicles_move = true;

    world.run(30);

    EXPECT_EQ(world.store.vehicles.at(kV1).leg_data.released_nodes, released);
    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
    EXPECT_TRUE(world.store.vehicles.at(kV1).needs_resume) << "lost: a person lets it move again";
}

}  // namespace
}  // namespace pulseline::fleet::testing
