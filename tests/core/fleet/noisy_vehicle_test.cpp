#include <gtest/gtest.h>

#include "tests/core/fleet/fleet_world.hpp"

// A vehicle or a client that says too much fills neither the disk nor the dashboards.
namespace pulseline::fleet::testing {
namespace {

/// The vehicle reports, ten times a second, what `errors` gives for the time.
template <class Errors>
void report(World& world, int seconds_long, Errors errors) {
    FakeVehicle& vehicle = world.vehicle("V1");
    for (int i = 0; i < 10 * seconds_long; ++i) {
        vehicle.state.errors = errors(i);
        ++vehicle.state.header_id;
        world.now += std::chrono::milliseconds(100);
        world.fleet->vehicle_state(plant::VehicleId("V1"), vehicle.state, world.now);
        world.fleet->tick(world.now);
        world.settle();
    }
}

TEST(NoisyVehicle, AnErrorIsItsTypeAndWhatItRefersToNotItsText) {
    World world;
    world.run(1);

    report(world, 60, [](int i) {
        return std::vector<vda5050::VehicleError>{
            {"batteryHot", false, "cell at " + std::to_string(i), {{"cell", "3"}}}};
    });

    EXPECT_EQ(world.count_events("vehicle.error"), 1);
}

TEST(NoisyVehicle, TheSameErrorOfAnotherPartIsAnotherError) {
    World world;
    world.run(1);

    report(world, 1, [](int i) {
        return std::vector<vda5050::VehicleError>{
            {"batteryHot", false, "hot", {{"cell", i < 5 ? "3" : "4"}}}};
    });

    EXPECT_EQ(world.count_events("vehicle.error"), 2);
}

TEST(NoisyVehicle, TellsOfTenErrorsAMinuteAndThenThatThereAreMore) {
    World world;
    world.run(1);
    const auto many = [](int i) {
        std::vector<vda5050::VehicleError> errors;
        for (int n = 0; n < 50; ++n) {
            errors.push_back({"e" + std::to_string(50 * i + n), false, "x", {}});
        }
        return errors;
    };

    report(world, 50, many);
    EXPECT_EQ(world.count_events("vehicle.error"), 10);
    EXPECT_EQ(world.count_events("vehicle.errors_withheld"), 1);

    report(world, 60, many);
    EXPECT_EQ(world.count_events("vehicle.error"), 20);
    EXPECT_EQ(world.count_events("vehicle.errors_withheld"), 2);
}

TEST(NoisyVehicle, RefusedMessagesCountAsErrors) {
    World world;
    world.run(1);

    for (int i = 0; i < 100; ++i) {
        const vda5050::VehicleError refused{
            "messageRefused", false, std::to_string(i), {{"field", "/x"}}};
        world.fleet->vehicle_message_refused(plant::VehicleId("V1"), refused, world.now);
    }
    world.settle();

    EXPECT_EQ(world.count_events("vehicle.message_malformed"), 10);
}

TEST(NoisyClient, FindsACeilingOfOpenOrders) {
    World world;
    world.vehicles_move = false;
    world.run(1);
    NewOrder request;
    request.vehicle = plant::VehicleId("V1");
    request.steps = {{1, plant::MotionMode::kAuto}};
    request.start = false;
    int made = 0;
    for (; made < 5000; ++made) {
        if (!world.fleet->create(request, world.now)) break;
    }
    world.settle();
    ASSERT_EQ(made, 5000);

    const auto refused = world.fleet->create(request, world.now);

    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "too_many_open_orders");
    EXPECT_EQ(refused.error().code, Errc::kConflict);
}

}  // namespace
}  // namespace pulseline::fleet::testing
