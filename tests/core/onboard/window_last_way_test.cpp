#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/control/dynamic_window.hpp"
#include "core/onboard/window_approach.hpp"
#include "core/simulation/machine/servo_drive.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/simulation/platform.hpp"

// The dynamic window beside what scanners see, and on the last metres from the boundary marker,
// where Li 2022 has it.
namespace pulseline::onboard {
namespace {

using geometry::Point2;
using kinematics::Twist;
using pulseline::testing::differential;
using pulseline::testing::mecanum;
using pulseline::testing::platform;

constexpr double kTick_s = 0.02;
constexpr int kMostTicks = 10'000;
constexpr double kMargin_m = 0.1;  // of the floor that is held round a leg's way

double side_of(const plant::VehicleType& type) {
    double side_m = 0;
    for (const Point2 corner : type.footprint) side_m = std::max(side_m, corner.y_m);
    return side_m;
}

/// A scan that meets one thing of a hand's breadth, as seen from the body's origin.
control::Scan scan_of(const Pose2& hall_from_body, Point2 thing) {
    const Point2 at = inverse(hall_from_body) * thing;
    control::Scan scan;
    scan.step_rad = radians(0.25);
    scan.first_rad = std::atan2(at.y_m, at.x_m) - 4 * scan.step_rad;
    scan.ranges_m.assign(9, static_cast<float>(norm(at)));
    return scan;
}

struct Beside {
    WindowApproach::State state = WindowApproach::State::kDriving;
    double nearest_m = INFINITY;  // between outline and thing, at any time
    double end_m = 0;             // off the target
};

/// From the origin to a target near by, with a thing in the hall.
Beside approach(Pose2 target, Point2 thing, bool sees) {
    const auto type = mecanum();
    simulation::ServoDrive drive(type, Pose2{}, 3, 1);
    drive.set_believed({});
    std::vector<control::Scan> seen;
    WindowApproach window(drive, target, {}, sees ? &seen : nullptr);
    control::ObstacleRing ring(type.footprint);
    Beside beside;
    for (int i = 0; i < kMostTicks; ++i) {
        seen = {scan_of(drive.true_pose(), thing)};
        if (beside.state == WindowApproach::State::kDriving) beside.state = window.step(kTick_s);
        drive.step(kTick_s);
        beside.nearest_m =
            std::min(beside.nearest_m, ring.outline_distance_m(inverse(drive.true_pose()) * thing));
        if (beside.state != WindowApproach::State::kDriving && drive.standing()) break;
    }
    beside.end_m = norm((inverse(drive.true_pose()) * target).position());
    return beside;
}

TEST(WindowLastWay, KeepsAwayFromWhatTheScannersSee) {
    const double side_m = side_of(mecanum());
    const double margin_m = control::DynamicWindowOptions().margin_m;
    // The way to the target leads within two centimetres of the thing.
    const Point2 thing{0.1, side_m + 0.09};
    const Pose2 target{0, 0.07, 0};

    const Beside blind = approach(target, thing, false);
    EXPECT_EQ(blind.state, WindowApproach::State::kReached);
    EXPECT_LT(blind.nearest_m, 0.03);

    const Beside seen = approach(target, thing, true);
    EXPECT_EQ(seen.state, WindowApproach::State::kStopped);
    EXPECT_GT(seen.nearest_m, margin_m - 0.005);
}

TEST(WindowLastWay, ReachesATargetBesideSomethingThatLeavesTheMargin) {
    const Point2 thing{0.1, side_of(mecanum()) + 0.09 + 0.06};
    const Beside seen = approach({0.03, 0.08, 0}, thing, true);
    EXPECT_EQ(seen.state, WindowApproach::State::kReached);
    EXPECT_LT(seen.end_m, 0.003);
}

/// The last two metres to a station at the origin, after a look at the boundary marker.
struct LastWay {
    double time_s = 0;
    double end_m = 0;     // off the station
    double beside_m = 0;  // of the line that was planned and is held, at most
    double begun_mps = 0;

