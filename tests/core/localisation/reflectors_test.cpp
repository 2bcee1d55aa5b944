#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "core/base/angle.hpp"
#include "core/localisation/reflector_pose.hpp"

namespace pulseline::localisation {
namespace {

const plant::NavigationScanner kScanner{{-0.9, 0.1, 0.02}, 2, 8};

/// Rays of one turn at a standing scanner.
std::vector<BrightEcho> rays_of(const std::vector<Point2>& seen_from_scanner,
                                std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    std::vector<BrightEcho> rays;
    for (const Point2 seen : seen_from_scanner) {
        const int most = static_cast<int>(2 * kPi / kScanner.step_rad);
        for (int i = 0; i < most; ++i) {
            const double angle_rad = wrap(i * kScanner.step_rad);
            const double along_m = seen.x_m * std::cos(angle_rad) + seen.y_m * std::sin(angle_rad);
            const double beside_m = seen.y_m * std::cos(angle_rad) - seen.x_m * std::sin(angle_rad);
            if (along_m <= 0 || std::abs(beside_m) > 1) continue;
            const double full = remission_at(kScanner, along_m, beside_m);
            const double remission = full * (1 + 0.05 * normal(random));
            if (remission < kLeastRemission) continue;
            rays.push_back({wrap(angle_rad + kScanner.sigma_bearing_rad * normal(random)),
                            along_m - kPi / 4 * kScanner.reflector_radius_m +
                                kScanner.sigma_range_m / std::sqrt(full) * normal(random),
                            remission, 0});
        }
    }
    return rays;
}

/// A hall of 40 m x 20 m, no two distances alike.
std::vector<plant::Reflector> hall() {
    std::vector<plant::Reflector> all;
    for (const Point2 at :
         {Point2{0.1, 3.1}, Point2{0.1, 14.2}, Point2{9.3, 19.9}, Point2{23.4, 19.9},
          Point2{39.9, 16.6}, Point2{39.9, 5.2}, Point2{30.7, 0.1}, Point2{12.2, 0.1}}) {
        plant::Reflector one;
        one.id = plant::ReflectorId("r" + std::to_string(all.size() + 1));
        one.position = at;
        all.push_back(one);
    }
    return all;
}

/// As they truly stand, by their survey's sigma.
std::vector<plant::Reflector> truly(std::vector<plant::Reflector> all, std::mt19937_64& random) {
    for (auto& one : all) {
        std::normal_distribution<double> off(0, one.sigma_m);
        one.position = one.position + Point2{off(random), off(random)};
    }
    return all;
}

std::vector<SeenReflector> seen_from(const std::vector<plant::Reflector>& all, const Pose2& pose,
                                     std::mt19937_64& random,
                                     const std::vector<Point2>& shining = {}) {
    const Pose2 scanner_from_hall = inverse(pose * kScanner.body_from_scanner);
    std::vector<Point2> places;
    for (const auto& one : all) places.push_back(scanner_from_hall * one.position);
    for (const Point2 at : shining) places.push_back(scanner_from_hall * at);
    std::vector<SeenReflector> seen;
    for (const auto& sight : reflector_sights(rays_of(places, random), kScanner)) {
        seen.push_back(seen_reflector(sight, kScanner));
    }
    return seen;
}

BelievedPose about(const Pose2& pose, double sigma_m, double sigma_rad) {
    const Eigen::Vector3d variance(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad);
    return {pose, variance.asDiagonal()};
}

TEST(ReflectorSights, AreAsGoodAsTheyState) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> anyhow(-kPi, kPi);
    for (const double range_m : {2.0, 5.0, 10.0, 20.0, 35.0, 50.0}) {
        double bearing2 = 0;
        double range2 = 0;
        int count = 0;
        for (int i = 0; i < 2000; ++i) {
            const double bearing_rad = anyhow(random);
            const Point2 at{range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad)};
            const auto sights = reflector_sights(rays_of({at}, random), kScanner);
            if (sights.empty()) continue;  // far off it falls between two rays now and then
            ASSERT_EQ(sights.size(), 1u) << range_m;
            const double off_rad = wrap(sights[0].bearing_rad - bearing_rad);
            bearing2 += std::pow(off_rad / sights[0].sigma_bearing_rad, 2);
            range2 += std::pow((sights[0].range_m - range_m) / sights[0].sigma_range_m, 2);
            ++count;
        }
        EXPECT_GT(count, 1900) << range_m << " m";
        EXPECT_LT(std::sqrt(bearing2 / count), 1.15) << range_m << " m";
        EXPECT_GT(std::sqrt(bearing2 / count), 0.8) << range_m << " m";
        EXPECT_LT(std::sqrt(range2 / count), 1.15) << range_m << " m";
        EXPECT_GT(std::sqrt(range2 / count), 0.8) << range_m << " m";
    }
}

