#include "core/vision/optics/optics.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/vision/qr/qr_reader.hpp"

namespace pulseline::vision {
namespace {

TEST(Optics, UndistortionIsTheInverseOfDistortion) {
    std::mt19937_64 random{3};
    std::uniform_real_distribution<double> u(-640, 640), v(-512, 512), k1(-0.12, 0.06);
    for (int i = 0; i < 1000; ++i) {
        plant::Camera camera;
        camera.k1 = k1(random);
        const Pixel ideal{u(random), v(random)};
        const Pixel back = undistorted(camera, distorted(camera, ideal));
        EXPECT_NEAR(back.u, ideal.u, 1e-8);
        EXPECT_NEAR(back.v, ideal.v, 1e-8);
    }
}

TEST(Optics, ReferenceCameraSees0137MillimetresPerPixel) {
    EXPECT_NEAR(1 / pixels_per_metre(plant::Camera{}), 0.13714e-3, 1e-8);
}

TEST(BodyFromCode, PlusUIsForwardAndPlusVIsToTheRight) {
    plant::Camera camera;
    camera.body_from_camera = {5.346, 0, 0};
    QrReading reading;
    reading.x_m = 0.010;
    reading.y_m = 0.004;
    reading.angle_rad = radians(10);  // clockwise from upright

    const geometry::Pose2 code = body_from_marker(reading, camera);

    EXPECT_NEAR(code.x_m, 5.356, 1e-12);
    EXPECT_NEAR(code.y_m, -0.004, 1e-12);
    EXPECT_NEAR(degrees(code.heading_rad), 80, 1e-9);
}

TEST(BodyFromCode, TurnsWithTheMounting) {
    plant::Camera camera;
    camera.body_from_camera = {-5, 1, kPi / 2};  // +u looks to the left
    QrReading reading;
    reading.x_m = 0.010;

    const geometry::Pose2 code = body_from_marker(reading, camera);

    EXPECT_NEAR(code.x_m, -5, 1e-12);
    EXPECT_NEAR(code.y_m, 1.010, 1e-12);
    EXPECT_NEAR(std::abs(degrees(code.heading_rad)), 180, 1e-9);
}

}  // namespace
}  // namespace pulseline::vision
