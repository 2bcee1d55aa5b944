#include "core/fleet/orders/station_defaults.hpp"

#include <gtest/gtest.h>

#include "tests/core/fleet/fleet_world.hpp"

// What is done at a station where an order does not say it.
namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");

/// Vehicles with feet; at stations 2 and 3 they stand on them.
plant::Plant with_parking() {
    plant::Plant plant = small_plant();
    plant.vehicle_types.front().parking = plant::ParkingGear{};
    for (auto& station : plant.stations) {
        station.parks = station.number == 2 || station.number == 3;
    }
    return plant;
}

struct StationDefaults : ::testing::Test {
    StationDefaults() : world(with_parking()) {
        world.connect_all();
        world.announce({"raiseParking", "lowerParking"});
        v1().state.parking_feet = {{"front left", 0}};
        v1().on_action = [this](const std::string& type) {
            if (type == "lowerParking") v1().state.parking_feet = {{"front left", 0.12}};
            if (type == "raiseParking") v1().state.parking_feet = {{"front left", 0}};
        };
        world.run(1);
    }
    FakeVehicle& v1() { return world.vehicle("V1"); }
    std::vector<std::string> lifts() {
        std::vector<std::string> done;
        for (const auto& type : v1().actions_done) {
            if (type.ends_with("Parking")) done.push_back(type);
        }
        return done;
    }
    JobState state_of(const Result<Created>& made) { return world.stored(made->order.id).state; }

    World world;
};

TEST_F(StationDefaults, ATourStandsOnItsFeetWhereTheStationsAreForIt) {
    const auto made = world.order("V1", {2, 3, 1});
    ASSERT_TRUE(made) << made.error().what;
    const auto& steps = made->order.steps;
    EXPECT_EQ(steps[0].after, (std::vector<StepAction>{{"lowerParking", {}}}));
    EXPECT_EQ(steps[1].before, (std::vector<StepAction>{{"raiseParking", {}}}));
    EXPECT_EQ(steps[2].before, (std::vector<StepAction>{{"raiseParking", {}}}));
    EXPECT_TRUE(steps[2].after.empty());
    world.run(120);
    EXPECT_EQ(state_of(made), JobState::kEnded) << world.stored(made->order.id).reason.code;
    EXPECT_EQ(lifts(), (std::vector<std::string>{"lowerParking", "raiseParking", "lowerParking",
                                                 "raiseParking"}));
}

TEST_F(StationDefaults, TheNextOrderRaisesThemFirstAndSaysSo) {
    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);
    const auto made = world.order("V1", {1});
    ASSERT_TRUE(made);
    world.run(60);
    EXPECT_EQ(state_of(made), JobState::kEnded) << world.stored(made->order.id).reason.code;
    EXPECT_EQ(world.stored(made->order.id).steps[0].before,
              (std::vector<StepAction>{{"raiseParking", {}}}));
}

TEST_F(StationDefaults, WhatAnOrderSaysIsDoneInstead) {
    NewOrder order;
    order.vehicle = kV1;
    order.steps = {{2}, {3}};
    order.steps[0].says_after = true;
    order.steps[1].after = {{"lowerParking", {}}, {"raiseParking", {}}};
    const auto made = world.order(order);
    ASSERT_TRUE(made);
    world.run(90);
    EXPECT_EQ(state_of(made), JobState::kEnded) << world.stored(made->order.id).reason.code;
    EXPECT_EQ(lifts(), (std::vector<std::string>{"lowerParking", "raiseParking"}));
}

/// A person lowered them, at a station that is not for it: only a person knows why.
TEST_F(StationDefaults, OnFeetElsewhereItWaitsAsEver) {
    v1().state.parking_feet = {{"front left", 0.12}};
    world.run(1);
    const auto made = world.order("V1", {4});
    ASSERT_TRUE(made);
    world.run(10);
    EXPECT_EQ(world.stored(made->order.id).reason.code, "parking_feet_down");
}

TEST_F(StationDefaults, WhoCannotParkIsAskedForNothing) {
    world.announce({"raiseParking"});
    const auto made = world.order("V1", {2});
    ASSERT_TRUE(made) << made.error().what;
    EXPECT_TRUE(made->order.steps[0].after.empty());
}

}  // namespace
}  // namespace pulseline::fleet::testing
