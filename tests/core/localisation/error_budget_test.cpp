#include "core/localisation/error_budget.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace pulseline::localisation {
namespace {

constexpr double kBase_m = 10.692;
constexpr double kHeight_m = 0.455;
constexpr double kOffset_m = 0.030;

/// A platform with a code under each camera, each measured with the budget's sigma.
PoseFix measured(double sigma_m, const Pose2& truth, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    std::vector<CodeObservation> seen;
    std::vector<SurveyedCode> survey;
    for (const double side : {1.0, -1.0}) {
        const Pose2 code{side * kBase_m / 2 + 0.02, 0.022, 0.1};
        const std::string payload = side > 0 ? "ST01-F" : "ST01-B";
        survey.push_back({payload, truth * code, 0, 0});
        seen.push_back({payload,
                        {code.x_m + sigma_m * normal(random), code.y_m + sigma_m * normal(random)},
                        code.heading_rad,
                        sigma_m,
                        1e-3});
    }
    const auto fix = locate(seen, survey);
    EXPECT_TRUE(fix) << fix.error().what;
    return fix ? *fix : PoseFix{};
}

struct Spread {
    double xy_m = 0;
    double heading_deg = 0;
    double chi2 = 0;
};
Spread spread(double sigma_m) {
    std::mt19937_64 random{4};
    constexpr int kStops = 2000;
    Spread s;
    for (int i = 0; i < kStops; ++i) {
        const Pose2 truth{50, 20, radians(45)};
        const PoseFix fix = measured(sigma_m, truth, random);
        const Eigen::Vector3d e{fix.pose.x_m - truth.x_m, fix.pose.y_m - truth.y_m,
                                wrap(fix.pose.heading_rad - truth.heading_rad)};
        Eigen::Matrix3d c;
        for (int r = 0; r < 3; ++r)
            for (int k = 0; k < 3; ++k)
                c(r, k) = fix.covariance[static_cast<std::size_t>(r)][static_cast<std::size_t>(k)];
        s.xy_m += (e[0] * e[0] + e[1] * e[1]) / (2 * kStops);
        s.heading_deg += e[2] * e[2] / kStops;
        s.chi2 += e.dot(c.ldlt().solve(e)) / (3 * kStops);
    }
    s.xy_m = std::sqrt(s.xy_m);
    s.heading_deg = degrees(std::sqrt(s.heading_deg));
    return s;
}

TEST(ErrorBudget, OverTheWholePlatformWithUnknownTilt) {
    const Spread s = spread(code_sigma_m({}, kHeight_m, kOffset_m, 1e-6));
    EXPECT_LE(s.xy_m, 0.35e-3);
    EXPECT_LE(s.heading_deg, 0.004);
    EXPECT_NEAR(s.chi2, 1, 4 * std::sqrt(2.0 / (3 * 2000)));
}

TEST(ErrorBudget, OverTheWholePlatformWithCalibratedTiltAndScale) {
    ErrorBudget budget;
    budget.tilt_rad = radians(0.01);
    budget.relative_scale = 0.001;
    budget.height_change_m = 0.0002;
    const Spread s = spread(code_sigma_m(budget, kHeight_m, kOffset_m, 1e-6));
    EXPECT_LE(s.xy_m, 0.15e-3);
    EXPECT_LE(s.heading_deg, 0.0016);
    EXPECT_NEAR(s.chi2, 1, 4 * std::sqrt(2.0 / (3 * 2000)));
}

}  // namespace
}  // namespace pulseline::localisation
