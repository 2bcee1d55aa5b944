#include "core/simulation/machine/lifting_drive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pulseline::simulation {
namespace {

constexpr double kStep_s = 0.01;
constexpr double kWeight_n = 18000 * 9.80665;

LiftingDrive brackets(const LiftParameters& parameters = {}, std::uint64_t seed = 1) {
    LiftingDrive lifts({{"front left", {2.4, 0.7}},
                        {"front right", {2.4, -0.7}},
                        {"back left", {-3.0, 0.7}},
                        {"back right", {-3.0, -0.7}}},
                       parameters, seed);
    lifts.set_load(18000, {-0.3, 0});
    return lifts;
}

void run(LiftingDrive& lifts) {
    for (int i = 0; i < 10000 && lifts.moving(); ++i) lifts.step(kStep_s);
}

double force_n(LiftingDrive& lifts, std::size_t lift) {
    const auto forces = lifts.forces(lift);
    return forces.a_n + forces.b_n;
}

double spread_m(const LiftingDrive& lifts) {
    double least = lifts.height_m(0);
    double most = least;
    for (std::size_t i = 1; i < lifts.places().size(); ++i) {
        least = std::min(least, lifts.height_m(i));
        most = std::max(most, lifts.height_m(i));
    }
    return most - least;
}

TEST(LiftingDrive, AllInStepStayWithinAMillimetreAndArrive) {
    auto lifts = brackets();
    for (const double height_m : {0.1, 0.02}) {
        ASSERT_FALSE(lifts.begin(std::nullopt, height_m));
        while (lifts.moving()) {
            lifts.step(kStep_s);
            ASSERT_LT(spread_m(lifts), 1e-3);
        }
        EXPECT_FALSE(lifts.stop_cause());
        for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(lifts.height_m(i), height_m, 1.5e-4);
    }
}

TEST(LiftingDrive, ALoadDoesNotSinkWhenTheBrakesOpen) {
    auto lifts = brackets();
    lifts.begin(std::nullopt, 0.05);
    for (int i = 0; i < 50; ++i) {
        lifts.step(kStep_s);
        ASSERT_GT(lifts.height_m(0), -1e-4);
    }
}

TEST(LiftingDrive, TakesItsTime) {
    const LiftParameters parameters;
    auto lifts = brackets(parameters);
    lifts.begin(std::nullopt, 0.1);
    double t_s = 0;
    for (; lifts.moving(); t_s += kStep_s) lifts.step(kStep_s);
    const double profile_s =
        0.1 / parameters.speed_mps + parameters.speed_mps / parameters.accel_mps2;
    EXPECT_NEAR(t_s, profile_s, 2);
}

TEST(LiftingDrive, LevelHeightsShareTheLoadByItsCentre) {
    auto lifts = brackets();
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(force_n(lifts, i), kWeight_n / 4, 0.01 * kWeight_n);
    }
    lifts.set_load(18000, {2.4, 0});
    EXPECT_NEAR(force_n(lifts, 0), kWeight_n / 2, 0.02 * kWeight_n);
    EXPECT_NEAR(force_n(lifts, 2), 0, 0.02 * kWeight_n);
}

TEST(LiftingDrive, OneRaisedALittleTakesMoreAndItsDiagonalToo) {
    auto lifts = brackets();
    ASSERT_FALSE(lifts.begin(0, 0.002));
    run(lifts);
    EXPECT_FALSE(lifts.stop_cause());
    EXPECT_GT(force_n(lifts, 0), kWeight_n / 4 + 5000);
    EXPECT_GT(force_n(lifts, 3), kWeight_n / 4 + 5000);
    EXPECT_LT(force_n(lifts, 1), kWeight_n / 4 - 5000);
    double sum_n = 0;
    for (std::size_t i = 0; i < 4; ++i) sum_n += force_n(lifts, i);
    EXPECT_NEAR(sum_n, kWeight_n, 0.01 * kWeight_n);
}

TEST(LiftingDrive, ForceOutOfRangeStopsAndSaysWhichAndTheWayBackIsOpen) {
    auto lifts = brackets();
    ASSERT_FALSE(lifts.begin(0, 0.1));
    run(lifts);
    ASSERT_TRUE(lifts.stop_cause());
    EXPECT_EQ(lifts.stop_cause()->code, "bracket_force_out_of_range");
    ASSERT_EQ(lifts.stop_cause()->params.size(), 3u);
    EXPECT_EQ(lifts.stop_cause()->params[0].name, "bracket");
    const double at = lifts.height_m(0);
    EXPECT_LT(at, 0.03);
    lifts.step(1);
    EXPECT_EQ(lifts.height_m(0), at);

    ASSERT_FALSE(lifts.begin(0, 0));
    run(lifts);
    EXPECT_FALSE(lifts.stop_cause());
    EXPECT_EQ(lifts.height_m(0), 0);
}

TEST(LiftingDrive, LiftsAtOtherHeightsComeLevelFirst) {
    auto lifts = brackets();
    lifts.set_load(0, {});
    lifts.begin(0, 0.05);
    run(lifts);
    lifts.begin(std::nullopt, 0.08);
    while (lifts.height_m(1) < 0.045) {
        lifts.step(kStep_s);
        ASSERT_NEAR(lifts.height_m(0), 0.05, 2e-4);  // it waits for the others
    }
    while (lifts.moving()) {
        lifts.step(kStep_s);
        ASSERT_LT(spread_m(lifts), 6e-3);
    }
    EXPECT_LT(spread_m(lifts), 3e-4);
}

TEST(LiftingDrive, RefusesWhatIsBeyondItsLimitSwitchesAndWhileMoving) {
    auto lifts = brackets();
    for (const double height_m : {-0.01, 0.31, std::nan("")}) {
        const auto why_not = lifts.begin(std::nullopt, height_m);
        ASSERT_TRUE(why_not);
        EXPECT_EQ(why_not->code, "out_of_stroke");
    }
    EXPECT_FALSE(lifts.begin(std::nullopt, 0.3));
    lifts.step(1);
    EXPECT_EQ(lifts.begin(1, 0.1)->code, "lifts_moving");
    lifts.stop();
    EXPECT_FALSE(lifts.begin(1, lifts.height_m(1)));
}

}  // namespace
}  // namespace pulseline::simulation