    void see(const Pose2& pose) { beside_m = std::max(beside_m, std::abs(pose.y_m)); }
};

/// Along the leg's line, by the real drive: from two metres before the marker, over it and on.
LastWay by_line(const plant::VehicleType& type, const Pose2& corrected) {
    simulation::ServoDrive drive(type, Pose2{}, 5, 1);
    drive.set_believed({corrected.x_m - 2, corrected.y_m, corrected.heading_rad});
    drive.append(simulation::testing::straight({-4, 0, 0}, 4));
    LastWay way;
    bool passed = false;
    for (int i = 0; i < kMostTicks && !(drive.idle() && drive.standing() && i > 0); ++i) {
        drive.step(kTick_s);
        const Pose2 pose = drive.believed_pose();
        if (!passed && pose.x_m >= -2) {
            passed = true;
            way.begun_mps = drive.velocity_mps();
        }
        if (!passed) continue;
        way.time_s += kTick_s;
        way.see(pose);
    }
    way.end_m = norm(drive.believed_pose().position());
    return way;
}

/// The least time along a line by a drive that follows at once: as fast as allowed, then braked.
double least_time_s(const plant::VehicleType& type, double way_m, double begun_mps) {
    const double accel_mps2 = type.max_accel_mps2;
    const double peak_mps =
        std::min(type.max_speed_mps, std::sqrt(accel_mps2 * way_m + begun_mps * begun_mps / 2));
    const double speeding_m = (peak_mps * peak_mps - begun_mps * begun_mps) / (2 * accel_mps2);
    const double braking_m = peak_mps * peak_mps / (2 * accel_mps2);
    return (peak_mps - begun_mps) / accel_mps2 + peak_mps / accel_mps2 +
           (way_m - speeding_m - braking_m) / peak_mps;
}

/// What the scanners see of the floor that the leg holds: its sides, and behind the station.
std::vector<Point2> sides_of_held_floor(const plant::VehicleType& type, const Pose2& body) {
    const double side_m = side_of(type) + kMargin_m + 0.3;
    std::vector<Point2> points;
    for (double x_m = -6; x_m < 6; x_m += 0.1) {
        for (const double y_m : {-side_m, side_m})
            points.push_back(inverse(body) * Point2{x_m, y_m});
    }
    return points;
}

/// By the window from where the marker was seen, at the speed that the line has there and as a
/// drive would that follows each twist at once: better than any machine of the type can do it.
LastWay by_window(const plant::VehicleType& type, const Pose2& corrected, double begun_mps) {
    control::DynamicWindowOptions options;
    options.top_speed_mps = type.max_speed_mps;
    options.tolerance_m = 0.002;
    control::DynamicWindow window(type, options);
    const double end_m = type.length_m() / 2 + kMargin_m;
    const double side_m = side_of(type) + kMargin_m;
    window.set_corridor({{-6, -side_m}, {end_m, -side_m}, {end_m, side_m}, {-6, side_m}});
    constexpr double kStep_s = 0.05;
    LastWay way;
    Pose2 body = corrected;
    Twist twist{begun_mps, 0, 0};
    for (int i = 0; i < kMostTicks; ++i) {
        const auto things = sides_of_held_floor(type, body);
        const auto command = window.step({twist, body, {}, kStep_s, things});
        if (command.state != control::WindowCommand::State::kDriving) break;
        twist = command.twist;
        body = body *
               Pose2{twist.vx_mps * kStep_s, twist.vy_mps * kStep_s, twist.turn_radps * kStep_s};
        way.time_s += kStep_s;
        way.see(body);
    }
    way.end_m = norm(body.position());
    return way;
}

/// Li 2022 drives from the boundary marker to the station by the window. Here the leg's line is
/// driven to its end and small moves do the rest: where the window takes over at full speed it
/// takes longer than the line as the same drive would drive it, strays farther from it, and ends no
/// nearer than the line by a real drive does, for any family.
TEST(WindowLastWay, FromTheBoundaryMarkerTheLineOfTheLegIsBetter) {
    for (const auto& type : {platform(), mecanum(), differential()}) {
        for (const double side : {1.0, -1.0}) {
            const Pose2 corrected{-2, side * 0.005, radians(0.1)};
            const LastWay line = by_line(type, corrected);
            const LastWay window = by_window(type, corrected, line.begun_mps);
            const double least_s = least_time_s(type, 2, line.begun_mps);
            std::printf(
                "[ last 2 m ] %s at %.2f m/s: line %.2f s (wheel by wheel %.2f), %.2f mm off, %.1f "
                "mm beside; window %.2f s, %.2f mm, %.1f mm\n",
                type.name.c_str(), line.begun_mps, least_s, line.time_s, 1e3 * line.end_m,
                1e3 * line.beside_m, window.time_s, 1e3 * window.end_m, 1e3 * window.beside_m);
            EXPECT_LT(least_s, window.time_s) << type.name;
            EXPECT_LT(line.end_m, window.end_m) << type.name;
            EXPECT_LT(line.beside_m, window.beside_m) << type.name;
        }
    }
}

}  // namespace
}  // namespace pulseline::onboard
