#include "core/onboard/pose/marker_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "core/simulation/machine/servo_drive.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/simulation/platform.hpp"

namespace pulseline::onboard {
namespace {

using namespace simulation;
using simulation::testing::straight;

constexpr double kStep_s = MarkerWatch::kFineStep_s;
constexpr double kPiece_m = 2.5;

/// A camera at the body's centre that sees codes within 40 mm of its foot, 25 times a second, and
/// says so `late_s` after the exposure. Codes lie where the survey says, the first one `moved` and,
/// if not empty, with `other` printed on it.
class Floor : public WaySensing {
public:
    explicit Floor(const SimulatedDrive& drive) : drive_(drive) {}
    std::vector<WayReading> look_below(std::span<const vda5050::SurveyedMarker> expected,
                                       const Pose2&, double own_s) override {
        std::vector<WayReading> ready;
        for (auto& [reading, passed_s] : coming_) {
            reading.age_s += own_s;
            passed_s += own_s;
        }
        for (const auto& marker : expected) {
            const Pose2 truth = marker.pose.x_m < 10 ? marker.pose * moved : marker.pose;
            const Pose2 code = inverse(drive_.true_pose()) * truth;
            if (norm(code.position()) > 0.04) continue;
            const double noise = 1e-4;
            const bool first = marker.pose.x_m < 10;
            const localisation::CodeObservation seen{
                first && !other.empty() ? other : marker.payload,
                {code.x_m + noise * normal_(random_), code.y_m + noise * normal_(random_)},
                code.heading_rad + noise * normal_(random_),
                noise,
                noise};
            coming_.push_back({{marker, seen, clock_s}, 0});
        }
        while (!coming_.empty() && coming_.front().passed_s >= late_s) {
            ready.push_back(coming_.front().reading);
            coming_.erase(coming_.begin());
        }
        return ready;
    }

    Pose2 moved;
    std::string other;
    double late_s = 0.08;
    double clock_s = 0;  // by which its stamps are too old

private:
    const SimulatedDrive& drive_;
    struct Coming {
        WayReading reading;
        double passed_s = 0;
    };
    std::vector<Coming> coming_;
    std::mt19937_64 random_{7};
    std::normal_distribution<double> normal_;
};

localisation::PoseFix known(const Pose2& pose) {
    localisation::PoseFix fix;
    fix.pose = pose;
    fix.covariance = {{{1e-8, 0, 0}, {0, 1e-8, 0}, {0, 0, 1e-8}}};
    return fix;
}

/// A drive of `length_m` straight ahead over codes every `spacing_m`; 0: none.
class Way {
public:
    Way(const plant::VehicleType& type, std::uint64_t seed, double length_m, double spacing_m)
        : drive(type, {}, seed), floor(drive) {
        double next_m = spacing_m;
        for (double at_m = 0; at_m < length_m; at_m += kPiece_m) {
            vda5050::OrderEdge edge;
            edge.segment = straight({at_m, 0, 0}, kPiece_m);
            edge.sequence_id = 2 * static_cast<std::int64_t>(ahead.size()) + 1;
            edge.actions.emplace_back();
            for (; spacing_m > 0 && next_m < at_m + kPiece_m; next_m += spacing_m) {
                edge.actions.back().markers.push_back(
                    {std::to_string(next_m), "qr", 0.06, {next_m, 0, 0}, 1e-4, 5e-4});
            }
            drive.append(edge.segment);
            ahead.push_back(std::move(edge));
        }
    }

    /// It relies on every code; the last one is the boundary marker.
    void rely_on_all() {
        std::string* boundary = nullptr;
        for (auto& edge : ahead) {
            auto& observe = edge.actions.back();
            for (const auto& marker : observe.markers) {
                observe.segment_markers.push_back(marker.payload);
                observe.boundary_marker = marker.payload;
                if (boundary) boundary->clear();
                boundary = &observe.boundary_marker;
            }
        }
    }

