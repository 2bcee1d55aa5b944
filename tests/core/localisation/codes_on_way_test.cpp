#include "core/localisation/codes_on_way.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace pulseline::localisation {
namespace {

using kinematics::Segment;

/// One camera ahead of the centre, 175 mm x 140 mm of floor.
std::vector<plant::Camera> camera_ahead() {
    plant::Camera camera;
    camera.body_from_camera = {1.2, 0, 0};
    return {camera};
}

plant::Marker code_at(double x_m, double y_m) {
    plant::Marker marker;
    marker.size_m = 0.06;
    marker.pose = {x_m, y_m, 0};
    return marker;
}

bool passed(const plant::Marker& marker, const Segment& segment) {
    return is_passed(marker, camera_ahead(), segment);
}

Segment straight(double length_m) {
    Segment segment;
    segment.start = {0, 0, 0};
    segment.end = {length_m, 0, 0};
    segment.length_m = length_m;
    return segment;
}

TEST(CodesOnWay, ArePassedWhereACameraSeesThemWhole) {
    const Segment way = straight(2);
    EXPECT_TRUE(passed(code_at(2.2, 0), way));
    EXPECT_TRUE(passed(code_at(1.2, 0.03), way)) << "(140 mm - 60 mm) / 2 beside the way";
    EXPECT_FALSE(passed(code_at(2.2, 0.05), way)) << "cut at the border of the picture";
    EXPECT_FALSE(passed(code_at(0.5, 0), way)) << "the camera was ahead of it already";
    EXPECT_FALSE(passed(code_at(3.5, 0), way)) << "beyond its end";
}

TEST(CodesOnWay, ArePassedByACameraThatSwingsWithATurn) {
    Segment turn;
    turn.kind = Segment::Kind::kRotate;
    turn.end = {0, 0, kPi / 2};
    turn.turn_rad = kPi / 2;
    const double diagonal_m = 1.2 * std::sqrt(0.5);
    EXPECT_TRUE(passed(code_at(diagonal_m, diagonal_m), turn));
    EXPECT_FALSE(passed(code_at(diagonal_m, -diagonal_m), turn)) << "the other way round";
    EXPECT_FALSE(passed(code_at(0.2, 0), turn)) << "below the body, not below the camera";
}

TEST(CodesOnWay, AreSeenWhereTheCameraIsAboveThem) {
    const auto shares = seen_at(code_at(2.2, 0), camera_ahead(), straight(2));
    ASSERT_FALSE(shares.empty());
    EXPECT_NEAR(shares.front(), 0.5 - 0.04 / 2, 0.02);
    EXPECT_NEAR(shares.back(), 0.5 + 0.04 / 2, 0.02);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_TRUE(seen_at(code_at(9, 0), camera_ahead(), straight(2)).empty());
}

/// A turn on the spot of a camera at the body's middle moves it by nothing.
TEST(CodesOnWay, AWayOfNoLengthSeesWhatLiesBelowIt) {
    plant::Camera camera;
    Segment turn;
    turn.kind = Segment::Kind::kRotate;
    turn.start = {2, 0, 0};
    turn.end = {2, 0, 1};
    turn.turn_rad = 1;
    const std::vector<plant::Camera> cameras{camera};
    EXPECT_FALSE(seen_at(code_at(2, 0), cameras, turn).empty());
    EXPECT_TRUE(seen_at(code_at(9, 0), cameras, turn).empty());
}

TEST(BlindWay, IsLongerWithALargerViewAndShorterWithWorseWheels) {
    const plant::Camera camera = camera_ahead().front();
    const double usual_m = blind_way_m(camera, 0.05);
    EXPECT_GT(usual_m, 9) << "the codes of the demo hall's lanes lie 9 m apart";
    EXPECT_LT(usual_m, 40);
    EXPECT_GT(blind_way_m(camera, 0.03), usual_m) << "the print of eq. 5 has the sign wrong";
    OdometryNoise worse;
    worse.heading_rad_per_sqrt_m *= 3;
    EXPECT_LT(blind_way_m(camera, 0.05, {}, worse), usual_m);
    EXPECT_EQ(blind_way_m(camera, 0.2), 0) << "larger than the picture";
}

/// Drives along a way, turning on the spot first, whose errors grow as the filter supposes: how
/// many do not catch the code at its end.
int missed_of(int drives, const plant::Camera& camera, double size_m, double way_m,
              double turn_rad) {
    const OdometryNoise noise;
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    constexpr double kStep_m = 0.1;
    const double radius_m = view_radius_m(camera, size_m);
    int missed = 0;
    for (int drive = 0; drive < drives; ++drive) {
        double heading_rad =
            normal(random) * 5.4e-4 +  // what the first code leaves
            (turn_rad > 0 ? normal(random) * turn_sigma_rad(turn_rad, true, noise) : 0);
        double across_m = normal(random) * 6e-4;
        const double crab_rad = normal(random) * noise.crab_rad;
        const double bend_rad_per_m = normal(random) * noise.bend_rad_per_m;
        for (double s_m = 0; s_m < way_m; s_m += kStep_m) {
            across_m += kStep_m * (heading_rad + crab_rad) +
                        normal(random) * noise.left_m_per_sqrt_m * std::sqrt(kStep_m);
            heading_rad += kStep_m * bend_rad_per_m +
                           normal(random) * noise.heading_rad_per_sqrt_m * std::sqrt(kStep_m);
        }
        across_m += heading_rad * camera.body_from_camera.x_m;
        missed += std::abs(across_m) > radius_m ? 1 : 0;
    }
    return missed;
}

/// The law that it promises.
TEST(BlindWay, ThreeSigmaOfTheDrivesCatchTheNextCode) {
    const plant::Camera camera = camera_ahead().front();
    constexpr int kDrives = 20'000;
    const int missed = missed_of(kDrives, camera, 0.05, blind_way_m(camera, 0.05), 0);
    // 0.27 % of a normal distribution lie beyond three sigma.
    EXPECT_LE(missed, kDrives * 0.004);
    EXPECT_GE(missed, kDrives * 0.0005) << "it promises no less than it could";
}

TEST(BlindWay, BehindATurnItIsShorter) {
    const plant::Camera camera = camera_ahead().front();
    const KnownPose known = known_by_code(camera, {});
    const double arm_m = norm(camera.body_from_camera.position());
    const double straight_m = blind_way_m(camera, 0.05);
    constexpr double kTurn_rad = 3;
    const auto counts_as_m = [&](double way_m) {
        const TurnBehind turn{kTurn_rad, way_m};
        return as_straight_m(known, way_m, arm_m, {&turn, 1}, {});
    };
    double way_m = 0;
    while (counts_as_m(way_m + 0.1) <= straight_m) way_m += 0.1;
    EXPECT_LT(way_m, 0.95 * straight_m);
    EXPECT_EQ(as_straight_m(known, 7, arm_m, {}, {}), 7);
    constexpr int kDrives = 20'000;
    const int missed = missed_of(kDrives, camera, 0.05, way_m, kTurn_rad);
    EXPECT_LE(missed, kDrives * 0.004);
    EXPECT_GE(missed, kDrives * 0.0005);
    EXPECT_GT(missed_of(kDrives, camera, 0.05, straight_m, kTurn_rad), missed);
}

}  // namespace
}  // namespace pulseline::localisation
