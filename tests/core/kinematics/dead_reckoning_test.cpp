#include "core/kinematics/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/kinematics/primitives.hpp"
#include "tests/core/kinematics/vehicle_types.hpp"

namespace pulseline::kinematics {
namespace {

/// Where one vehicle with these constants and this chance ends.
Pose2 driven(const std::vector<Segment>& segments, const DeadReckoningNoise& noise,
             std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const double distance = 1 + noise.distance_scale * normal(random);
    const double turn = 1 + noise.turn_scale * normal(random);
    const double bias = noise.steering_bias_rad * normal(random);
    Pose2 pose = segments.front().start;
    for (const Segment& segment : segments) {
        constexpr int kSteps = 200;
        for (int i = 0; i < kSteps; ++i) {
            const Pose2 step = inverse(pose_at(segment, i / double(kSteps))) *
                               pose_at(segment, (i + 1) / double(kSteps));
            const double way = norm(step.position());
            const double slip = noise.slip_m_per_sqrt_m * std::sqrt(way);
            const Point2 moved = Pose2{0, 0, bias} * (distance * step.position());
            pose =
                pose * Pose2{moved.x_m + slip * normal(random), moved.y_m + slip * normal(random),
                             turn * step.heading_rad +
                                 noise.heading_rad_per_sqrt_m * std::sqrt(way) * normal(random) +
                                 noise.heading_rad_per_sqrt_rad *
                                     std::sqrt(std::abs(step.heading_rad)) * normal(random)};
        }
    }
    return pose;
}

TEST(ExpectedDeviation, IsWhatManyVehiclesShow) {
    DeadReckoningNoise noise;
    noise.stop_m = 0;
    noise.stop_rad = 0;
    for (const MotionMode mode : {MotionMode::kLinear, MotionMode::kFixedAxisRotation}) {
        const auto plan = plan_motion(tang_platform(), {0, 0, 0.4}, {15, 12, -1}, mode);
        ASSERT_TRUE(plan);
        const auto expected = expected_deviation(plan->segments, noise);
        std::mt19937_64 random(4);
        double xy = 0;
        double heading = 0;
        constexpr int kRuns = 2000;
        for (int i = 0; i < kRuns; ++i) {
            const Pose2 off =
                inverse(plan->segments.back().end) * driven(plan->segments, noise, random);
            xy += dot(off.position(), off.position());
            heading += off.heading_rad * off.heading_rad;
        }
        EXPECT_NEAR(std::sqrt(xy / kRuns) / expected.position_m, 1, 0.06);
        EXPECT_NEAR(std::sqrt(heading / kRuns) / expected.heading_rad, 1, 0.06);
    }
}

TEST(ExpectedDeviation, GrowsWithTheWayAndSidewaysOnRollersMost) {
    const auto noise = usual_noise(plant::Kinematics::kMecanum);
    const auto after = [&](Point2 to) {
        std::vector<Segment> segments;
        append_straight(segments, {0, 0, 0}, to);
        return expected_deviation(segments, noise).position_m;
    };
    EXPECT_LT(after({5, 0}), after({20, 0}));
    EXPECT_LT(after({10, 0}), after({10 / std::sqrt(2), 10 / std::sqrt(2)}));
    EXPECT_LT(after({10 / std::sqrt(2), 10 / std::sqrt(2)}), after({0, 10}));
    EXPECT_EQ(expected_deviation({}, noise).position_m, noise.stop_m);
}

/// Arrivals, after ways of many lengths, of a vehicle that reckons `times` as badly as its family.
std::vector<ArrivalMiss> arrivals_of(double times, std::size_t count, std::uint64_t seed) {
    const auto usual = usual_noise(plant::Kinematics::kSteeredPlatform);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> way(2, 80);
    std::vector<ArrivalMiss> arrivals;
    while (arrivals.size() < count) {
        std::vector<Segment> segments;
        append_straight(segments, {0, 0, 0}, {way(random), 0});
        const auto expected = expected_deviation(segments, usual);
        const double sigma_m = times * expected.position_m / std::sqrt(2);
        arrivals.push_back({std::hypot(sigma_m * normal(random), sigma_m * normal(random)),
                            std::abs(times * expected.heading_rad * normal(random)), expected});
    }
    return arrivals;
}

TEST(LearnedDeviation, OfAVehicleThatNeverArrivedIsItsFamilys) {
    const ExpectedDeviation usual{0.004, 0.002};
    EXPECT_EQ(learned_deviation(usual, {}).position_m, usual.position_m);
    EXPECT_EQ(learned_deviation(usual, {}).heading_rad, usual.heading_rad);
}

TEST(LearnedDeviation, BecomesWhatTheVehicleDoesWhetherWorseOrBetterThanItsFamily) {
    const ExpectedDeviation usual{0.004, 0.002};
    for (const double times : {0.3, 1.0, 3.0}) {
        double position = 0;
        double heading = 0;
        constexpr int kVehicles = 50;
        for (int i = 0; i < kVehicles; ++i) {
            const auto learned =
                learned_deviation(usual, arrivals_of(times, 20, static_cast<std::uint64_t>(i)));
            position += learned.position_m / (times * usual.position_m) / kVehicles;
            heading += learned.heading_rad / (times * usual.heading_rad) / kVehicles;
        }
        // The family still counts like 2 of 22: most where the vehicle is far better than it.
        EXPECT_NEAR(position, times < 1 ? 1.38 : 1, 0.08) << times;
        EXPECT_NEAR(heading, times < 1 ? 1.38 : 1, 0.08) << times;
    }
}

TEST(LearnedDeviation, OnePushDoesNotSayAll) {
    const ExpectedDeviation usual{0.004, 0.002};
    auto arrivals = arrivals_of(1, 20, 3);
    const double before_m = learned_deviation(usual, arrivals).position_m;
    arrivals.front().position_m = 1e3;
    const double after_m = learned_deviation(usual, arrivals).position_m;
    EXPECT_GT(after_m, 1.5 * before_m);
    EXPECT_LT(after_m, 3 * before_m);
}

}  // namespace
}  // namespace pulseline::kinematics
