#include "core/control/dynamic_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/planning/counted_new.hpp"

namespace pulseline::control {
namespace {

using pulseline::testing::differential;
using pulseline::testing::mecanum;
using pulseline::testing::platform;
using State = WindowCommand::State;

constexpr double kStep_s = 0.05;

Pose2 moved(const Pose2& from, const Twist& twist, double dt_s) {
    const double half = twist.turn_radps * dt_s / 2;
    const double chord = std::abs(half) < 1e-9 ? 1 : std::sin(half) / half;
    const Pose2 step{chord * twist.vx_mps * dt_s, chord * twist.vy_mps * dt_s, 0};
    return from * (Pose2{0, 0, half} * step * Pose2{0, 0, half});
}

/// Drives an approach to its end; `look` sees each step before it is driven.
struct Approach {
    plant::VehicleType type;
    DynamicWindowOptions options = {};
    Pose2 target = {};
    std::vector<Point2> obstacles = {};  // hall frame
    std::function<void(const WindowInput&, const WindowCommand&)> look = {};
    geometry::Polygon corridor = {};
    int steps = 4000;

    State state = State::kDriving;
    Pose2 body = {};
    double time_s = 0;
    std::optional<Point2> blocked_by = {};

    void run(const Pose2& start) {
        DynamicWindow window(type, options);
        window.set_corridor(corridor);
        body = start;
        Twist present;
        for (int i = 0; i < steps; ++i) {
            std::vector<Point2> seen;
            for (const Point2 p : obstacles) seen.push_back(inverse(body) * p);
            const WindowInput input{present, body, target, kStep_s, seen};
            const WindowCommand command = window.step(input);
            if (look) look(input, command);
            state = command.state;
            blocked_by = command.blocked_by;
            present = command.twist;
            body = moved(body, present, kStep_s);
            time_s += kStep_s;
            if (state == State::kReached || (state == State::kBlocked && present == Twist{})) {
                return;
            }
        }
    }
};

Pose2 random_start(std::mt19937_64& random) {
    std::uniform_real_distribution<double> share(-1, 1);
    return {0.5 * share(random), 0.5 * share(random), radians(20) * share(random)};
}

class EveryFamily : public ::testing::TestWithParam<plant::VehicleType> {};

TEST_P(EveryFamily, ReachesTheTargetInsideEveryLimit) {
    const plant::VehicleType& type = GetParam();
    const bool sideways = type.kinematics != plant::Kinematics::kDifferential;
    std::mt19937_64 random(11);
    std::vector<double> times_s;
    for (int run = 0; run < 1000; ++run) {
        Approach approach{type};
        const DynamicWindow limits(type);
        approach.look = [&](const WindowInput& input, const WindowCommand& command) {
            const Twist& twist = command.twist;
            ASSERT_TRUE(limits.is_in_window(input.present, twist, kStep_s));
            ASSERT_EQ(kinematics::within_limits(type, twist), twist);
            if (!sideways) {
                ASSERT_EQ(twist.vy_mps, 0);
            }
            const double left_m =
                distance(input.hall_from_body.position(), input.hall_from_target.position());
            const double speed = std::hypot(twist.vx_mps, twist.vy_mps);
            ASSERT_LE(speed, approach.options.top_speed_mps + 1e-9);
            ASSERT_LE(speed, std::sqrt(2 * type.max_accel_mps2 * left_m) + 1e-6);
        };
        const Pose2 start = random_start(random);
        approach.run(start);
        ASSERT_EQ(approach.state, State::kReached)
            << run << ": " << start.x_m << " " << start.y_m << " " << start.heading_rad << " at "
            << approach.body.x_m << " " << approach.body.y_m << " " << approach.body.heading_rad;
        ASSERT_LE(norm(approach.body.position()), approach.options.tolerance_m);
        ASSERT_LE(std::abs(approach.body.heading_rad), approach.options.tolerance_rad);
        times_s.push_back(approach.time_s);
    }
    std::ranges::sort(times_s);
    RecordProperty("median_ms", static_cast<int>(1e3 * times_s[500]));
    RecordProperty("longest_ms", static_cast<int>(1e3 * times_s.back()));
}

TEST_P(EveryFamily, NeverPassesItsTargetByMoreThanTheTolerance) {
    std::mt19937_64 random(12);
    for (int run = 0; run < 100; ++run) {
        Approach approach{GetParam()};
        double least_m = 1;
        approach.look = [&](const WindowInput& input, const WindowCommand&) {
            const double left_m = norm(input.hall_from_body.position());
            least_m = std::min(least_m, left_m);
            ASSERT_LE(left_m, least_m + approach.options.tolerance_m);
        };
        approach.run(random_start(random));
    }
}

TEST_P(EveryFamily, ReachesItWithNoisyPosesAndInexactWheels) {
    std::mt19937_64 random(13);
    std::normal_distribution<double> normal;
    for (int run = 0; run < 50; ++run) {
        DynamicWindow window(GetParam());
        Pose2 body = random_start(random);
        Twist present;
        State state = State::kDriving;
        for (int i = 0; i < 4000 && state != State::kReached; ++i) {
            const Pose2 believed =
                body * Pose2{1e-4 * normal(random), 1e-4 * normal(random), 1e-4 * normal(random)};
            const auto command = window.step({present, believed, {}, kStep_s, {}});
            state = command.state;
            present = command.twist;
            body = moved(body,
                         {0.96 * present.vx_mps, 1.03 * present.vy_mps, 0.97 * present.turn_radps},
                         kStep_s);
        }
        EXPECT_EQ(state, State::kReached);
        EXPECT_LE(norm(body.position()), 0.004);
    }
}

TEST_P(EveryFamily, StopsShortOfAnObstacleByTheMargin) {
    std::mt19937_64 random(14);
    std::uniform_real_distribution<double> share(-1, 1);
    const plant::VehicleType& type = GetParam();
    const double front_m = geometry::bounding_box(type.footprint).max.x_m;
    const ObstacleRing outline(type.footprint);
    for (int run = 0; run < 200; ++run) {
        Approach approach{type};
        // A pole in the vehicle's way, somewhere between where its front is and will be.
        const Point2 pole{front_m - 0.15, 0.2 * share(random)};
        approach.obstacles = {pole};
        double nearest_m = 1;
        approach.look = [&](const WindowInput& input, const WindowCommand&) {
            nearest_m = std::min(nearest_m,
                                 outline.outline_distance_m(inverse(input.hall_from_body) * pole));
        };
        approach.run({-0.5, 0.02 * share(random), radians(2) * share(random)});
        ASSERT_EQ(approach.state, State::kBlocked) << run;
        ASSERT_TRUE(approach.blocked_by);
        EXPECT_NEAR(distance(approach.body * *approach.blocked_by, pole), 0, 1e-6);
        EXPECT_GE(nearest_m, approach.options.margin_m - 1e-6);
        EXPECT_LE(nearest_m, approach.options.margin_m + 0.03);
    }
}

TEST_P(EveryFamily, StaysInsideTheCorridor) {
    const plant::VehicleType& type = GetParam();
    const auto box = geometry::bounding_box(type.footprint);
    const double width_m = box.max.y_m + 0.12;
    Approach approach{type};
    approach.corridor = {{box.min.x_m - 1, -width_m},
                         {box.max.x_m + 0.2, -width_m},
                         {box.max.x_m + 0.2, width_m},
                         {box.min.x_m - 1, width_m}};
    approach.look = [&](const WindowInput& input, const WindowCommand&) {
        for (const Point2 corner : type.footprint) {
            const Point2 at = input.hall_from_body * corner;
            ASSERT_TRUE(geometry::contains(approach.corridor, at));
        }
    };
    approach.run({-0.4, 0.01, radians(0.2)});
    EXPECT_EQ(approach.state, State::kReached);
}

TEST_P(EveryFamily, DoesNotMoveInsideTheTolerance) {
    DynamicWindow window(GetParam());
    const auto there = window.step({{}, {0.001, -0.001, 0}, {}, kStep_s, {}});
    EXPECT_EQ(there.state, State::kReached);
    EXPECT_EQ(there.twist, Twist{});
    DynamicWindow turning(GetParam());
    const auto turn = turning.step({{}, {0.001, -0.001, radians(5)}, {}, kStep_s, {}});
    EXPECT_EQ(turn.twist.vx_mps, 0);
    EXPECT_EQ(turn.twist.vy_mps, 0);
    EXPECT_LT(turn.twist.turn_radps, 0);
}

TEST_P(EveryFamily, AStepAllocatesNothing) {
    DynamicWindow window(GetParam());
    window.set_corridor(geometry::rectangle(14, 6));
    std::vector<Point2> scan;
    for (int i = 0; i < 1081; ++i) {
        const double angle = radians(-135 + 0.25 * i);
        scan.push_back({8 * std::cos(angle), 2.4 * std::sin(angle)});
    }
    const auto before = allocations();
    Pose2 body{-0.4, 0.2, 0.1};
    Twist present;
    for (int i = 0; i < 200; ++i) {
        present = window.step({present, body, {}, kStep_s, scan}).twist;
        body = moved(body, present, kStep_s);
    }
    EXPECT_EQ(allocations(), before);
    EXPECT_LT(norm(body.position()), 0.2);
}

TEST_P(EveryFamily, BrakesAsHardAsItMayWhenItComesTooFast) {
    const plant::VehicleType& type = GetParam();
    DynamicWindow window(type);
    const Twist fast{0.3, 0, 0};
    const auto command = window.step({fast, {-0.01, 0, 0}, {}, kStep_s, {}});
    EXPECT_NEAR(command.twist.vx_mps, 0.3 - type.max_accel_mps2 * kStep_s, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(DynamicWindow, EveryFamily,
                         ::testing::Values(differential(), mecanum(), platform()),
                         [](const auto& tested) {
                             return plant::to_string(tested.param.kinematics);
                         });

TEST(DynamicWindow, AVehicleInsideTheMarginMayLeaveIt) {
    Approach approach{differential()};
    approach.obstacles = {{-0.82 - 0.3, 0}};  // 2 cm behind it
    approach.run({-0.3, 0, 0});
    EXPECT_EQ(approach.state, State::kReached);
}

}  // namespace
}  // namespace pulseline::control