    /// To the end; `each` is called after each step.
    template <class Each>
    void run(Each each) {
        for (int i = 0; i < 20'000 && !drive.idle(); ++i) {
            drive.step(kStep_s);
            estimate.drive_to(drive.believed_pose());
            while (done < drive.segments_done()) {
                ahead.pop_front();
                ++done;
            }
            look(ahead);
            each();
        }
        ASSERT_TRUE(drive.idle());
    }
    void run() {
        run([] {});
    }
    void look(const std::deque<vda5050::OrderEdge>& at) {
        const std::string before = watch.refused();
        watch.step(kStep_s, at);
        std::ranges::copy(watch.take_taken(), std::back_inserter(taken));
        if (!watch.refused().empty() && watch.refused() != before)
            refused.push_back(watch.refused());
    }
    /// Where it ended from where it should have.
    double off_m(double length_m) const {
        return distance(drive.true_pose().position(), {length_m, 0});
    }

    ServoDrive drive;
    Floor floor;
    PoseEstimate estimate{Pose2{}};
    MarkerWatch watch{floor, drive, estimate};
    std::deque<vda5050::OrderEdge> ahead;
    std::size_t done = 0;
    std::vector<std::string> taken;
    std::vector<std::string> refused;
};

plant::VehicleType seeing(plant::VehicleType type) {
    type.cameras = {plant::Camera{}};
    type.cameras.front().name = "down";
    return type;
}

plant::VehicleType mecanum() { return seeing(pulseline::testing::mecanum()); }

std::vector<plant::VehicleType> families() {
    return {seeing(pulseline::testing::platform()), mecanum(),
            seeing(pulseline::testing::differential())};
}

TEST(MarkerWatch, CodesUnderWayBringEveryFamilyToTheEndOfALongWay) {
    constexpr double kLength_m = 100;
    for (const auto& type : families()) {
        double with_m = 0;
        double without_m = 0;
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            Way with(type, seed, kLength_m, 9.3);
            Way without(type, seed, kLength_m, 0);
            with.run();
            without.run();
            EXPECT_TRUE(with.refused.empty()) << type.name << " seed " << seed;
            EXPECT_EQ(with.taken.size(), 10U) << type.name << " seed " << seed;
            with_m += with.off_m(kLength_m) / 5;
            without_m += without.off_m(kLength_m) / 5;
        }
        ::testing::Test::RecordProperty(type.name + "_mm", std::to_string(1e3 * with_m));
        std::printf("[ way      ] %s: 100 m end %.1f mm off with codes, %.1f mm without\n",
                    type.name.c_str(), 1e3 * with_m, 1e3 * without_m);
        EXPECT_LT(with_m, 0.006) << type.name;
        EXPECT_LT(with_m, without_m / 2) << type.name;
    }
}

/// Who reads what it relies on arrives as fast as ever: behind the boundary marker three sigma are
/// far inside the 40 mm that the camera sees to either side.
TEST(MarkerWatch, NoArrivalOverCodesIsSlowedDown) {
    for (const auto& type : families()) {
        double sigma_m = 0;
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            Way way(type, seed, 50, 9.3);
            way.estimate.take(known({}));
            way.rely_on_all();
            way.run([&] {
                EXPECT_EQ(way.watch.segments().speed_share(), 1) << type.name << " seed " << seed;
                if (!way.watch.segments().precise()) return;
                sigma_m = std::max(sigma_m, way.estimate.sigma_xy_m());
            });
        }
        std::printf("[ way      ] %s: behind the boundary marker three sigma are %.1f mm at most\n",
                    type.name.c_str(), 3e3 * sigma_m);
        EXPECT_GT(sigma_m, 0);
        EXPECT_LT(3 * sigma_m, 0.04 / 2);
    }
}

/// A code that is refused counts as not read.
TEST(MarkerWatch, BehindAMissedSegmentMarkerItGoesSlowlyUntilTheNextCode) {
    Way way(mecanum(), 3, 30, 9.3);
    way.estimate.take(known({}));
    way.floor.moved = {0.03, 0, 0};
    way.rely_on_all();
    double slow_from_m = 0;
    double slow_to_m = 0;
    std::vector<std::string> missed;
    way.run([&] {
        way.drive.slow_to(way.watch.segments().speed_share());
        if (way.watch.segments().speed_share() == 1) return;
        if (missed.empty()) slow_from_m = way.drive.true_pose().x_m;
        missed = way.watch.segments().missed();
        slow_to_m = way.drive.true_pose().x_m;
    });
    EXPECT_EQ(missed, std::vector<std::string>{std::to_string(9.3)});
    EXPECT_GT(slow_from_m, 9.3);
    EXPECT_LT(slow_from_m, 9.3 + kPiece_m + 1);
    EXPECT_NEAR(slow_to_m, 18.6, 0.2) << "at the next one";
    EXPECT_LT(way.off_m(30), 0.006);
}

