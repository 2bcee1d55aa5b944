#include "core/localisation/dual_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace pulseline::localisation {
namespace {

constexpr double kHalfBaseline_m = 5.346;

double param(const Error& error, const std::string& name) {
    for (const Param& p : error.reason.params)
        if (p.name == name) return std::get<double>(p.value);
    ADD_FAILURE() << "no parameter " << name;
    return 0;
}

class LocateRandomPoses : public ::testing::Test {
protected:
    double uniform(double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random_);
    }
    double normal(double sigma) { return std::normal_distribution<double>(0, sigma)(random_); }

    /// A code somewhere under the vehicle, seen exactly.
    void add_code(const Pose2& hall_from_body, const Pose2& body_from_code, double sigma_m) {
        const std::string payload = "ST01-" + std::to_string(survey_.size());
        survey_.push_back({payload, hall_from_body * body_from_code, sigma_m, 1e-4});
        seen_.push_back({payload, body_from_code.position(), body_from_code.heading_rad, 0, 1e-4});
    }

    std::mt19937_64 random_{20};
    std::vector<SurveyedCode> survey_;
    std::vector<CodeObservation> seen_;
};

TEST(Locate, ReproducesTheVectorOfTangsEquations18And19) {
    // The test vector of core/localisation/README.md: image centres in px, camera frame y to the
    // RIGHT.
    const double lambda_m = 0.13713984375e-3;
    const Pose2 station{50, 20, radians(45)};
    const std::vector<SurveyedCode> survey{
        {"ST04-F", station * Pose2{kHalfBaseline_m, 0, 0}, 1e-4, 1e-4},
        {"ST04-B", station * Pose2{-kHalfBaseline_m, 0, 0}, 1e-4, 1e-4}};
    const std::vector<CodeObservation> seen{
        {"ST04-F", {lambda_m * 47.730474 + kHalfBaseline_m, -lambda_m * 34.434771}, 0, 1e-5, 1e-4},
        {"ST04-B", {lambda_m * 47.767713 - kHalfBaseline_m, lambda_m * 41.766221}, 0, 1e-5, 1e-4}};

    const auto fix = locate(seen, survey);

    ASSERT_TRUE(fix);
    EXPECT_NEAR(fix->pose.x_m, 49.99573, 1e-7);
    EXPECT_NEAR(fix->pose.y_m, 19.99501, 1e-7);
    EXPECT_NEAR(degrees(fix->pose.heading_rad), 45.056, 1e-6);
    EXPECT_EQ(fix->method, Method::kDualCamera);
    const Pose2 in_station = inverse(station) * fix->pose;
    EXPECT_NEAR(in_station.x_m, -6.547809e-3, 1e-7);
    EXPECT_NEAR(in_station.y_m, -0.509117e-3, 1e-7);  // Tang's e_y is to the right
}

TEST_F(LocateRandomPoses, RecoversAnyPoseFromExactCodes) {
    for (int round = 0; round < 2000; ++round) {
        survey_.clear();
        seen_.clear();
        const Pose2 truth{uniform(-100, 100), uniform(-100, 100), uniform(-kPi, kPi)};
        const int codes = 1 + round % 4;
        for (int i = 0; i < codes; ++i)
            add_code(truth, {uniform(-6, 6), uniform(-6, 6), uniform(-kPi, kPi)}, 1e-4);

        const auto fix = locate(seen_, survey_);

        ASSERT_TRUE(fix) << fix.error().what;
        EXPECT_NEAR(fix->pose.x_m, truth.x_m, 1e-9);
        EXPECT_NEAR(fix->pose.y_m, truth.y_m, 1e-9);
        EXPECT_NEAR(wrap(fix->pose.heading_rad - truth.heading_rad), 0, 1e-9);
        EXPECT_EQ(fix->residual_m.has_value(), codes >= 2);
    }
}

TEST_F(LocateRandomPoses, SigmaOfTwoCodesIsThePapersBudget) {
    add_code({}, {kHalfBaseline_m, 0, 0}, 5e-5);
    add_code({}, {-kHalfBaseline_m, 0, 0}, 5e-5);

    const auto fix = locate(seen_, survey_);

    ASSERT_TRUE(fix);
    EXPECT_NEAR(fix->sigma_xy_m, 0.0354e-3, 1e-7);
    EXPECT_NEAR(degrees(fix->sigma_heading_rad), 3.79e-4, 1e-6);
}

