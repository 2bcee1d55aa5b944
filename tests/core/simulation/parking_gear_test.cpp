#include "core/simulation/machine/parking_gear.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/gravity.hpp"
#include "core/simulation/world/floor_height.hpp"
#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::simulation {
namespace {

constexpr double kLoad_kg = 18200;

class Parking : public ::testing::Test {
protected:
    ParkingGear gear(FloorUnder floor_under, double load_kg = kLoad_kg,
                     geometry::Point2 centre = {-0.3, 0}) {
        ParkingGear made(type, std::move(floor_under), 5);
        made.set_load(load_kg, centre);
        return made;
    }
    static double run(ParkingGear& gear) {
        double t_s = 0;
        for (; gear.moving() && t_s < 200; t_s += 0.01) gear.step(0.01);
        return t_s;
    }
    static double sum_n(ParkingGear& gear) {
        double sum_n = 0;
        for (std::size_t i = 0; i < gear.count(); ++i) sum_n += gear.force_n(i);
        return sum_n;
    }

    plant::VehicleType type = pulseline::testing::platform();
    const double weight_n = (type.mass_kg + kLoad_kg) * kGravity_mps2;
};

std::optional<double> even(geometry::Point2) { return 0; }

TEST_F(Parking, FeetTakeTheWholeWeightOffTheWheels) {
    ParkingGear feet = gear(even);
    feet.lower();
    EXPECT_LT(run(feet), 25);
    EXPECT_FALSE(feet.stop_cause());
    EXPECT_NEAR(sum_n(feet), weight_n, 0.02 * weight_n);
    EXPECT_GT(feet.plane()[0], 0.015);
    for (std::size_t i = 0; i < feet.count(); ++i) {
        EXPECT_NEAR(feet.extension_m(i), 0.12, 0.003);
        EXPECT_LT(feet.force_n(i), type.parking->rating_n);
    }
    feet.raise();
    run(feet);
    EXPECT_FALSE(feet.stop_cause());
    EXPECT_FALSE(feet.extended());
    EXPECT_EQ(sum_n(feet), 0);
}

TEST_F(Parking, OnUnevenFloorEachGoesAsFarAsItHasToAndTheVehicleDoesNotTilt) {
    const auto floor = [](geometry::Point2 body) -> std::optional<double> {
        return body.x_m > 5.1 ? -0.02 : 0;  // the front feet stand lower than all else
    };
    ParkingGear feet = gear(floor);
    feet.lower();
    run(feet);
    ASSERT_FALSE(feet.stop_cause()) << feet.stop_cause()->code;
    EXPECT_NEAR(feet.extension_m(0) - feet.extension_m(2), 0.02, 0.003);
    EXPECT_LT(std::abs(feet.plane()[1]), 0.0005);
    EXPECT_LT(std::abs(feet.plane()[2]), 0.0005);
    EXPECT_NEAR(sum_n(feet), weight_n, 0.02 * weight_n);
}

TEST_F(Parking, AFootWithoutFloorRaisesNothingAndAllGoUpAgain) {
    const auto pit = [](geometry::Point2 body) -> std::optional<double> {
        if (body.x_m > 5.1 && body.y_m > 1) return std::nullopt;
        return 0;
    };
    ParkingGear feet = gear(pit);
    const double before_m = [&] {
        ParkingGear other = gear(even);
        other.lower();
        other.stop();
        return other.plane()[0];
    }();
    feet.lower();
    double highest_m = -1;
    for (double t_s = 0; feet.moving() && t_s < 200; t_s += 0.01) {
        feet.step(0.01);
        highest_m = std::max(highest_m, feet.plane()[0]);
    }
    ASSERT_TRUE(feet.stop_cause());
    EXPECT_EQ(feet.stop_cause()->code, "foot_without_floor");
    EXPECT_EQ(std::get<std::string>(feet.stop_cause()->params[0].value), "front left");
    EXPECT_FALSE(feet.extended());
    EXPECT_LT(highest_m - before_m, 0.002);
}

TEST_F(Parking, AnOverloadedFootLetsDownAgain) {
    // All of the load far forward and left: more than that foot may carry.
    ParkingGear feet = gear(even, 22000, {4, 0.9});
    feet.lower();
    run(feet);
    ASSERT_TRUE(feet.stop_cause());
    EXPECT_EQ(feet.stop_cause()->code, "foot_overloaded");
    EXPECT_EQ(std::get<std::string>(feet.stop_cause()->params[0].value), "front left");
    EXPECT_FALSE(feet.extended());
}

TEST_F(Parking, FloorThatGivesWayUnderAFootIsToldAndAllComeDown) {
    bool gone = false;
    const auto floor = [&](geometry::Point2 body) -> std::optional<double> {
        if (gone && body.x_m < -5.1 && body.y_m < -1) return -0.05;
        return 0;
    };
    ParkingGear feet = gear(floor);
    feet.lower();
    while (feet.moving() && feet.plane()[0] < 0.01) feet.step(0.01);
    ASSERT_TRUE(feet.moving());
    gone = true;
    run(feet);
    ASSERT_TRUE(feet.stop_cause());
    EXPECT_EQ(feet.stop_cause()->code, "foot_lost_contact");
    EXPECT_FALSE(feet.extended());
}

TEST_F(Parking, WhatStandsFeelsALoadThatComesAndAFloorThatGoes) {
    ParkingGear feet = gear(even, 0, {});
    feet.lower();
    run(feet);
    const double empty_n = sum_n(feet);
    feet.set_load(kLoad_kg, {-0.3, 0});
    EXPECT_NEAR(sum_n(feet), empty_n + kLoad_kg * kGravity_mps2, 0.02 * weight_n);
    EXPECT_FALSE(feet.dig("fifth"));
    ASSERT_TRUE(feet.dig("back right"));
    EXPECT_EQ(feet.force_n(*feet.find("back right")), 0);
    EXPECT_NEAR(sum_n(feet), weight_n, 0.05 * weight_n) << "on the others, and the wheels there";
}

TEST_F(Parking, LoweredTwiceOrStoppedInBetweenItIsRaisedAsFarAsOnce) {
    ParkingGear once = gear(even);
    once.lower();
    run(once);
    const double raised_m = once.plane()[0];
    once.lower();
    run(once);
    EXPECT_NEAR(once.plane()[0], raised_m, 1e-4);

    ParkingGear stopped = gear(even);
    stopped.lower();
    while (stopped.moving() && stopped.plane()[0] < 0.01) stopped.step(0.01);
    stopped.stop();
    stopped.lower();
    run(stopped);
    EXPECT_FALSE(stopped.stop_cause());
    EXPECT_NEAR(stopped.plane()[0], raised_m, 5e-4);
}

TEST_F(Parking, OneAloneGoesDownUntilItTouchesAndLiftsNothing) {
    ParkingGear feet = gear(even);
    feet.lower(2);
    run(feet);
    ASSERT_FALSE(feet.stop_cause());
    EXPECT_NEAR(feet.extension_m(2), type.parking->clearance_m, 0.003);
    for (const std::size_t other : {0, 1, 3}) EXPECT_EQ(feet.extension_m(other), 0);
    EXPECT_LT(sum_n(feet), 0.1 * weight_n);

    feet.lower();
    run(feet);
    EXPECT_FALSE(feet.stop_cause());
    EXPECT_NEAR(sum_n(feet), weight_n, 0.02 * weight_n) << "all take it then as ever";
    feet.raise();
    run(feet);
    EXPECT_FALSE(feet.extended());
}

/// The server takes it for up, and sends the vehicle away.
TEST_F(Parking, StoppedJustBelowTheirSwitchesTheyHoldNothing) {
    ParkingGear feet = gear([](geometry::Point2) { return 0.0; });
    feet.lower();
    run(feet);
    feet.raise();
    while (feet.extension_m(0) > 0.8 * plant::kFootDown_m) feet.step(0.01);
    feet.stop();
    EXPECT_GT(feet.extension_m(0), 0);
    EXPECT_FALSE(feet.extended());
    EXPECT_LT(sum_n(feet), 1);
}

TEST_F(Parking, OneAloneWithoutFloorStaysWhereItIsAndSaysSo) {
    ParkingGear feet = gear([](geometry::Point2 body) -> std::optional<double> {
        if (body.x_m > 5.1 && body.y_m > 1) return std::nullopt;
        return 0;
    });
    feet.lower(0);
    run(feet);
    ASSERT_TRUE(feet.stop_cause());
    EXPECT_EQ(feet.stop_cause()->code, "foot_reaches_no_floor");
    EXPECT_TRUE(feet.extended());
    feet.raise(0);
    run(feet);
    EXPECT_FALSE(feet.stop_cause());
    EXPECT_FALSE(feet.extended());
}

TEST_F(Parking, StandsWhereItIsWhenStopped) {
    ParkingGear feet = gear(even);
    feet.lower();
    for (int i = 0; i < 300; ++i) feet.step(0.01);
    feet.stop();
    const double at_m = feet.extension_m(1);
    EXPECT_GT(at_m, 0.01);
    feet.step(5);
    EXPECT_EQ(feet.extension_m(1), at_m);
    feet.raise();
    run(feet);
    EXPECT_FALSE(feet.extended());
}

TEST_F(Parking, TheFloorOfAHallIsEvenEnough) {
    for (double x_m = 0; x_m < 120; x_m += 3.7) {
        for (double y_m = 0; y_m < 60; y_m += 2.9) {
            const geometry::Pose2 place{x_m, y_m, 0.01 * x_m};
            ParkingGear feet =
                gear([&](geometry::Point2 body) { return usual_floor_height(place * body); });
            if (std::fmod(x_m, 37) > 3.7 || std::fmod(y_m, 29) > 2.9) continue;
            feet.lower();
            run(feet);
            EXPECT_FALSE(feet.stop_cause()) << x_m << ' ' << y_m;
        }
    }
}

}  // namespace
}  // namespace pulseline::simulation
