#include "core/localisation/error_budget.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/localisation/dual_camera.hpp"

namespace pulseline::localisation {
namespace {

constexpr double kOffset_m = 0.030;

double term(const ErrorBudget& budget, std::string_view name) {
    const auto terms = code_terms(budget, {}, kOffset_m, true);
    const auto found = std::ranges::find(terms, name, &ErrorTerm::name);
    EXPECT_NE(found, terms.end()) << name;
    return found == terms.end() ? 0 : found->sigma_m;
}

/// What a platform over two codes states, each with the budget's sigma and a survey of 0.1 mm.
PoseFix fix_with(const ErrorBudget& budget) {
    constexpr double kHalfBase_m = 10.692 / 2;
    std::vector<CodeObservation> seen;
    std::vector<SurveyedCode> survey;
    for (const double side : {1.0, -1.0}) {
        const Pose2 code{side * kHalfBase_m, 0, 0};
        const std::string payload = side > 0 ? "ST01-F" : "ST01-B";
        survey.push_back({payload, code, 1e-4, 1e-3});
        seen.push_back(
            {payload, code.position(), 0, code_sigma_m(budget, {}, kOffset_m, 1e-6, true), 1e-3});
    }
    const auto fix = locate(seen, survey);
    EXPECT_TRUE(fix) << fix.error().what;
    return fix ? *fix : PoseFix{};
}

// The figures of the papers' camera: 455 mm above the floor, F = 3317.78 px.
TEST(ErrorBudget, TiltAloneMovesACodeByFourTenthsOfAMillimetre) {
    EXPECT_NEAR(term(ErrorBudget::nominal(), "tilt"), 0.40e-3, 0.005e-3);
    EXPECT_NEAR(term(ErrorBudget::kind(), "tilt"), 0.08e-3, 0.005e-3);
}

TEST(ErrorBudget, FocalLengthAndHeightStretchWhatIsSeenBesideTheMiddle) {
    EXPECT_NEAR(term(ErrorBudget::nominal(), "focal length"), 0.09e-3, 0.005e-3);
    EXPECT_NEAR(term(ErrorBudget::nominal(), "height"), 0.074e-3, 0.005e-3);
    const auto middle = code_terms(ErrorBudget::nominal(), {}, 0);
    EXPECT_EQ(std::ranges::find(middle, "focal length", &ErrorTerm::name)->sigma_m, 0);
}

TEST(ErrorBudget, APlatformAsItComesFromAssemblyKnowsItsPlaceToAThirdOfAMillimetre) {
    const PoseFix fix = fix_with(ErrorBudget::nominal());
    EXPECT_NEAR(fix.sigma_xy_m, 0.32e-3, 0.02e-3);
    EXPECT_NEAR(degrees(fix.sigma_heading_rad), 0.0036, 0.0003);
}

TEST(ErrorBudget, OneWithCalibratedCamerasKnowsItBetterThanASeventhOfAMillimetre) {
    const PoseFix fix = fix_with(ErrorBudget::kind());
    EXPECT_LT(fix.sigma_xy_m, 0.14e-3);
    EXPECT_LT(degrees(fix.sigma_heading_rad), 0.0015);
}

TEST(ErrorBudget, TheFormsAreOrdered) {
    for (const ErrorTerm& nominal : code_terms(ErrorBudget::nominal(), {}, kOffset_m, true)) {
        EXPECT_LT(term(ErrorBudget::kind(), nominal.name), nominal.sigma_m) << nominal.name;
        EXPECT_NEAR(term(ErrorBudget::harsh(), nominal.name), 2 * nominal.sigma_m, 1e-9)
            << nominal.name;
    }
    EXPECT_LT(ErrorBudget::kind().drive.diameter_common,
              ErrorBudget::nominal().drive.diameter_common);
    EXPECT_EQ(ErrorBudget::harsh().drive.creep_stiffness,
              ErrorBudget::nominal().drive.creep_stiffness);
}

}  // namespace
}  // namespace pulseline::localisation