/// Normalised estimation error squared over many noisy stops: 3 on average when the covariance is
/// honest.
TEST_F(LocateRandomPoses, CovarianceIsHonest) {
    for (const int codes : {1, 2, 3}) {
        double sum = 0;
        int accepted = 0;
        const int rounds = 4000;
        for (int round = 0; round < rounds; ++round) {
            survey_.clear();
            seen_.clear();
            const Pose2 truth{uniform(-50, 50), uniform(-50, 50), uniform(-kPi, kPi)};
            const double sigmas[] = {1e-4, 3e-4, 2e-4};
            const Point2 places[] = {{5.3, 0.2}, {-5.3, 0}, {0, 1.1}};
            for (int i = 0; i < codes; ++i) {
                add_code(truth, {places[i].x_m, places[i].y_m, 0.3}, 0.5e-4);
                seen_.back().sigma_m = sigmas[i];
                const double sigma = std::hypot(sigmas[i], 0.5e-4);
                seen_.back().centre.x_m += normal(sigma);
                seen_.back().centre.y_m += normal(sigma);
                seen_.back().up_rad += normal(std::hypot(1e-4, 1e-4));
            }
            const auto fix = locate(seen_, survey_);
            if (!fix) continue;
            ++accepted;
            const double d[] = {fix->pose.x_m - truth.x_m, fix->pose.y_m - truth.y_m,
                                wrap(fix->pose.heading_rad - truth.heading_rad)};
            // The lever arm is the only correlation: take it out, then the parts are independent.
            const auto& c = fix->covariance;
            const double gx = c[0][2] / c[2][2];
            const double gy = c[1][2] / c[2][2];
            const double ex = d[0] - gx * d[2];
            const double ey = d[1] - gy * d[2];
            sum += ex * ex / (c[0][0] - gx * c[0][2]) + ey * ey / (c[1][1] - gy * c[1][2]) +
                   d[2] * d[2] / c[2][2];
        }
        EXPECT_GE(accepted, rounds * 0.998) << codes << " codes";
        EXPECT_NEAR(sum / accepted, 3, 0.15) << codes << " codes";
    }
}

TEST(Locate, RefusesWhenNoCodeIsSeen) {
    const auto fix = locate({}, {});
    ASSERT_FALSE(fix);
    EXPECT_EQ(fix.error().reason.code, "no_marker_in_view");
}

TEST_F(LocateRandomPoses, RefusesACodeThatIsNotSurveyed) {
    add_code({}, {5, 0, 0}, 1e-4);
    add_code({}, {-5, 0, 0}, 1e-4);
    seen_[1].payload = "ST09-B";

    const auto fix = locate(seen_, survey_);

    ASSERT_FALSE(fix);
    EXPECT_EQ(fix.error().reason.code, "unknown_code");
    EXPECT_EQ(std::get<std::string>(fix.error().reason.params.at(0).value), "ST09-B");
}

TEST_F(LocateRandomPoses, RefusesACodeThatWasMovedAlongTheBaseline) {
    add_code({3, 4, 1}, {5, 0, 0}, 1e-4);
    add_code({3, 4, 1}, {-5, 0, 0}, 1e-4);
    seen_[0].centre.x_m += 0.5e-3;  // limit is 4 sqrt(2) 0.1 mm = 0.566 mm
    EXPECT_TRUE(locate(seen_, survey_));
    seen_[0].centre.x_m += 0.2e-3;

    const auto fix = locate(seen_, survey_);

    ASSERT_FALSE(fix);
    EXPECT_EQ(fix.error().reason.code, "code_distance_mismatch");
    EXPECT_NEAR(param(fix.error(), "residual_m"), 0.7e-3, 1e-9);
    EXPECT_NEAR(param(fix.error(), "limit_m"), 0.5657e-3, 1e-6);
}

TEST_F(LocateRandomPoses, RefusesCodesThatWereExchangedOrTurned) {
    add_code({3, 4, 1}, {5, 0, 0.2}, 1e-4);
    add_code({3, 4, 1}, {-5, 0, -0.1}, 1e-4);
    auto exchanged = seen_;
    std::swap(exchanged[0].payload, exchanged[1].payload);
    auto turned = seen_;
    turned[1].up_rad += 0.02;

    EXPECT_TRUE(locate(seen_, survey_));
    const auto none = locate(exchanged, survey_);
    const auto other = locate(turned, survey_);

    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().reason.code, "code_angle_mismatch");
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().reason.code, "code_angle_mismatch");
    EXPECT_NEAR(param(other.error(), "residual_rad"), -0.02, 1e-9);
}

TEST_F(LocateRandomPoses, OneCodeSeenTwiceCountsAsOne) {
    add_code({3, 4, 1}, {5, 0, 0.2}, 1e-4);
    seen_.push_back(seen_[0]);

    const auto fix = locate(seen_, survey_);

    ASSERT_TRUE(fix);
    EXPECT_EQ(fix->method, Method::kSingleCamera);
    EXPECT_NEAR(fix->pose.heading_rad, 1, 1e-12);
}

/// An observation that no camera can have made gives an error: never a pose of infinities.
TEST_F(LocateRandomPoses, WhatCannotBeSeenGivesNoPose) {
    add_code({3, 4, 1}, {5, 0, 0.2}, 1e-4);
    add_code({3, 4, 1}, {-5, 0, -0.1}, 1e-4);
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    for (const std::size_t codes : {1, 2}) {
        for (const double value : {1.7e308, -1.7e308, 1e300, 1e4, kInfinite, -kInfinite, kNone}) {
            for (double CodeObservation::*sigma :
                 {&CodeObservation::up_rad, &CodeObservation::sigma_m}) {
                auto seen = std::vector(seen_.begin(), seen_.begin() + codes);
                seen[0].*sigma = value;
                const auto fix = locate(seen, survey_);
                EXPECT_TRUE(!fix || std::isfinite(fix->pose.x_m + fix->pose.heading_rad)) << value;
            }
            for (const Point2 centre :
                 {Point2{value, 0}, Point2{0, value}, Point2{value, -value}}) {
                auto seen = std::vector(seen_.begin(), seen_.begin() + codes);
                seen[0].centre = centre;
                const auto fix = locate(seen, survey_);
                ASSERT_FALSE(fix) << value;
                EXPECT_EQ(fix.error().reason.code, "code_out_of_view");
            }
        }
    }
}

}  // namespace
}  // namespace pulseline::localisation
