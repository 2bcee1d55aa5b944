#include "core/onboard/pose/pose_guard.hpp"

#include <gtest/gtest.h>

#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::onboard {
namespace {

using Advice = PoseGuard::Advice;
using Way = PoseGuard::Way;

PoseEstimate measured(const localisation::OdometryNoise& noise) {
    PoseEstimate estimate{geometry::Pose2{}, noise};
    localisation::PoseFix fix;
    fix.covariance = {{{1e-6, 0, 0}, {0, 1e-6, 0}, {0, 0, 1e-8}}};
    estimate.take(fix);
    return estimate;
}

/// Way in metres after which each advice is given first.
struct Ways {
    double slow_m = -1;
    double stand_m = -1;
};

Ways ways(const plant::VehicleType& type, bool loaded, PoseEstimate estimate) {
    PoseGuard guard(type, loaded);
    Ways found;
    for (double at_m = 0; at_m < 2000 && found.stand_m < 0; at_m += 0.1) {
        estimate.drive_to({at_m, 0, 0});
        const Advice advice = guard.step(0.1, estimate, Way::kUnderWay);
        if (advice != Advice::kDrive && found.slow_m < 0) found.slow_m = at_m;
        if (speed_share(advice) == 0) found.stand_m = at_m;
        if (speed_share(advice) > 0) {
            EXPECT_LT(guard.reach_m(estimate), PoseGuard::kHeld_m) << at_m;
        }
    }
    return found;
}

localisation::OdometryNoise noise(const plant::VehicleType& type) {
    return localisation::odometry_noise({}, type);
}

TEST(PoseGuard, FirstItSlowsDownThenItStands) {
    for (const auto& type : {pulseline::testing::mecanum(), pulseline::testing::differential(),
                             pulseline::testing::platform()}) {
        const auto found = ways(type, false, measured(noise(type)));
        EXPECT_GT(found.slow_m, 12) << type.name << ": codes lie 9 m apart";
        EXPECT_GT(found.stand_m, found.slow_m) << type.name;
        EXPECT_LT(found.stand_m, 200) << type.name;
    }
}

TEST(PoseGuard, ALongLoadReachesFarther) {
    auto type = pulseline::testing::platform();
    const auto empty = ways(type, false, measured(noise(type)));
    type.load_footprint = geometry::rectangle(30, 10);
    const auto loaded = ways(type, true, measured(noise(type)));
    EXPECT_LT(loaded.stand_m, empty.stand_m);
}

/// Where walls have told it a moment ago, its drive believes what a person said still.
TEST(PoseGuard, ItStandsUntilItsDriveBelievesWhatItKnows) {
    const auto type = pulseline::testing::platform();
    PoseEstimate estimate{geometry::Pose2{}, noise(type)};
    estimate.start_at({});
    localisation::BeaconFix seen;
    seen.fix.method = localisation::Method::kContours;
    seen.fix.pose = {0.05, -0.02, radians(5)};
    seen.fix.covariance = {{{1e-6, 0, 0}, {0, 1e-6, 0}, {0, 0, 1e-8}}};
    ASSERT_TRUE(estimate.see(seen));
    PoseGuard guard(type, false);
    EXPECT_NEAR(norm(estimate.to_lead().position()), 0.054, 0.003);
    EXPECT_GT(guard.reach_m(estimate), 0.4) << "its ends, 5.4 m from its middle";
    EXPECT_EQ(guard.step(0.1, estimate, Way::kUnderWay), Advice::kLookAround);
    EXPECT_TRUE(guard.should_be_led(estimate));

    estimate.led_to(estimate.pose());
    EXPECT_LT(norm(estimate.to_lead().position()), 1e-12);
    EXPECT_FALSE(guard.should_be_led(estimate));
    EXPECT_EQ(guard.step(0.1, estimate, Way::kUnderWay), Advice::kDrive);
}

TEST(PoseGuard, FromWhereAPersonPointsToItLooksAroundAndThenAsks) {
    const auto type = pulseline::testing::differential();
    PoseEstimate estimate{geometry::Pose2{}, noise(type)};
    estimate.start_at({});
    PoseGuard guard(type, false);

    EXPECT_GT(speed_share(guard.step(60, estimate, Way::kNone)), 0) << "nobody has sent it";
    for (double looked_s = 0; looked_s < PoseGuard::kLook_s - 0.5; looked_s += 0.5) {
        EXPECT_EQ(guard.step(0.5, estimate, Way::kUnderWay), Advice::kLookAround) << looked_s;
    }
    guard.step(0.5, estimate, Way::kUnderWay);
    EXPECT_EQ(guard.step(0.5, estimate, Way::kUnderWay), Advice::kAsk);
}

TEST(PoseGuard, BeforeItBeginsItsLooksHaveTimeToAddUp) {
    const auto type = pulseline::testing::differential();
    PoseEstimate estimate{geometry::Pose2{}, noise(type)};
    estimate.start_at({});
    PoseGuard guard(type, false);
    EXPECT_TRUE(guard.is_vague(estimate));
    EXPECT_FALSE(guard.is_vague(measured(noise(type))));
    EXPECT_EQ(guard.step(PoseGuard::kFind_s - 1, estimate, Way::kToBegin), Advice::kLookAround);
    EXPECT_EQ(guard.step(2, estimate, Way::kToBegin), Advice::kAsk);
}

// In a wide hall no wall tells it better, and its next code lies 9 m on.
TEST(PoseGuard, FromWhereAPersonHasMeasuredItsPlaceItDrivesToTheSecondCode) {
    auto platform = pulseline::testing::platform();
    platform.load_footprint = geometry::rectangle(30, 10);
    for (const auto& type : {platform, pulseline::testing::differential()}) {
        PoseEstimate estimate{geometry::Pose2{}, noise(type)};
        estimate.start_at({}, 0.005, radians(0.05));
        EXPECT_GT(ways(type, true, estimate).stand_m, 18) << type.name;
    }
}

TEST(PoseGuard, WhatTellsItWhileItLooksLetsItDrive) {
    const auto type = pulseline::testing::differential();
    PoseEstimate estimate{geometry::Pose2{}, noise(type)};
    estimate.start_at({});
    PoseGuard guard(type, false);
    EXPECT_EQ(guard.step(PoseGuard::kLook_s - 1, estimate, Way::kUnderWay), Advice::kLookAround);

    PoseEstimate told = measured(noise(type));
    EXPECT_EQ(guard.step(1, told, Way::kUnderWay), Advice::kDrive);

    EXPECT_EQ(guard.step(PoseGuard::kLook_s - 1, estimate, Way::kUnderWay), Advice::kLookAround)
        << "it begins to look anew";
}

TEST(PoseGuard, WhereCodesHaveToldItItDrivesAtOnce) {
    const auto type = pulseline::testing::differential();
    PoseEstimate estimate{geometry::Pose2{}, noise(type)};
    estimate.start_at({}, 0.002, 0.002);
    EXPECT_EQ(PoseGuard(type, false).step(0.1, estimate, Way::kUnderWay), Advice::kDrive);
}

}  // namespace
}  // namespace pulseline::onboard