/// Without codes the pose fades, and says so: the true one stays inside what is stated.
TEST(MarkerWatch, TheStatedSigmaCoversADriveWithoutCodes) {
    for (const auto& type : families()) {
        int inside = 0;
        constexpr int kDrives = 40;
        for (std::uint64_t seed = 1; seed <= kDrives; ++seed) {
            Way way(type, seed, 20, 0);
            way.estimate.take(known({}));
            way.run();
            const Pose2 off = inverse(way.estimate.pose()) * way.drive.true_pose();
            inside += norm(off.position()) < 3 * way.estimate.sigma_xy_m() &&
                      std::abs(off.heading_rad) < 3 * way.estimate.sigma_heading_rad();
            EXPECT_LT(way.estimate.sigma_xy_m(), 0.025);  // of a use for finding the next code
        }
        EXPECT_GE(inside, kDrives - 1) << type.name;
    }
}

/// Read as if it were new, a reading 80 ms old would be 0.13 m wrong at full speed.
TEST(MarkerWatch, WhatIsReadLateCountsForWhereItWasExposed) {
    for (const double late_s : {0.0, 0.02, 0.08, 0.3}) {
        Way way(mecanum(), 3, 50, 9.3);
        way.floor.late_s = late_s;
        way.run();
        EXPECT_GE(way.taken.size(), 5U) << late_s;
        EXPECT_LT(way.off_m(50), 0.006) << late_s;
    }
}

/// In the future, beyond what is remembered, and nowhere at all: it drives on as if there were no
/// codes, knows its place as badly as that, and says why.
TEST(MarkerWatch, AStampThatCannotBeTrueCorrectsNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double clock_s : {-0.1, -30.0, 0.5, 3600.0, nan}) {
        Way way(mecanum(), 3, 20, 9.3);
        way.estimate.take(known({}));
        way.floor.clock_s = clock_s;
        way.run([&] {
            const double off_m =
                distance(way.estimate.pose().position(), way.drive.true_pose().position());
            ASSERT_LT(off_m, 3 * way.estimate.sigma_xy_m() + 1e-3) << clock_s;
        });
        EXPECT_TRUE(way.taken.empty()) << clock_s;
        EXPECT_EQ(way.watch.mistimed(), std::to_string(18.6)) << clock_s;
        EXPECT_GT(way.estimate.sigma_xy_m(), 2e-3) << clock_s;
    }
}

TEST(MarkerWatch, AClockThatIsSetRightIsBelievedAgain) {
    Way way(mecanum(), 3, 20, 9.3);
    way.estimate.take(known({}));
    way.floor.clock_s = -0.2;
    std::string said;
    way.run([&] {
        if (!way.watch.mistimed().empty()) said = way.watch.mistimed();
        if (way.drive.true_pose().x_m > 15) way.floor.clock_s = 0;
    });
    EXPECT_EQ(said, std::to_string(9.3));
    EXPECT_EQ(way.taken, std::vector<std::string>{std::to_string(18.6)});
    EXPECT_EQ(way.watch.mistimed(), "") << "another one was taken since";
}

/// Codes lie farther on or back by what it drives meanwhile. The first one contradicts the way and
/// is refused; several agree, as they would behind wheels that have slipped. What it believes is
/// off by no more than that all the time, which stays on the floor held around it.
TEST(MarkerWatch, AClockThatIsWrongByFiftyMillisecondsShiftsThePoseByNoMoreThanThat) {
    constexpr double kHeld_m = 0.1;
    for (const auto& type : families()) {
        for (const double clock_s : {-0.05, 0.05}) {
            Way way(type, 3, 50, 4.1);
            way.estimate.take(known({}));
            way.floor.clock_s = clock_s;
            const double shift_m = std::abs(clock_s) * type.max_speed_mps;
            double most_m = 0;
            way.run([&] {
                const double off_m =
                    distance(way.estimate.pose().position(), way.drive.true_pose().position());
                most_m = std::max(most_m, off_m);
            });
            std::printf("[ clock    ] %s, %+.0f ms: %.1f mm off at most, %.1f mm shifted\n",
                        type.name.c_str(), 1e3 * clock_s, 1e3 * most_m, 1e3 * shift_m);
            ASSERT_FALSE(way.refused.empty()) << type.name;
            EXPECT_EQ(way.refused.front(), std::to_string(4.1)) << type.name;
            EXPECT_LT(most_m, shift_m + 3e-3) << type.name;
            EXPECT_LT(most_m, kHeld_m) << type.name;
        }
    }
}

