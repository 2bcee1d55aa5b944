#include "core/onboard/pose/fix_log.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/onboard/pose/pose_estimate.hpp"

namespace pulseline::onboard {
namespace {

using geometry::Pose2;

TEST(FixLog, TheNewestStandsFirstAndTheOldestFallsOut) {
    FixLog log;
    for (int i = 0; i < 30; ++i) log.took(PoseSource::kCodes, "C" + std::to_string(i), {});
    ASSERT_EQ(log.newest().size(), vda5050::kMostPoseFixes);
    EXPECT_EQ(log.newest().front().what, "C29");
    EXPECT_EQ(log.newest().back().what, "C20");
}

TEST(FixLog, WhatTellsOftenHasOneEntryThatCountsAndPushesNoCodeOut) {
    FixLog log;
    log.took(PoseSource::kCodes, "C1", {0.003, 0.004, -0.01});
    for (int i = 0; i < 500; ++i) {
        log.step(0.05);
        log.took(PoseSource::kContours, {}, {0.002, 0, 0});
        log.took(PoseSource::kReflectors, {}, {0.001, 0, 0});
        if (i == 250) log.refused(PoseSource::kContours, {}, "innovation_gate", {0.4, 0, 0});
    }
    const auto& fixes = log.newest();
    ASSERT_EQ(fixes.size(), 4U);
    EXPECT_EQ(fixes[0].by, "reflectors");
    EXPECT_EQ(fixes[0].times, 500);
    EXPECT_EQ(fixes[1].by, "contours");
    EXPECT_DOUBLE_EQ(fixes[1].moved_m, 0.002);
    EXPECT_EQ(fixes[2].result, "refused");
    EXPECT_EQ(fixes[2].why, "innovation_gate");
    EXPECT_NEAR(fixes[2].ago_s, 249 * 0.05, 1e-9);
    EXPECT_EQ(fixes[3].what, "C1");
    EXPECT_NEAR(fixes[3].moved_m, 0.005, 1e-12);
    EXPECT_NEAR(fixes[3].turned_rad, 0.01, 1e-12);
    EXPECT_NEAR(fixes[3].ago_s, 25, 1e-9);
}

TEST(FixLog, WhatIsNoNumberLeavesTheStateWhole) {
    FixLog log;
    const double none = std::numeric_limits<double>::quiet_NaN();
    log.refused(PoseSource::kCodes, "C1", "innovation_gate", {none, 0, none});
    EXPECT_EQ(log.newest().front().moved_m, 0);
    EXPECT_EQ(log.newest().front().turned_rad, 0);
}

TEST(FixLog, ACodeRefusedInPictureAfterPictureIsOne) {
    FixLog log;
    for (int i = 0; i < 40; ++i) log.refused(PoseSource::kCodes, "C1", "other_code");
    ASSERT_EQ(log.newest().size(), 1U);
    EXPECT_EQ(log.newest().front().times, 40);
    log.took(PoseSource::kCodes, "C2", {});
    log.refused(PoseSource::kCodes, "C1", "other_code");
    EXPECT_EQ(log.newest().size(), 3U);
}

// Whatever moves the estimate writes it down itself, with how far.
TEST(FixLog, TheEstimateTellsOfEachFix) {
    PoseEstimate estimate({10, 5, 0});
    estimate.start_at({10, 5, 0}, 0.05, 0.03);
    localisation::PoseFix stop;
    stop.pose = {10.03, 5.04, 0.01};
    stop.covariance = {{{1e-6, 0, 0}, {0, 1e-6, 0}, {0, 0, 2.5e-7}}};
    estimate.take(stop);
    ASSERT_EQ(estimate.fixes().newest().size(), 2U);
    EXPECT_EQ(estimate.fixes().newest()[0].by, "stop");
    EXPECT_EQ(estimate.fixes().newest()[0].result, "taken");
    EXPECT_NEAR(estimate.fixes().newest()[0].moved_m, 0.05, 1e-9);
    EXPECT_EQ(estimate.fixes().newest()[1].by, "person");
    EXPECT_EQ(estimate.fixes().newest()[1].moved_m, 0);  // from nowhere
    // What contours say, worse than the stop, agrees and moves nothing.
    localisation::BeaconFix contours;
    contours.fix.pose = {10.032, 5.04, 0.01};
    contours.fix.method = localisation::Method::kContours;
    contours.fix.covariance = {{{1e-4, 0, 0}, {0, 1e-4, 0}, {0, 0, 1e-5}}};
    contours.lasting = {{{9e-5, 0, 0}, {0, 9e-5, 0}, {0, 0, 9e-6}}};
    const Pose2 before = estimate.pose();
    EXPECT_TRUE(estimate.see(contours));
    EXPECT_EQ(estimate.fixes().newest()[0].result, "agreed");
    EXPECT_NEAR(estimate.fixes().newest()[0].moved_m, 0.002, 1e-4);
    EXPECT_EQ(estimate.pose(), before);

    // A code a metre from where it should lie.
    localisation::CodeObservation seen;
    seen.payload = "C7";
    seen.centre = {1, 0};
    seen.sigma_m = 0.001;
    seen.sigma_up_rad = 0.002;
    localisation::SurveyedCode survey;
    survey.payload = "C7";
    survey.pose = {12, 5, 0};
    survey.sigma_m = 0.001;
    survey.sigma_heading_rad = 0.001;
    EXPECT_FALSE(estimate.see(seen, survey));
    EXPECT_EQ(estimate.fixes().newest()[0].what, "C7");
    EXPECT_EQ(estimate.fixes().newest()[0].result, "refused");
    EXPECT_EQ(estimate.fixes().newest()[0].why, "innovation_gate");
    EXPECT_NEAR(estimate.fixes().newest()[0].moved_m, 1, 0.05);

    stop.pose = {14, 5, 0};
    estimate.take(stop);
    EXPECT_EQ(estimate.fixes().newest()[0].result, "begun_anew");
}

}  // namespace
}  // namespace pulseline::onboard
