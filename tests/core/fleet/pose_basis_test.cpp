// What a vehicle's pose rests on, and what its arrivals say of how it reckons.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::fleet::testing {
namespace {

// Stations 1 to 4 stand at 12, 24, 36 and 48 m; V1 at the first.
const plant::VehicleId kV1("V1");

VehicleView view(World& world) { return *world.fleet->vehicle(kV1, world.now); }

TEST(PoseBasis, SaysWhatAKnownPoseRestsOnAndHowFarItHasDrivenSince) {
    World world;
    world.connect_all();
    world.run(1);
    const auto basis = [&] { return view(world).pose_basis.value_or(PoseBasis{}); };
    EXPECT_EQ(basis().kind, PoseBasis::Kind::kCodes) << "its cameras stand over surveyed codes";

    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);
    EXPECT_EQ(basis().kind, PoseBasis::Kind::kStop);
    EXPECT_EQ(basis().station, plant::StationId("s2"));
    EXPECT_EQ(basis().at, world.store.stops.back().at);
    EXPECT_EQ(basis().driven_m, 0);

    ASSERT_TRUE(world.order("V1", {3}));
    double furthest_m = 0;
    for (int i = 0; i < 600 && basis().station == plant::StationId("s2"); ++i) {
        furthest_m = std::max(furthest_m, basis().driven_m);
        world.run(0.1);
    }
    EXPECT_NEAR(furthest_m, 12, 0.5) << "from the stop at station 2 to that at station 3";
    EXPECT_EQ(basis().station, plant::StationId("s3"));

    ASSERT_TRUE(world.fleet->init_position(kV1, {36, 20, 0}, "ann", world.now));
    world.settle();
    world.run(1);
    EXPECT_EQ(basis().kind, PoseBasis::Kind::kStatement);
    EXPECT_EQ(basis().actor, "ann");
}

TEST(PoseBasis, OutlivesARestartAndWhatMayHaveBeenDrivenMeanwhileCounts) {
    World world;
    world.connect_all();
    world.run(1);
    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);
    ASSERT_EQ(view(world).pose_basis.value_or(PoseBasis{}).kind, PoseBasis::Kind::kStop);
    const Time at = view(world).pose_basis->at;

    world.crash_server();
    ASSERT_TRUE(view(world).pose_basis);
    EXPECT_EQ(view(world).pose_basis->station, plant::StationId("s2"));
    EXPECT_EQ(view(world).pose_basis->at, at);
    EXPECT_EQ(view(world).pose_basis->driven_m, 0) << "it stands";

    world.run(1);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "ann", world.now));
    world.settle();
    ASSERT_TRUE(world.order("V1", {3}));
    for (int i = 0; i < 600 && view(world).pose_basis->driven_m < 2; ++i) world.run(0.1);
    const double driven_m = view(world).pose_basis->driven_m;
    ASSERT_GT(driven_m, 1);
    world.crash_server();
    EXPECT_GE(view(world).pose_basis->driven_m, driven_m) << "it may have gone to its base's end";
    EXPECT_LE(view(world).pose_basis->driven_m, 13);
}

TEST(Arrival, IsKeptBesideWhatWasUsualWhenTheDriveBeganAtAMeasuredStop) {
    World world;
    world.connect_all();
    world.run(1);
    world.vehicle("V1").arrival_error = Pose2{0.004, -0.003, 0.002};
    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);
    ASSERT_EQ(world.store.stops.size(), 1u);
    const auto first = world.store.stops.back().arrival;
    ASSERT_TRUE(first);
    EXPECT_NEAR(first->dx_m, 0.004, 1e-12);
    EXPECT_NEAR(first->dy_m, -0.003, 1e-12);
    EXPECT_NEAR(first->dheading_rad, 0.002, 1e-12);
    EXPECT_EQ(first->expected_m, 0) << "nobody had measured where it began";

    ASSERT_TRUE(world.order("V1", {3}));
    world.run(60);
    ASSERT_EQ(world.store.stops.size(), 2u);
    const auto second = world.store.stops.back().arrival;
    ASSERT_TRUE(second);
    EXPECT_GT(second->expected_m, 0.001);
    EXPECT_LT(second->expected_m, 0.02);
    EXPECT_GT(second->expected_rad, 0);
}

TEST(Arrival, ThatCannotBeIsLeftOutAndTheStopKept) {
    for (const double off_m : {5.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
        World world;
        world.connect_all();
        world.run(1);
        world.vehicle("V1").arrival_error = Pose2{off_m, 0, 0};
        ASSERT_TRUE(world.order("V1", {2}));
        world.run(60);
        ASSERT_EQ(world.store.stops.size(), 1u) << off_m;
        EXPECT_FALSE(world.store.stops.back().arrival) << off_m;
    }
}

TEST(Arrival, WithoutADriveTeachesNothing) {
    World world;
    world.connect_all();
    world.run(1);
    world.vehicle("V1").arrival_error = Pose2{0.004, 0, 0};
    for (int i = 0; i < 2; ++i) {
        ASSERT_TRUE(world.order("V1", {2}));
        world.run(60);
    }
    ASSERT_EQ(world.store.stops.size(), 2u) << "it measures again where it stands";
    ASSERT_TRUE(world.store.stops.back().arrival);
    EXPECT_EQ(world.store.stops.back().arrival->expected_m, 0);
}

TEST(Arrival, AfterAWayThatBeganElsewhereSaysNothingOfTheVehicle) {
    World world;
    world.connect_all();
    world.run(1);
    world.vehicle("V1").arrival_error = Pose2{0.004, 0, 0};
    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);
    // The second one is cancelled on its way, and begun anew from there.
    const auto cancelled = world.order("V1", {3});
    ASSERT_TRUE(cancelled);
    for (int i = 0; i < 600 && view(world).pose_basis->driven_m < 4; ++i) world.run(0.1);
    ASSERT_TRUE(world.fleet->cancel_order(cancelled->order.id, std::nullopt, "ann", world.now));
    world.settle();
    world.run(20);
    ASSERT_EQ(world.store.stops.size(), 1u) << "cancelled too late";
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(80);
    ASSERT_EQ(world.store.stops.size(), 2u);
    ASSERT_TRUE(world.store.stops.back().arrival);
    EXPECT_EQ(world.store.stops.back().arrival->expected_m, 0);
}

}  // namespace
}  // namespace pulseline::fleet::testing
