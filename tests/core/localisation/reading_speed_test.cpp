#include "core/localisation/reading_speed.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/localisation/codes_on_way.hpp"

namespace pulseline::localisation {
namespace {

using kinematics::Segment;

/// 1 m of floor is 1000 px, the narrower side of the view 0.2 m.
plant::Camera round_camera(double x_m = 0) {
    plant::Camera camera;
    camera.body_from_camera = {x_m, 0, 0};
    camera.height_m = 0.5;
    camera.f_px = 500;
    camera.width_px = 300;
    camera.height_px = 200;
    camera.frame_rate_hz = 20;
    camera.exposure_s = 1e-3;
    return camera;
}

plant::VehicleType type_of(double max_speed_mps) {
    plant::VehicleType type;
    type.max_speed_mps = max_speed_mps;
    type.max_turn_rate_radps = 10;
    return type;
}

plant::Marker code_at(double x_m, double y_m, double size_m = 0.1) {
    plant::Marker marker;
    marker.size_m = size_m;
    marker.pose = {x_m, y_m, 0};
    return marker;
}

Segment straight(double length_m) {
    Segment segment;
    segment.end = {length_m, 0, 0};
    segment.length_m = length_m;
    return segment;
}

/// By hand: r = (0.2 m - 0.1 m) / 2 = 50 mm, beside by 25 mm the way in view is 2 x 43.30 mm.
TEST(ReadingSpeed, IsOnePictureInTheViewOfTheCode) {
    EXPECT_NEAR(reading_speed_mps(round_camera(), 0.1), 20 * 0.08660254, 1e-6);
    EXPECT_NEAR(reading_speed_mps(round_camera(), 0.15), 20 * 0.04330127, 1e-6);
    auto faster = round_camera();
    faster.frame_rate_hz = 40;
    EXPECT_NEAR(reading_speed_mps(faster, 0.1), 40 * 0.08660254, 1e-6);
}

/// 6 px are 6 mm of floor, driven in 10 ms.
TEST(ReadingSpeed, IsNoMoreThanTheSmearThatAReaderTakes) {
    auto slow_shutter = round_camera();
    slow_shutter.exposure_s = 0.01;
    EXPECT_NEAR(reading_speed_mps(slow_shutter, 0.1), 0.6, 1e-9);
    slow_shutter.height_m = 1;  // twice the floor, half the pixels on each millimetre
    EXPECT_NEAR(reading_speed_mps(slow_shutter, 0.1), 1.2, 1e-9);
}

TEST(ReadingSpeed, IsNoneForACodeThatTheViewNeverHoldsWhole) {
    EXPECT_EQ(reading_speed_mps(round_camera(), 0.2), 0);
    EXPECT_EQ(reading_speed_mps(round_camera(), 0.5), 0);
}

TEST(ReadingSpeed, LimitsWhoIsFasterAndNobodyElse) {
    const std::array cameras{round_camera()};
    const auto limit = [&](double max_mps, const plant::Marker& marker, const Segment& segment) {
        return limit_to_read_mps(type_of(max_mps), cameras, marker, segment);
    };
    ASSERT_TRUE(limit(3, code_at(1, 0), straight(2)));
    EXPECT_NEAR(*limit(3, code_at(1, 0), straight(2)), 1.732051, 1e-6);
    EXPECT_FALSE(limit(1.7, code_at(1, 0), straight(2)));
    EXPECT_FALSE(limit(3, code_at(1, 0.06), straight(2))) << "it does not pass it";
    Segment turn;
    turn.kind = Segment::Kind::kRotate;
    turn.turn_rad = 1;
    turn.end = {0, 0, 1};
    EXPECT_FALSE(limit(3, code_at(0, 0), turn)) << "speed limits do not count there";
}

/// The foot goes round on the outside: 1 m ahead of the middle of a body that drives a circle of 1
/// m, it is faster by the root of 2.
TEST(ReadingSpeed, CountsTheCamerasWayAndNotTheBodys) {
    Segment arc;
    arc.kind = Segment::Kind::kArc;
    arc.centre = {0, 1};
    arc.turn_rad = 1.5;
    arc.length_m = 1.5;
    arc.end = {std::sin(1.5), 1 - std::cos(1.5), 1.5};
    const std::array cameras{round_camera(1)};
    const geometry::Pose2 half{std::sin(0.75), 1 - std::cos(0.75), 0.75};
    const auto under = half * geometry::Point2{1, 0};
    const auto code = code_at(under.x_m, under.y_m);
    const auto limit_mps = limit_to_read_mps(type_of(3), cameras, code, arc);
    ASSERT_TRUE(limit_mps);
    EXPECT_NEAR(*limit_mps, 1.732051 / std::sqrt(2), 1e-4);
    auto slow_turner = type_of(3);
    slow_turner.max_turn_rate_radps = 1;  // 1 m/s on that circle
    EXPECT_FALSE(limit_to_read_mps(slow_turner, cameras, code, arc));
}

TEST(ReadingSpeed, IsThatOfTheCameraThatReadsBest) {
    auto fast = round_camera(-1);
    fast.frame_rate_hz = 30;
    const std::array both{round_camera(), fast};
    const auto type = type_of(4);
    EXPECT_NEAR(*limit_to_read_mps(type, both, code_at(0.5, 0), straight(2)), 1.5 * 1.732051, 1e-6);
    EXPECT_NEAR(*limit_to_read_mps(type, both, code_at(1.8, 0), straight(2)), 1.732051, 1e-6)
        << "the other one does not come there";
    fast.frame_rate_hz = 60;
    const std::array fine{round_camera(), fast};
    EXPECT_FALSE(limit_to_read_mps(type, fine, code_at(0.5, 0), straight(2)));
}

}  // namespace
}  // namespace pulseline::localisation
