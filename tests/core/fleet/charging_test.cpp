#include <gtest/gtest.h>

#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");
const plant::VehicleId kV2("V2");

/// Station 2, or another, is a charger; nobody stands there.
plant::Plant plant_with_charger(std::size_t number = 2) {
    plant::Plant plant = small_plant();
    for (auto& station : plant.stations) station.resting_place = true;
    plant.stations[number - 1].charger = true;
    return plant;
}

struct Charging : ::testing::Test {
    explicit Charging(std::size_t station = 2) : world(plant_with_charger(station)) {
        world.connect_all();
        world.announce({"startCharging", "stopCharging"});
    }
    FakeVehicle& v1() { return world.vehicle("V1"); }
    FakeVehicle& v2() { return world.vehicle("V2"); }
    VehicleView view(const plant::VehicleId& id) { return *world.fleet->vehicle(id, world.now); }
    std::string why(const plant::VehicleId& id) { return view(id).reason.value_or(Reason{}).code; }
    /// V1 charges at station 2.
    void charge_v1(double percent) {
        v1().state.battery_percent = percent;
        world.run(30);
        ASSERT_TRUE(v1().state.charging);
    }
    World world;
};

struct ChargingFarAway : Charging {
    ChargingFarAway() : Charging(3) {}
};

TEST_F(Charging, AnIdleLowVehicleDrivesToTheChargerAndCharges) {
    v1().state.battery_percent = 29;
    world.run(0.3);
    EXPECT_EQ(why(kV1), "goes_charging");
    EXPECT_EQ(world.told.at(plant::StationId("s2")).reserved_by, kV1);

    world.run(30);
    EXPECT_EQ(world.stations_told_wrong(), std::vector<int>{});
    EXPECT_EQ(view(kV1).at_station, plant::StationId("s2"));
    EXPECT_TRUE(v1().state.charging);
    EXPECT_EQ(view(kV1).activity, Activity::kCharging);
    EXPECT_EQ(v1().actions_done, (std::vector<std::string>{"adjustToMarker", "startCharging"}));
    EXPECT_EQ(world.count_events("vehicle.goes_charging"), 1);
    EXPECT_TRUE(world.store.orders.empty()) << "no order of anybody's";
}

TEST_F(Charging, AnOrderComesBeforeALowBatteryAndNotBeforeACriticalOne) {
    v1().state.battery_percent = 20;
    v1().state.charging = false;
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(30);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);

    v1().state.battery_percent = 14;
    world.run(30);
    ASSERT_TRUE(v1().state.charging);
    const auto second = world.order("V1", {3});
    ASSERT_TRUE(second);
    world.run(5);
    EXPECT_EQ(world.stored(second->order.id).state, JobState::kAllowedToStart);
    EXPECT_EQ(world.stored(second->order.id).reason.code, "battery_charging");
}

TEST_F(Charging, WithoutAChargerACriticalOneSaysSo) {
    v1().state.battery_percent = 10;
    v2().state.battery_percent = 9;
    world.run(30);
    EXPECT_TRUE(v2().state.charging) << "the emptier one";
    EXPECT_EQ(why(kV1), "no_free_charger");
    const auto order = world.order("V1", {3});
    ASSERT_TRUE(order);
    world.run(2);
    EXPECT_EQ(world.stored(order->order.id).reason.code, "battery_low");
}

TEST_F(Charging, IsEndedForAnOrderWhenItIsEnough) {
    charge_v1(20);
    const auto order = world.order("V1", {3});
    ASSERT_TRUE(order);
    world.run(10);
    EXPECT_EQ(view(kV1).at_station, plant::StationId("s2")) << "not enough yet";

    v1().state.battery_percent = 60;
    world.run(1);
    EXPECT_FALSE(v1().state.charging) << "told to stop before it drives";
    world.run(30);
    EXPECT_EQ(world.stored(order->order.id).state, JobState::kEnded);
}

TEST_F(Charging, TheOneThatChargesIsNotSentAwayForAnother) {
    charge_v1(20);
    ASSERT_TRUE(world.order("V2", {2}));
    world.run(30);
    EXPECT_EQ(view(kV1).at_station, plant::StationId("s2"));
    EXPECT_EQ(world.only_order().reason.code, "floor_held");

    v1().state.battery_percent = 70;
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << "it made way";
    EXPECT_FALSE(v1().state.charging);
}

TEST_F(Charging, ThatFailsIsTriedAgainAfterAMinute) {
    v1().action_fails = "startCharging";
    v1().state.battery_percent = 20;
    world.run(30);
    EXPECT_EQ(world.count_events("vehicle.charge_failed"), 1);
    EXPECT_EQ(why(kV1), "charge_failed");

    v1().action_fails = "";
    world.run(60);
    EXPECT_TRUE(v1().state.charging);
}

TEST_F(ChargingFarAway, GoesOnAfterARestartWhenAPersonAllowsIt) {
    v1().state.battery_percent = 20;
    world.run(2);
    world.crash_server();
    world.announce({"startCharging", "stopCharging"});
    world.run(60);
    EXPECT_FALSE(v1().state.charging);

    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.settle();
    world.run(60);
    EXPECT_TRUE(v1().state.charging);
}

TEST_F(Charging, NeedsAnActionThatTheVehicleAnnounces) {
    world.announce({});
    v1().state.battery_percent = 20;
    world.run(5);
    EXPECT_EQ(why(kV1), "charge_not_announced");
    EXPECT_EQ(view(kV1).at_station, plant::StationId("s1"));
}

}  // namespace
}  // namespace pulseline::fleet::testing
