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
        PoseFilter filter(
            {1e-3 * normal(random), 1e-3 * normal(random), 0.3 + 1e-3 * normal(random)},
            diagonal(1e-3, 1e-3));
        for (int i = 0; i < 40; ++i) {
            const Odometry told{0.05, 0.01, 0.02};
            const double way = std::hypot(told.forward_m, told.left_m);
            const double step = noise.sigma_m_per_sqrt_m * std::sqrt(way);
            const double turn = std::hypot(noise.sigma_rad_per_sqrt_rad * std::sqrt(told.turn_rad),
                                           noise.sigma_rad_per_sqrt_m * std::sqrt(way));
            const double forward = told.forward_m + step * normal(random);
            const double left = told.left_m + step * normal(random);
            const double turned = told.turn_rad + turn * normal(random);
            const double middle = truth.heading_rad + turned / 2;
            truth = {truth.x_m + std::cos(middle) * forward - std::sin(middle) * left,
                     truth.y_m + std::sin(middle) * forward + std::cos(middle) * left,
                     wrap(truth.heading_rad + turned)};
            filter.drive(told, noise);
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
