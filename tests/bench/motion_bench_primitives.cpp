#include "tests/bench/motion_bench_primitives.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "core/kinematics/motion.hpp"
#include "tests/core/kinematics/vehicle_types.hpp"

namespace pulseline::bench {
namespace {

using Clock = std::chrono::steady_clock;
using geometry::Pose2;
using plant::MotionMode;

constexpr int kPairs = 2000;
constexpr double kHall_m = 60;
constexpr double kLimit_us = 200;

Pose2 goal_for(MotionMode mode, const Pose2& from, const Pose2& to, double sideways_m) {
    if (mode == MotionMode::kSelfRotation) return {from.x_m, from.y_m, to.heading_rad};
    if (mode != MotionMode::kLateral) return to;
    const geometry::Point2 beside = from * geometry::Point2{0, sideways_m};
    return {beside.x_m, beside.y_m, to.heading_rad};
}

/// Microseconds of each plan and its sweep.
std::vector<double> measure(const plant::VehicleType& type, MotionMode mode) {
    const auto body = plant::outline_with_load(type, false);
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> place(0, kHall_m);
    std::uniform_real_distribution<double> turn(-kPi, kPi);
    std::vector<double> times_us;
    for (int i = 0; i < kPairs; ++i) {
        const Pose2 from{place(random), place(random), turn(random)};
        const Pose2 to{place(random), place(random), turn(random)};
        const Pose2 goal = goal_for(mode, from, to, place(random) / 4);
        const auto start = Clock::now();
        const auto plan = kinematics::plan_motion(type, from, goal, mode);
        const auto swept =
            plan ? kinematics::sweep(body, plan->segments) : std::vector<geometry::Polygon>{};
        const double us = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
        if (!swept.empty()) times_us.push_back(us);
    }
    std::ranges::sort(times_us);
    return times_us;
}

double quantile(const std::vector<double>& sorted, double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

nlohmann::json measure_primitives(bool& passed) {
    nlohmann::json out;
    std::printf("primitive and swept area, microseconds (limit %.0f at p99)\n", kLimit_us);
    for (const auto& type : {kinematics::tang_platform(), kinematics::mecanum_platform(),
                             kinematics::differential_vehicle()}) {
        for (const MotionMode mode : type.motion_modes) {
            const auto times = measure(type, mode);
            const double p50 = quantile(times, 0.5);
            const double p99 = quantile(times, 0.99);
            passed = passed && p99 <= kLimit_us;
            std::printf("  %-13s %-20s p50 %6.1f  p99 %6.1f  (%zu)\n", type.name.c_str(),
                        plant::to_string(mode), p50, p99, times.size());
            out[type.name][plant::to_string(mode)] = {
                {"p50_us", p50}, {"p99_us", p99}, {"motions", times.size()}};
        }
    }
    return out;
}

}  // namespace pulseline::bench
