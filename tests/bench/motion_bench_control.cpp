#include "tests/bench/motion_bench_control.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>
#include <vector>

#include "core/control/dynamic_window.hpp"
#include "core/control/protective_fields.hpp"
#include "core/kinematics/primitives.hpp"
#include "core/simulation/machine/servo_drive.hpp"
#include "core/simulation/world/lidar.hpp"
#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::bench {
namespace {

using control::DynamicWindow;
using control::ProtectiveFields;
using control::Scan;
using geometry::Point2;
using geometry::Polygon;
using geometry::Pose2;
using kinematics::Twist;

constexpr double kStep_s = 0.05;
constexpr double kMostStep_us = 100;
// 12 vehicles that scan ten times a second take 2 % of a core.
constexpr double kMostScan_us = 0.02 * 1e6 / (12 * 10);
// 12 simulated drives at ten times the pace, stepped every 0.1 s of their own time: 10 % of a core.
constexpr double kMostDrive_us = 0.1 * 1e6 / (12 * 10 * 10);

struct Times {
    std::vector<double> us;

    template <class Work>
    void take(Work work) {
        const double begin_us = now_us();
        work();
        us.push_back(now_us() - begin_us);
    }
    /// Of this thread's processor time: what else the machine does is no part of it.
    static double now_us() {
        timespec now{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
    }
    double mean() const {
        double sum = 0;
        for (const double t : us) sum += t;
        return sum / static_cast<double>(us.size());
    }
    /// Prints and compares the p99 with what is allowed.
    bool report(const char* name, const char* vehicle, double allowed_us, nlohmann::json& out) {
        std::ranges::sort(us);
        const double p99 = us[us.size() * 99 / 100];
        const bool good = p99 <= allowed_us;
        std::printf("%-22s %-20s %9zu  %8.1f %8.1f %8.1f   <= %.0f %s\n", name, vehicle, us.size(),
                    us[us.size() / 2], mean(), p99, allowed_us, good ? "yes" : "NO");
        out[vehicle][name] = {{"p50_us", us[us.size() / 2]}, {"mean_us", mean()}, {"p99_us", p99}};
        return good;
    }
};

Pose2 moved(const Pose2& body, const Twist& twist) {
    return body * Pose2{twist.vx_mps * kStep_s, twist.vy_mps * kStep_s, twist.turn_radps * kStep_s};
}

/// A hall of 120 m x 60 m with jigs and eleven other vehicles.
struct Hall {
    std::vector<Polygon> fixed{{{0, 0}, {120, 0}, {120, 60}, {0, 60}}};
    std::vector<Polygon> others;
    std::mt19937_64 random{5};

    Hall() {
        for (int i = 0; i < 80; ++i) fixed.push_back(placed(3, 1));
        for (int i = 0; i < 11; ++i) others.push_back(placed(2.4, 1.4));
    }
    double uniform(double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    }
    Polygon placed(double length_m, double width_m) {
        return transformed({uniform(2, 118), uniform(2, 58), uniform(-kPi, kPi)},
                           geometry::rectangle(length_m, width_m));
    }
};

/// Walls close on both sides and jigs in front, as the scanner of a vehicle near its goal sees
/// them.
std::vector<Point2> narrow_place(const plant::VehicleType& type) {
    const auto box = geometry::bounding_box(type.footprint);
    std::vector<Point2> points;
    for (int i = 0; i < 1081; ++i) {
        const double share = i / 1080.0;
        const double side = i % 2 == 0 ? 1 : -1;
        points.push_back({box.min.x_m + share * (box.max.x_m - box.min.x_m + 1.2),
                          side * (box.max.y_m + 0.15 + 0.05 * std::sin(40 * share))});
    }
    return points;
}

bool bench_window(const plant::VehicleType& type, bool narrow, nlohmann::json& out) {
    Times times;
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> share(-1, 1);
    const auto walls = narrow_place(type);
    std::vector<Point2> seen(walls.size());
    for (int run = 0; run < 100; ++run) {
        DynamicWindow window(type);
        const double aside_m = narrow ? 0.01 : 0.5;
        Pose2 body{-0.5, aside_m * share(random), radians(narrow ? 1 : 20) * share(random)};
        Twist present;
        for (int i = 0; i < 150; ++i) {
            const Pose2 body_from_hall = inverse(body);
            for (std::size_t k = 0; k < walls.size(); ++k) seen[k] = body_from_hall * walls[k];
            control::WindowCommand command;
            times.take([&] {
                command = window.step(
                    {present,
                     body,
                     {},
                     kStep_s,
                     narrow ? std::span<const Point2>(seen) : std::span<const Point2>()});
            });
            if (command.state != control::WindowCommand::State::kDriving) break;
            present = command.twist;
            body = moved(body, present);
        }
    }
    return times.report(narrow ? "dynamic window, narrow" : "dynamic window, free",
                        plant::to_string(type.kinematics), kMostStep_us, out);
}

bool bench_scanner(const plant::VehicleType& type, nlohmann::json& out) {
    Hall hall;
    const auto box = geometry::bounding_box(type.footprint);
    const simulation::Lidar lidar({"front", {box.max.x_m, 0, 0}}, hall.fixed);
    ProtectiveFields fields(type, type.footprint);
    Scan scan;
    Times scans;
    Times checks;
    for (int i = 0; i < 5000; ++i) {
        const Pose2 body{hall.uniform(2, 118), hall.uniform(2, 58), hall.uniform(-kPi, kPi)};
        const Twist twist{hall.uniform(-0.3, type.max_speed_mps), 0,
                          hall.uniform(-0.3, 0.3) * type.max_turn_rate_radps};
        scans.take([&] { lidar.scan(body, hall.others, hall.random, scan); });
        checks.take([&] { (void)fields.check(scan, twist); });
    }
    const char* name = plant::to_string(type.kinematics);
    const bool scan_good = scans.report("scan of 1081 rays", name, kMostScan_us, out);
    return checks.report("protective fields", name, kMostScan_us, out) && scan_good;
}

bool bench_drive(const plant::VehicleType& type, nlohmann::json& out) {
    simulation::ServoDrive drive(type, {}, 1);
    std::vector<kinematics::Segment> way;
    kinematics::append_straight(way, {}, {400, 0});
    for (const kinematics::Segment& segment : way) drive.append(segment);
    Times times;
    for (int i = 0; i < 2000 && !drive.idle(); ++i) times.take([&] { drive.step(0.1); });
    return times.report("simulated drive", plant::to_string(type.kinematics), kMostDrive_us, out);
}

}  // namespace

nlohmann::json measure_control(bool& passed) {
    using namespace pulseline::testing;
    nlohmann::json out;
    std::printf("%-22s %-20s %9s  %8s %8s %8s\n", "", "", "times", "p50 us", "mean us", "p99 us");
    for (const auto& type : {differential(), mecanum(), platform()}) {
        passed &= bench_window(type, false, out);
        passed &= bench_window(type, true, out);
        passed &= bench_scanner(type, out);
        passed &= bench_drive(type, out);
    }
    return out;
}

}  // namespace pulseline::bench
