#include "core/simulation/world/floor_camera.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace pulseline::simulation {
namespace {

ImageConditions ideal() {
    ImageConditions c;
    c.blur_sigma_px = 0;
    c.read_noise = 0;
    c.shot_noise = 0;
    c.exposure = 1;
    return c;
}

TEST(FloorProjection, GoesThereAndBackWithTiltAndDistortion) {
    plant::Camera camera;
    camera.k1 = -0.12;
    ImageConditions conditions;
    conditions.tilt_u_rad = radians(0.3);
    conditions.tilt_v_rad = radians(-0.2);
    conditions.height_error_m = 0.003;
    const FloorProjection projection(camera, conditions);
    for (double u = 0; u < 1280; u += 97) {
        for (double v = 0; v < 1024; v += 83) {
            const vision::Pixel back =
                projection.image_from_floor(projection.floor_from_image({u, v}));
            EXPECT_NEAR(back.u, u, 1e-7);
            EXPECT_NEAR(back.v, v, 1e-7);
        }
    }
}

TEST(FloorProjection, TiltMovesTheFootByHeightTimesTangent) {
    ImageConditions conditions;
    conditions.tilt_u_rad = radians(0.05);
    const plant::Camera camera;
    const auto foot =
        FloorProjection(camera, conditions).floor_from_image({camera.cu_px, camera.cv_px});
    EXPECT_NEAR(foot.x_m, 0.397e-3, 1e-6);  // core/localisation/README.md: 0.05 deg = 0.40 mm
    EXPECT_NEAR(foot.y_m, 0, 1e-9);
}

/// Upright code moved along +u by known parts of a pixel: the pixel on its left outline must be the
/// mean of paper and ink by area.
TEST(RenderFloor, EdgePixelsAreTheMeanByArea) {
    const plant::Camera camera;
    const double px_m = 1 / vision::pixels_per_metre(camera);
    const int edge_u = 400;
    for (double part = 0.05; part < 1; part += 0.1) {
        // Ink begins `part` of a pixel right of the left border of pixel edge_u.
        const double edge_m = (edge_u - 0.5 + part - camera.cu_px) * px_m;
        const std::vector<FloorCode> codes{{"ST01-F", {edge_m + 0.030, 0, kPi / 2}}};
        const cv::Mat image = render_floor(camera, {}, codes, ideal());
        const int v =
            static_cast<int>(camera.cv_px - 0.027 / px_m);  // inside the upper left finder
        const double paper = image.at<std::uint8_t>(v, edge_u - 5);
        const double ink = image.at<std::uint8_t>(v, edge_u + 5);
        EXPECT_GT(paper, 200);
        EXPECT_LT(ink, 30);
        EXPECT_NEAR(image.at<std::uint8_t>(v, edge_u), part * paper + (1 - part) * ink, 1.5)
            << part;
    }
}

TEST(RenderFloor, SameSeedSameImageOtherSeedOtherNoise) {
    std::mt19937_64 random{8};
    ImageConditions conditions = ImageConditions::nominal(random);
    const std::vector<FloorCode> codes{{"ST01-F", {0.01, 0, 0.3}}};
    const plant::Camera camera;
    const cv::Mat a = render_floor(camera, {}, codes, conditions);
    const cv::Mat b = render_floor(camera, {}, codes, conditions);
    conditions.seed += 1;
    const cv::Mat c = render_floor(camera, {}, codes, conditions);
    EXPECT_EQ(cv::norm(a, b, cv::NORM_L1), 0);
    EXPECT_GT(cv::norm(a, c, cv::NORM_L1), 1e5);
}

TEST(RenderFloor, NoiseHasTheGivenVariance) {
    ImageConditions conditions = ideal();
    conditions.read_noise = 2;
    conditions.shot_noise = 0.04;
    const plant::Camera camera;
    const std::vector<FloorCode> codes{{"ST01-F", {0, 0, 0}}};
    const cv::Mat clean = render_floor(camera, {}, codes, ideal());
    const cv::Mat noisy = render_floor(camera, {}, codes, conditions);
    double squares = 0;
    double expected = 0;
    for (int v = 0; v < clean.rows; ++v) {
        for (int u = 0; u < clean.cols; ++u) {
            const double level = clean.at<std::uint8_t>(v, u);
            const double d = noisy.at<std::uint8_t>(v, u) - level;
            squares += d * d;
            expected += 4 + 0.04 * level + 1.0 / 6;  // both are rounded
        }
    }
    EXPECT_NEAR(squares / expected, 1, 0.03);
}

}  // namespace
}  // namespace pulseline::simulation
