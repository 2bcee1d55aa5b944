#include "core/simulation/machine/servo_axis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pulseline::simulation {
namespace {

constexpr double kCycle_s = ServoParameters{}.cycle_s;

ServoAxis loaded_axis(const ServoParameters& parameters, double load = 470) {
    ServoAxis axis(parameters, 1);
    axis.set_load(load);
    return axis;
}

TEST(ServoAxis, SettlesWithoutSteadyErrorAgainstAConstantForce) {
    ServoAxis axis = loaded_axis({});
    axis.set_external_force(-900);
    for (int i = 0; i < 800; ++i) axis.cycle(0.1, 0);
    EXPECT_NEAR(axis.position(), 0.1, 2e-5);
    EXPECT_NEAR(axis.velocity(), 0, 1e-4);
}

TEST(ServoAxis, WithoutFeedforwardThePositionLoopHasItsTimeConstant) {
    ServoParameters parameters;
    parameters.feedforward = 0;
    ServoAxis axis = loaded_axis(parameters);
    double t = 0;
    for (; axis.position() < 0.1 * (1 - std::exp(-1.0)) && t < 5; t += kCycle_s) axis.cycle(0.1, 0);
    const double dead_s = parameters.dead_cycles * kCycle_s;
    EXPECT_NEAR(t - dead_s, 1 / parameters.position_gain_per_s, 0.03);
}

TEST(ServoAxis, WithoutFeedforwardItLagsByVelocityOverGainAndWithItHardly) {
    const auto lag = [](double feedforward) {
        ServoParameters parameters;
        parameters.feedforward = feedforward;
        parameters.dead_cycles = 0;
        ServoAxis axis = loaded_axis(parameters);
        double wanted = 0;
        for (int i = 0; i < 600; ++i) axis.cycle(wanted += 0.5 * kCycle_s, 0.5);
        return wanted - axis.position();
    };
    EXPECT_NEAR(lag(0), 0.5 / 3.5, 0.01);
    EXPECT_LT(std::abs(lag(1)), 0.01);
}

TEST(ServoAxis, NeverExceedsCurrentAndSpeed) {
    ServoParameters parameters;
    parameters.speed_limit = 0.5;
    ServoAxis axis = loaded_axis(parameters, 3000);
    double most_a = 0;
    double most_speed = 0;
    bool at_limit = false;
    for (int i = 0; i < 1500; ++i) {
        axis.cycle(i < 700 ? 2 : -1, 0);
        most_a = std::max(most_a, std::abs(axis.current_a()));
        most_speed = std::max(most_speed, std::abs(axis.velocity()));
        at_limit |= axis.at_current_limit();
    }
    EXPECT_TRUE(at_limit);
    EXPECT_LE(most_a, parameters.current_limit_a);
    EXPECT_LE(most_speed, 1.02 * parameters.speed_limit);
    EXPECT_NEAR(axis.position(), -1, 1e-3);
}

TEST(ServoAxis, NothingMovesBeforeTheDeadTimeIsOver) {
    ServoParameters parameters;
    parameters.dead_cycles = 5;
    ServoAxis axis = loaded_axis(parameters);
    for (int i = 0; i < 5; ++i) axis.cycle(0.1, 0.2);
    EXPECT_LT(std::abs(axis.position()), 1e-6);
    for (int i = 0; i < 5; ++i) axis.cycle(0.1, 0.2);
    EXPECT_GT(axis.position(), 1e-3);
}

TEST(ServoAxis, LoadLowersTheAcceleration) {
    const auto reached = [](double load) {
        ServoAxis axis = loaded_axis({}, load);
        for (int i = 0; i < 40; ++i) axis.cycle(5, 0);
        return axis.velocity();
    };
    EXPECT_GT(reached(1000), 1.8 * reached(4000));
}

TEST(ServoAxis, FrictionHoldsWhatIsTooWeakToBreakIt) {
    ServoAxis axis = loaded_axis({});
    axis.set_external_force(30);  // below the Coulomb friction
    axis.brake();
    for (int i = 0; i < 200; ++i) axis.cycle(axis.measured_position(), 0);
    EXPECT_NEAR(axis.position(), 0, 1e-5);
}

TEST(ServoAxis, PreloadHoldsAWeightWhenTheBrakeOpens) {
    const auto sunk = [](double preload) {
        ServoAxis axis = loaded_axis({});
        axis.brake();
        axis.preload(preload);
        axis.set_external_force(-2000);
        double lowest = 0;
        for (int i = 0; i < 200; ++i) {
            axis.cycle(0, 0);
            lowest = std::min(lowest, axis.position());
        }
        return -lowest;
    };
    EXPECT_LT(sunk(2000), 1e-5);
    EXPECT_GT(sunk(0), 1e-3);
}

TEST(ServoAxis, ADeadEncoderRunsAwayFromItsCommand) {
    ServoAxis axis = loaded_axis({});
    axis.set_dead_encoder(true);
    double wanted = 0;
    for (int i = 0; i < 100; ++i) axis.cycle(wanted += 0.3 * kCycle_s, 0.3);
    EXPECT_EQ(axis.measured_position(), 0);
    EXPECT_GT(axis.following_error(), 0.25);
    EXPECT_GT(axis.position(), axis.following_error());
}

TEST(ServoAxis, SameSeedSameMotion) {
    const auto run = [](std::uint64_t seed) {
        ServoAxis axis({}, seed);
        axis.set_load(300);
        for (int i = 0; i < 100; ++i) axis.cycle(0.01 * i, 1);
        return axis.position();
    };
    EXPECT_EQ(run(3), run(3));
    EXPECT_NE(run(3), run(4));
}

}  // namespace
}  // namespace pulseline::simulation
