#include "core/localisation/pose_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace pulseline::localisation {
namespace {

Eigen::Matrix3d diagonal(double xy, double heading) {
    return Eigen::Vector3d(xy * xy, xy * xy, heading * heading).asDiagonal();
}
Eigen::Vector3d error(const PoseFilter& filter, const Pose2& truth) {
    return {filter.pose().x_m - truth.x_m, filter.pose().y_m - truth.y_m,
            wrap(filter.pose().heading_rad - truth.heading_rad)};
}

TEST(PoseFilter, DrivesAnArcOntoItsChord) {
    PoseFilter filter({0, 0, 0}, diagonal(1e-3, 1e-3));
    for (int i = 0; i < 900; ++i) filter.drive({radians(0.1), 0, radians(0.1)});
    // A quarter circle of 1 m.
    EXPECT_NEAR(filter.pose().x_m, 1, 1e-6);
    EXPECT_NEAR(filter.pose().y_m, 1, 1e-6);
    EXPECT_NEAR(filter.pose().heading_rad, kPi / 2, 1e-9);
}

/// Law of honesty: over many drives the normalised squared error is chi-square of 3 degrees.
TEST(PoseFilter, ItsCovarianceIsHonest) {
    std::mt19937_64 random{21};
    std::normal_distribution<double> normal;
    const OdometryNoise noise;
    double sum = 0;
    constexpr int kDrives = 400;
    for (int d = 0; d < kDrives; ++d) {
        Pose2 truth{0, 0, 0.3};
        const double scale = noise.scale * normal(random);
        const double crab_rad = noise.crab_rad * normal(random);
        const double bend_rad_per_m = noise.bend_rad_per_m * normal(random);
        PoseFilter filter(
            {1e-3 * normal(random), 1e-3 * normal(random), 0.3 + 1e-3 * normal(random)},
            diagonal(1e-3, 1e-3));
        for (int i = 0; i < 40; ++i) {
            const Odometry told{0.05, 0.01, 0.02};
            const double root = std::sqrt(std::hypot(told.forward_m, told.left_m));
            const double root_aside = std::sqrt(told.left_m);
            const double turn = std::hypot(
                noise.heading_rad_per_sqrt_rad * std::sqrt(told.turn_rad),
                noise.heading_rad_per_sqrt_m * root, noise.sideways_rad_per_sqrt_m * root_aside);
            const double forward = (1 + scale) * told.forward_m - crab_rad * told.left_m +
                                   noise.forward_m_per_sqrt_m * root * normal(random);
            const double left = (1 + scale) * told.left_m + crab_rad * told.forward_m +
                                std::hypot(noise.left_m_per_sqrt_m * root,
                                           noise.sideways_m_per_sqrt_m * root_aside) *
                                    normal(random);
            const double turned =
                told.turn_rad + bend_rad_per_m * told.forward_m + turn * normal(random);
            const double middle = truth.heading_rad + turned / 2;
            truth = {truth.x_m + std::cos(middle) * forward - std::sin(middle) * left,
                     truth.y_m + std::sin(middle) * forward + std::cos(middle) * left,
                     wrap(truth.heading_rad + turned)};
            filter.drive(told);
            if (i % 10 != 9) continue;
            const SurveyedCode code{"17", truth * Pose2{0.4, 0.1, 1}, 1e-4, 3e-4};
            CodeObservation seen{"17", {}, 0, 2e-4, 4e-4};
            const SurveyedCode real{
                "17",
                {code.pose.x_m + code.sigma_m * normal(random),
                 code.pose.y_m + code.sigma_m * normal(random),
                 code.pose.heading_rad + code.sigma_heading_rad * normal(random)},
                0,
                0};
            const Pose2 in_body = inverse(truth) * real.pose;
            seen.centre = {in_body.x_m + seen.sigma_m * normal(random),
                           in_body.y_m + seen.sigma_m * normal(random)};
            seen.up_rad = wrap(in_body.heading_rad + seen.sigma_up_rad * normal(random));
            (void)filter.correct(seen, code);
        }
        const Eigen::Vector3d e = error(filter, truth);
        sum += e.dot(filter.covariance().ldlt().solve(e));
    }
    // Mean of chi-square / 3: 1 +- 4 sqrt(2 / (3 n)).
    EXPECT_NEAR(sum / (3 * kDrives), 1, 4 * std::sqrt(2.0 / (3 * kDrives)));
}

/// Codes every 10 m of a straight way: the constants come out, and what is known between the codes
/// gets better.
TEST(PoseFilter, CodesShowWhatTheOdometryMakesWrongInEveryStep) {
    OdometryNoise noise;
    noise.forward_m_per_sqrt_m = noise.left_m_per_sqrt_m = 1e-4;
    noise.heading_rad_per_sqrt_m = 1e-5;
    constexpr double kScale = 4e-4;
    constexpr double kCrab_rad = -3e-4;
    constexpr double kBend_rad_per_m = 6e-5;
    Pose2 truth;
    PoseFilter filter(truth, diagonal(1e-4, 1e-4), noise);
    double first_m = 0;
    double last_m = 0;
    for (int code = 0; code < 12; ++code) {
        for (int i = 0; i < 100; ++i) {
            truth = truth * Pose2{0.1 * (1 + kScale), 0.1 * kCrab_rad, 0.1 * kBend_rad_per_m};
            filter.drive({0.1, 0, 0});
        }
        last_m = error(filter, truth).head<2>().norm();
        if (code == 0) first_m = last_m;
        const SurveyedCode survey{"17", truth, 1e-5, 1e-5};
        ASSERT_TRUE(filter.correct({"17", {0, 0}, 0, 1e-5, 1e-5}, survey)) << code;
    }
    EXPECT_NEAR(filter.scale(), kScale, 4e-5);
    EXPECT_NEAR(filter.crab_rad(), kCrab_rad, 4e-5);
    EXPECT_NEAR(filter.bend_rad_per_m(), kBend_rad_per_m, 4e-6);
    EXPECT_GT(first_m, 3e-3);
    EXPECT_LT(last_m, first_m / 10);
    // Moved by hand it has not forgotten them.
    filter.restart({3, 3, 1}, diagonal(1e-3, 1e-3));
    EXPECT_NEAR(filter.scale(), kScale, 4e-5);
    EXPECT_NEAR(filter.sigma_xy_m(), 1e-3, 1e-9);
}

TEST(PoseFilter, ATurnMakesTheSlopesShareUnknownAgainAndNeverMoreThanAtFirst) {
    const OdometryNoise noise;
    PoseFilter known({}, diagonal(1e-4, 1e-4), noise);
    for (int code = 1; code <= 30; ++code) {
        for (int i = 0; i < 100; ++i) known.drive({0.1, 0, 0});
        ASSERT_TRUE(known.correct({"17", {0, 0}, 0, 1e-5, 1e-5},
                                  SurveyedCode{"17", {10.0 * code, 0, 0}, 1e-5, 1e-5}));
    }
    const auto fades_m = [](PoseFilter filter, int turns) {
        for (int i = 0; i < turns; ++i) filter.drive({0, 0, radians(1)});
        filter.restart({}, diagonal(1e-6, 1e-6));
        filter.drive({0.5, 0, 0});
        return filter.sigma_xy_m();
    };
    const PoseFilter fresh({}, diagonal(1e-6, 1e-6), noise);
    EXPECT_LT(fades_m(known, 0), fades_m(known, 90));
    EXPECT_LE(fades_m(known, 100'000), fades_m(fresh, 0) * 1.001);
}

TEST(PoseFilter, KnowsThatTheChassisSagsWhenItComesToRest) {
    PoseFilter filter({}, diagonal(1e-4, 1e-4));
    filter.rest(0);
    const double crept_m = filter.sigma_xy_m();
    filter.rest(1);
    EXPECT_LT(crept_m, 2e-4);
    EXPECT_GT(filter.sigma_xy_m(), OdometryNoise{}.settle_m);
}

TEST(PoseFilter, RefusesACodeThatContradictsTheWay) {
    PoseFilter filter({10, 5, 0}, diagonal(1e-3, 1e-3));
    const SurveyedCode moved{"17", {10.45, 5, 1}, 1e-4, 3e-4};
    const Status status = filter.correct({"17", {0.4, 0}, 1, 1e-4, 3e-4}, moved);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().reason.code, "innovation_gate");
    EXPECT_EQ(filter.pose(), (Pose2{10, 5, 0}));
}

TEST(PoseFilter, AFixWithinChanceIsTakenAndSharpensThePose) {
    PoseFilter filter({10, 5, 0}, diagonal(0.01, 0.01));
    PoseFix fix;
    fix.pose = {10.008, 4.99, 0.004};
    fix.covariance = {{{1e-8, 0, 0}, {0, 1e-8, 0}, {0, 0, 1e-9}}};
    ASSERT_TRUE(filter.correct(fix));
    EXPECT_NEAR(filter.pose().x_m, 10.008, 2e-5);
    EXPECT_LT(filter.sigma_xy_m(), 1.1e-4);
    EXPECT_LT(filter.sigma_heading_rad(), 3.5e-5);
}

TEST(LocalizationScore, FallsWithBothSigmas) {
    EXPECT_GT(localization_score(1e-4, 1e-5, 0.025, 0.0035), 0.99);
    EXPECT_NEAR(localization_score(0.025, 0, 0.025, 0.0035), 0.5, 1e-12);
    EXPECT_LT(localization_score(0.025, 0.035, 0.025, 0.0035), 0.05);
}

}  // namespace
}  // namespace pulseline::localisation