TEST(ReflectorSights, OneAcrossTheSeamOfTheTurnIsOne) {
    std::mt19937_64 random(2);
    const auto sights = reflector_sights(rays_of({{-6, 0.001}, {4, 4}}, random), kScanner);
    ASSERT_EQ(sights.size(), 2u);
    EXPECT_EQ(reflector_sights(rays_of({{-6, 0.001}}, random), kScanner).size(), 1u);
}

TEST(ReflectorSights, TwoBehindEachOtherAndWhatIsTooWideAreNotOne) {
    std::vector<BrightEcho> behind;
    for (int i = -1; i <= 3; ++i)
        behind.push_back({i * kScanner.step_rad, i < 2 ? 6.0 : 9.0, 1, 0});
    EXPECT_EQ(reflector_sights(behind, kScanner).size(), 2u);
    std::vector<BrightEcho> sheet;  // of metal, half a metre wide
    for (int i = -14; i <= 14; ++i) sheet.push_back({i * kScanner.step_rad, 4, 1, 0});
    EXPECT_TRUE(reflector_sights(sheet, kScanner).empty());
    EXPECT_TRUE(reflector_sights({}, kScanner).empty());
    const std::vector<BrightEcho> broken{{0, std::nan(""), 1, 0},
                                         {0.1, -3, 1, 0},
                                         {0.2, 5, 0, 0},
                                         {std::nan(""), 5, 1, 0},
                                         {0.4, 1e-9, 1, 0}};
    EXPECT_TRUE(reflector_sights(broken, kScanner).empty());
}

TEST(LocateByReflectors, IsExactWhereSightsAre) {
    const Pose2 truth{17.3, 8.2, 2.4};
    const Pose2 scanner_from_hall = inverse(truth * kScanner.body_from_scanner);
    std::vector<SeenReflector> seen;
    for (const auto& one : hall()) {
        const Point2 at = scanner_from_hall * one.position;
        const ReflectorSight sight{std::atan2(at.y_m, at.x_m), std::hypot(at.x_m, at.y_m), 5e-4,
                                   0.005};
        seen.push_back(seen_reflector(sight, kScanner));
    }
    auto near = truth;
    near.x_m += 0.03;
    near.heading_rad += 0.002;
    const auto fix = locate_by_reflectors(seen, hall(), kScanner, about(near, 0.05, 0.005));
    ASSERT_TRUE(fix) << fix.error().what;
    EXPECT_LT(distance(fix->fix.pose.position(), truth.position()), 1e-9);
    EXPECT_NEAR(fix->fix.pose.heading_rad, truth.heading_rad, 1e-9);
    EXPECT_EQ(fix->fix.payloads.size(), 8u);
    EXPECT_EQ(to_string(fix->fix.method), std::string("reflectors"));
}

/// Of what is stated with 95 % so much has to hold: chi-square of three degrees of freedom.
TEST(LocateByReflectors, CoversTheTruthAsOftenAsItStates) {
    constexpr double kNinetyFive = 7.815;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> x(2, 38);
    std::uniform_real_distribution<double> y(2, 18);
    std::uniform_real_distribution<double> heading(-kPi, kPi);
    std::normal_distribution<double> normal;
    const ReflectorErrors errors;
    int covered = 0;
    constexpr int kRuns = 1000;
    double sum2 = 0;
    for (int run = 0; run < kRuns; ++run) {
        const Pose2 truth{x(random), y(random), heading(random)};
        // The scanner sits a little elsewhere than was calibrated.
        const Pose2& mounted = kScanner.body_from_scanner;
        const Pose2 sits{mounted.x_m + errors.mounting_m * normal(random),
                         mounted.y_m + errors.mounting_m * normal(random),
                         mounted.heading_rad + errors.mounting_rad * normal(random)};
        const Pose2 as_if = truth * sits * inverse(mounted);
        const auto seen = seen_from(truly(hall(), random), as_if, random);
        const auto fix = locate_by_reflectors(seen, hall(), kScanner, about(truth, 0.05, 0.01));
        ASSERT_TRUE(fix) << fix.error().what;
        const Eigen::Vector3d off(fix->fix.pose.x_m - truth.x_m, fix->fix.pose.y_m - truth.y_m,
                                  wrap(fix->fix.pose.heading_rad - truth.heading_rad));
        covered += off.dot(matrix(fix->fix.covariance).ldlt().solve(off)) <= kNinetyFive;
        sum2 += off.head<2>().squaredNorm();
    }
    EXPECT_NEAR(100.0 * covered / kRuns, 95, 3);
    EXPECT_LT(std::sqrt(sum2 / kRuns / 2), 0.002) << "an axis";
}