TEST(MarkerWatch, ACodeThatWasMovedIsRefusedAndTheNextOneTaken) {
    for (const Pose2 moved : {Pose2{0.03, 0, 0}, Pose2{0, -0.03, 0}, Pose2{0, 0, 0.3}}) {
        Way way(mecanum(), 3, 20, 9.3);
        way.estimate.take(known({}));
        way.floor.moved = moved;
        way.run();
        EXPECT_EQ(way.refused, std::vector<std::string>{std::to_string(9.3)});
        EXPECT_EQ(way.taken, std::vector<std::string>{std::to_string(18.6)});
        EXPECT_EQ(way.watch.refused(), "") << "another one was taken since";
        EXPECT_LT(way.off_m(20), 0.006);
    }
}

/// It lies where one is expected and is another one: whichever of the two was moved, it is no place
/// to correct the pose by.
TEST(MarkerWatch, ACodeThatWasExchangedIsNamedAndNotTaken) {
    Way way(mecanum(), 3, 20, 9.3);
    way.floor.other = "B7";
    way.run();
    EXPECT_EQ(way.refused, std::vector<std::string>{"B7"});
    EXPECT_EQ(way.taken, std::vector<std::string>{std::to_string(18.6)});
    EXPECT_EQ(way.watch.refused(), "") << "another one was taken since";
}

/// It begins beside its line and turned, and learns so at the first code: the wheels may not
/// notice more than a curve.
TEST(MarkerWatch, ACorrectionDoesNotJerkTheDrive) {
    for (const auto& type : families()) {
        Way way(type, 3, 40, 9.3);
        const Pose2 believed{0, -0.015, radians(-0.05)};
        way.drive.set_believed(believed);
        way.estimate.start_at(believed);
        double most_mps2 = 0;
        kinematics::Twist before = way.drive.twist();
        way.run([&] {
            const auto now = way.drive.twist();
            most_mps2 = std::max(
                most_mps2,
                std::hypot(now.vx_mps - before.vx_mps, now.vy_mps - before.vy_mps) / kStep_s);
            before = now;
        });
        EXPECT_FALSE(way.drive.stop_cause()) << type.name;
        EXPECT_LT(way.off_m(40), 0.006) << type.name;
        EXPECT_LT(most_mps2, 2 * type.max_accel_mps2) << type.name;
    }
}

/// Else a minute on one code would make the filter as sure of it as of a hundred others.
TEST(MarkerWatch, ACodeBelowAStandingVehicleIsNotLookedAt) {
    Way way(mecanum(), 3, 20, 9.3);
    int looks = 0;
    way.run([&] {
        if (way.drive.believed_pose().x_m < 9.29) return;
        for (; looks < 100; ++looks) {
            way.drive.hold();
            way.drive.step(kStep_s);
            way.estimate.drive_to(way.drive.believed_pose());
            way.look(way.ahead);
            ASSERT_FALSE(way.drive.standing() && way.watch.expects_soon());
        }
        way.drive.release();
    });
    EXPECT_EQ(way.taken.size(), 2U);
}

TEST(MarkerWatch, WhileItDoesSomethingElseNothingIsExpected) {
    Way way(mecanum(), 3, 20, 1.1);
    const std::deque<vda5050::OrderEdge> none;
    for (int i = 0; i < 500; ++i) {
        way.drive.step(kStep_s);
        way.estimate.drive_to(way.drive.believed_pose());
        way.look(none);
        ASSERT_FALSE(way.watch.expects_soon());
    }
    EXPECT_TRUE(way.taken.empty());
    EXPECT_TRUE(way.refused.empty());
}

}  // namespace
}  // namespace pulseline::onboard
