#include "core/onboard/window_approach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>

#include "core/onboard/stop_procedure.hpp"
#include "core/simulation/machine/servo_drive.hpp"
#include "core/simulation/machine/vehicle_motion.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/simulation/platform.hpp"

namespace pulseline::onboard {
namespace {

using namespace simulation;

using pulseline::testing::differential;
using pulseline::testing::mecanum;
using pulseline::testing::platform;

constexpr double kTick_s = 0.02;
constexpr int kMostTicks = 10'000;

std::unique_ptr<SimulatedDrive> make_drive(bool by_wheels, const plant::VehicleType& type,
                                           std::uint64_t seed, double time_factor = 1) {
    if (by_wheels) return std::make_unique<ServoDrive>(type, Pose2{}, seed, time_factor);
    return std::make_unique<VehicleMotion>(type, Pose2{}, seed, time_factor);
}

vda5050::StopTarget target_at(const Pose2& pose) {
    return {"st01", 1, pose, 0.025, 0.025, radians(0.2), {}};
}

/// Sees where the vehicle truly is, from within `sight_m` of the target.
class Eyes : public StopSensing {
public:
    explicit Eyes(const SimulatedDrive& drive, double sight_m = 1)
        : drive_(drive), sight_m_(sight_m) {}
    Result<vda5050::StopMeasurement> measure(const vda5050::StopTarget& target) override {
        const Pose2 off = inverse(drive_.true_pose()) * target.target;
        if (norm(off.position()) > sight_m_) {
            return fail(Errc::kNotFound, "no_marker_in_view", "Nothing is seen.");
        }
        if (!drive_.standing()) ++seen_moving;
        return vda5050::StopMeasurement{drive_.true_pose(), 5e-5, 5e-5, "test", {"ST01-F"}};
    }
    int seen_moving = 0;

private:
    const SimulatedDrive& drive_;
    double sight_m_;
};

struct Stop {
    StopProcedure::Outcome outcome;
    double time_s = 0;
    double farthest_m = 0;  // from the target, at any time
    double farthest_rad = 0;
    double fastest_mps = 0;
};

Stop adjusted(SimulatedDrive& drive, StopSensing& eyes, const Pose2& target) {
    StopProcedure procedure(drive, eyes);
    procedure.start(target_at(target), true);
    Stop stop;
    for (int i = 0; i < kMostTicks; ++i) {
        drive.step(kTick_s);
        const Pose2 off = inverse(drive.true_pose()) * target;
        stop.farthest_m = std::max(stop.farthest_m, norm(off.position()));
        stop.farthest_rad = std::max(stop.farthest_rad, std::abs(off.heading_rad));
        stop.fastest_mps = std::max(stop.fastest_mps, std::abs(drive.velocity_mps()));
        stop.time_s += kTick_s;
        if (auto outcome = procedure.step(kTick_s)) {
            stop.outcome = std::move(*outcome);
            return stop;
        }
    }
    ADD_FAILURE() << "it does not end";
    return stop;
}

/// A target up to so far away.
Pose2 somewhere(std::mt19937_64& random, double x_m, double y_m, double turn_rad) {
    std::uniform_real_distribution<double> share(-1, 1);
    Pose2 target{2, 2, 0};
    while (std::hypot(target.x_m / x_m, target.y_m / y_m) > 1) {
        target = {x_m * share(random), y_m * share(random), turn_rad * share(random)};
    }
    return target;
}

TEST(WindowApproach, FromAnywhereInReachEveryVehicleEndsInsideTheTolerance) {
    const control::AdjustmentLimits limits;
    for (const auto& type : {platform(), mecanum(), differential()}) {
        const bool sideways = control::moves_sideways(type);
        for (const bool by_wheels : {false, true}) {
            std::mt19937_64 random(5);
            for (std::uint64_t seed = 1; seed <= 40; ++seed) {
                // A differential one cannot mend more across its way inside the reach.
                const Pose2 target = sideways ? somewhere(random, 0.097, 0.097, radians(0.95))
                                              : somewhere(random, 0.09, 0.006, radians(0.3));
                const auto drive = make_drive(by_wheels, type, seed);
                Eyes eyes(*drive);
                const Stop stop = adjusted(*drive, eyes, target);

                ASSERT_TRUE(stop.outcome.succeeded) << type.name << ": " << stop.outcome.why_not;
                const Pose2 off = inverse(drive->true_pose()) * target;
                EXPECT_LE(norm(off.position()), 0.0045) << type.name;
                EXPECT_LE(std::abs(off.heading_rad), radians(0.2)) << type.name;
                EXPECT_LE(stop.farthest_m, limits.reach_m + 0.003) << type.name;
                EXPECT_LE(stop.farthest_rad, limits.reach_rad + radians(0.1)) << type.name;
            }
        }
    }
}

TEST(WindowApproach, IsFasterThanCreepingMovesWhereItIsUsed) {
    struct Case {
        plant::VehicleType type;
        double from_m;
        double turn_rad;
        double most_s;  // moves only: 3.16, 2.08 and 5.92 s
    };
    for (const Case& c :
         {Case{mecanum(), 0.095, radians(0.9), 2.6}, Case{mecanum(), 0.03, radians(0.3), 1.95},
          Case{platform(), 0.02, radians(0.2), 4.9}}) {
        std::mt19937_64 random(7);
        double time_s = 0;
        for (std::uint64_t seed = 1; seed <= 50; ++seed) {
            const auto drive = make_drive(true, c.type, seed);
            Eyes eyes(*drive);
            time_s +=
                adjusted(*drive, eyes, somewhere(random, c.from_m, c.from_m, c.turn_rad)).time_s;
        }
        std::printf("[ stops    ] %s: %.2f s\n", c.type.name.c_str(), time_s / 50);
        EXPECT_LT(time_s / 50, c.most_s) << c.type.name << " from " << c.from_m;
    }
}

TEST(WindowApproach, IsNotUsedWhereMovesAreBetter) {
    const control::AdjustmentLimits limits;
    EXPECT_TRUE(WindowApproach::helps(mecanum(), {0.05, -0.05, 0.01}, limits, kTick_s));
    EXPECT_FALSE(WindowApproach::helps(mecanum(), {0.004, 0, 0}, limits, kTick_s));
    EXPECT_FALSE(WindowApproach::helps(mecanum(), {0.08, 0.08, 0}, limits, kTick_s));
    EXPECT_FALSE(WindowApproach::helps(mecanum(), {0.05, 0, radians(1.1)}, limits, kTick_s));
    EXPECT_TRUE(WindowApproach::helps(platform(), {0.02, 0.01, 0.001}, limits, kTick_s));
    EXPECT_FALSE(WindowApproach::helps(platform(), {0.05, 0.01, 0.001}, limits, kTick_s));
    EXPECT_FALSE(WindowApproach::helps(differential(), {0.05, 0, 0}, limits, kTick_s));
    EXPECT_TRUE(WindowApproach::helps(mecanum(), {0.05, 0, 0}, limits, 0.1));
    EXPECT_FALSE(WindowApproach::helps(mecanum(), {0.012, 0, 0}, limits, 0.1));
    EXPECT_FALSE(WindowApproach::helps(mecanum(), {0.05, 0, 0}, limits, 0.2));
    control::AdjustmentLimits fine;
    fine.good_m = 0.0005;
    EXPECT_FALSE(WindowApproach::helps(mecanum(), {0.05, -0.05, 0.01}, fine, kTick_s));
}

TEST(WindowApproach, ALookOnTheWayCorrectsWhereItBelievesToBe) {
    for (const bool by_wheels : {false, true}) {
        const auto drive = make_drive(by_wheels, mecanum(), 3);
        drive->set_believed({0.012, -0.01, radians(0.2)});
        Eyes eyes(*drive, 0.05);
        const Pose2 target{0.08, 0.04, 0};
        const Stop stop = adjusted(*drive, eyes, target);

        EXPECT_TRUE(stop.outcome.succeeded) << stop.outcome.why_not;
        EXPECT_EQ(eyes.seen_moving, 1);
        EXPECT_LE(norm((inverse(drive->true_pose()) * target).position()), 0.002);
    }
}

TEST(WindowApproach, AbortedInTheMiddleItBrakesAndCanBeginAnew) {
    for (const bool by_wheels : {false, true}) {
        const auto drive = make_drive(by_wheels, mecanum(), 3);
        Eyes eyes(*drive);
        StopProcedure procedure(*drive, eyes);
        const Pose2 target{0.09, 0.02, 0};
        procedure.start(target_at(target), true);
        while (drive->true_pose().x_m < 0.03) {
            drive->step(kTick_s);
            ASSERT_FALSE(procedure.step(kTick_s));
        }
        procedure.abort();
        std::optional<StopProcedure::Outcome> outcome;
        for (int i = 0; i < 200 && !outcome; ++i) {
            drive->step(kTick_s);
            outcome = procedure.step(kTick_s);
        }

        ASSERT_TRUE(outcome);
        EXPECT_EQ(outcome->why_not, "cancelled");
        EXPECT_TRUE(drive->idle());
        EXPECT_LT(drive->true_pose().x_m, 0.08);
        drive->release();
        EXPECT_TRUE(adjusted(*drive, eyes, target).outcome.succeeded);
    }
}

TEST(WindowApproach, ThatDrivesForTooLongIsRefusedWithWhatIsLeft) {
    for (const bool by_wheels : {false, true}) {
        const auto drive = make_drive(by_wheels, mecanum(), 3);
        drive->slow_to(0.01);
        Eyes eyes(*drive);
        const Stop stop = adjusted(*drive, eyes, {0.09, 0.02, 0});

        EXPECT_FALSE(stop.outcome.succeeded);
        EXPECT_EQ(stop.outcome.why_not.rfind("out_of_time: ", 0), 0u) << stop.outcome.why_not;
        EXPECT_TRUE(stop.outcome.measurement);
        EXPECT_TRUE(drive->idle());
        EXPECT_LT(stop.time_s, WindowApproach::kPatience_s + 3);
    }
}

TEST(WindowApproach, APausedVehicleWaitsAndGoesOn) {
    for (const bool by_wheels : {false, true}) {
        const auto drive = make_drive(by_wheels, mecanum(), 3);
        Eyes eyes(*drive);
        StopProcedure procedure(*drive, eyes);
        const Pose2 target{0.09, 0.02, 0};
        procedure.start(target_at(target), true);
        std::optional<StopProcedure::Outcome> outcome;
        const auto run = [&](double time_s) {
            for (double t = 0; t < time_s && !outcome; t += kTick_s) {
                drive->step(kTick_s);
                outcome = procedure.step(kTick_s);
            }
        };
        run(1);
        drive->hold();
        run(2 * WindowApproach::kPatience_s);
        ASSERT_FALSE(outcome);
        EXPECT_TRUE(drive->standing());
        EXPECT_LT(drive->true_pose().x_m, 0.08);
        drive->release();
        run(10);
        ASSERT_TRUE(outcome);
        EXPECT_TRUE(outcome->succeeded) << outcome->why_not;
    }
}

TEST(WindowApproach, ManyTimesFasterThanItsTicksAllowItMovesOnly) {
    for (const double factor : {4.0, 20.0}) {
        const auto drive = make_drive(false, mecanum(), 3, factor);
        Eyes eyes(*drive);
        const Stop stop = adjusted(*drive, eyes, {0.09, 0.02, radians(0.5)});
        EXPECT_TRUE(stop.outcome.succeeded) << stop.outcome.why_not;
        const bool steered = kTick_s * factor <= WindowApproach::kLongest_s;
        EXPECT_EQ(stop.fastest_mps / factor > 0.06, steered);
    }
}

}  // namespace
}  // namespace pulseline::onboard