TEST(LocateByReflectors, OneThatWasMovedIsNamedAndLeftOut) {
    std::mt19937_64 random(6);
    const Pose2 truth{20, 10, 0.3};
    auto stand = hall();
    stand[2].position.x_m += 0.08;
    const auto fix = locate_by_reflectors(seen_from(stand, truth, random), hall(), kScanner,
                                          about(truth, 0.05, 0.01));
    ASSERT_TRUE(fix) << fix.error().what;
    ASSERT_EQ(fix->left_out.size(), 1u);
    EXPECT_EQ(fix->left_out[0].name, "r3");
    EXPECT_EQ(fix->left_out[0].code, "reflector_moved");
    EXPECT_LT(distance(fix->fix.pose.position(), truth.position()), 0.01);
}

TEST(LocateByReflectors, WithoutTwoItSaysHowManyItKnows) {
    std::mt19937_64 random(7);
    const Pose2 truth{20, 10, 0.3};
    const auto seen = seen_from(hall(), truth, random);
    const std::vector<plant::Reflector> one{hall()[0]};
    const auto fix = locate_by_reflectors(seen, one, kScanner, about(truth, 0.05, 0.01));
    ASSERT_FALSE(fix);
    EXPECT_EQ(fix.error().reason.code, "too_few_reflectors");
    EXPECT_FALSE(locate_by_reflectors({}, hall(), kScanner, about(truth, 0.05, 0.01)));
}

TEST(LocateByReflectors, WhatMayBeTwoReflectorsIsNeither) {
    std::mt19937_64 random(8);
    const Pose2 truth{20, 10, 0.3};
    const auto named =
        name_reflectors(seen_from(hall(), truth, random), hall(), about(truth, 5, 0.5));
    for (const auto& one : named) EXPECT_FALSE(one);
}

/// From anywhere, with two things that shine like reflectors and two reflectors hidden.
TEST(FindByReflectors, FindsItselfOrSaysThatItCannot) {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> x(2, 38);
    std::uniform_real_distribution<double> y(2, 18);
    std::uniform_real_distribution<double> heading(-kPi, kPi);
    int found = 0;
    constexpr int kRuns = 300;
    for (int run = 0; run < kRuns; ++run) {
        const Pose2 truth{x(random), y(random), heading(random)};
        auto stand = truly(hall(), random);
        stand.erase(stand.begin() + run % 7, stand.begin() + run % 7 + 2);
        const auto seen =
            seen_from(stand, truth, random, {{x(random), y(random)}, {x(random), y(random)}});
        const auto fix = find_by_reflectors(seen, hall(), kScanner);
        if (!fix) continue;
        ++found;
        EXPECT_LT(distance(fix->fix.pose.position(), truth.position()),
                  5 * fix->fix.sigma_xy_m + 0.005)
            << run;
    }
    EXPECT_GT(found, kRuns * 95 / 100);
}

TEST(FindByReflectors, WhereTwoPlacesLookAlikeItTakesNeither) {
    std::mt19937_64 random(10);
    std::vector<plant::Reflector> alike;  // a rectangle: as well from the other end
    for (const Point2 at : {Point2{0, 0}, Point2{20, 0}, Point2{20, 10}, Point2{0, 10}}) {
        plant::Reflector one;
        one.id = plant::ReflectorId("r" + std::to_string(alike.size()));
        one.position = at;
        alike.push_back(one);
    }
    const auto fix = find_by_reflectors(seen_from(alike, {6, 4, 1}, random), alike, kScanner);
    ASSERT_FALSE(fix);
    EXPECT_EQ(fix.error().reason.code, "reflectors_ambiguous");
    const auto three = find_by_reflectors(
        seen_from({alike[0], alike[1], alike[2]}, {6, 4, 1}, random), alike, kScanner);
    ASSERT_FALSE(three);
    EXPECT_EQ(three.error().reason.code, "too_few_reflectors");
}

/// Whoever sends nonsense must not hold up who works it out: places tried are bounded.
TEST(FindByReflectors, AGridOfEqualDistancesIsGivenUpSoon) {
    std::vector<plant::Reflector> grid;
    std::vector<SeenReflector> seen;
    for (int i = 0; i < 200; ++i) {
        plant::Reflector one;
        one.id = plant::ReflectorId("r" + std::to_string(i));
        one.position = {5.0 * (i % 20), 5.0 * (i / 20)};
        grid.push_back(one);
    }
    for (int i = 0; i < 12; ++i) {
        seen.push_back(
            {{5.0 * (i % 4) - 6, 5.0 * (i / 4) - 6}, 0.01 * Eigen::Matrix2d::Identity()});
    }
    const auto fix = find_by_reflectors(seen, grid, kScanner);
    ASSERT_FALSE(fix);
    EXPECT_EQ(fix.error().reason.code, "reflectors_ambiguous");
    EXPECT_FALSE(find_by_reflectors(seen, {}, kScanner)) << "told of none";
}

}  // namespace
}  // namespace pulseline::localisation
