#include "core/calibration/camera_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

namespace pulseline::calibration {
namespace {

plant::Camera true_camera() {
    plant::Camera camera;
    camera.f_px = 3290;
    camera.cu_px = 645;
    camera.cv_px = 508;
    camera.k1 = -0.08;
    return camera;
}

/// Corners of a 9 x 7 board of 12 mm squares, turned out of the level by two angles.
BoardView seen_board(const plant::Camera& camera, double turn_x, double turn_y,
                     std::mt19937_64& random) {
    std::normal_distribution<double> noise(0, 0.03);
    BoardView view;
    for (int row = 0; row < 7; ++row) {
        for (int column = 0; column < 9; ++column) {
            const Point2 board{0.012 * column, 0.012 * row};
            const double x = board.x_m - 0.048;
            const double y = board.y_m - 0.036;
            // Turned about x, then about y.
            const double y1 = y * std::cos(turn_x);
            const double z1 = y * std::sin(turn_x);
            const double x2 = x * std::cos(turn_y) + z1 * std::sin(turn_y);
            const double z = 0.455 - x * std::sin(turn_y) + z1 * std::cos(turn_y);
            const Pixel ideal{camera.f_px * x2 / z, camera.f_px * y1 / z};
            Pixel image = vision::distorted(camera, ideal);
            view.push_back({{image.u + noise(random), image.v + noise(random)}, board});
        }
    }
    return view;
}

TEST(CalibrateLens, FindsTheLensFromTiltedBoards) {
    std::mt19937_64 random{3};
    std::vector<BoardView> views;
    for (int i = 0; i < 12; ++i)
        views.push_back(seen_board(true_camera(), 0.4 * std::cos(i), 0.4 * std::sin(i), random));
    const auto lens = calibrate_lens(views, 1280, 1024);
    ASSERT_TRUE(lens) << lens.error().what;
    EXPECT_NEAR(lens->camera.f_px, true_camera().f_px, 4 * lens->sigma_f_px);
    EXPECT_NEAR(lens->camera.cu_px, true_camera().cu_px, 4 * lens->sigma_centre_px);
    EXPECT_NEAR(lens->camera.cv_px, true_camera().cv_px, 4 * lens->sigma_centre_px);
    EXPECT_NEAR(lens->camera.k1, true_camera().k1, 4 * lens->sigma_k1);
    EXPECT_NEAR(lens->rms_px, 0.03 * std::sqrt(2.0), 0.005);
    EXPECT_EQ(residual_picture(lens->camera, lens->residuals, 200).size(), cv::Size(1280, 1024));
}

TEST(CalibrateLens, ALevelBoardIsRefusedForItTellsNothingAboutTheFocalLength) {
    std::mt19937_64 random{3};
    std::vector<BoardView> views;
    for (int i = 0; i < 8; ++i) views.push_back(seen_board(true_camera(), 0, 0, random));
    const auto lens = calibrate_lens(views, 1280, 1024);
    ASSERT_FALSE(lens);
    EXPECT_EQ(lens.error().reason.code, "ill_conditioned");
    EXPECT_EQ(calibrate_lens({}, 1280, 1024).error().reason.code, "too_few_views");
}

TEST(CalibrateMounting, FindsFootHeightAndTilt) {
    std::mt19937_64 random{8};
    std::normal_distribution<double> noise(0, 0.02);
    plant::Camera truth = true_camera();
    truth.body_from_camera = {5.346, -0.012, radians(1.3)};
    truth.height_m = 0.4512;
    truth.tilt_u_rad = radians(0.4);
    truth.tilt_v_rad = radians(-0.7);
    std::vector<FloorPoint> points;
    for (double x = -0.06; x <= 0.061; x += 0.012) {
        for (double y = -0.048; y <= 0.049; y += 0.012) {
            const Point2 body = truth.body_from_camera * Point2{x, y};
            const Pixel p = vision::distorted(
                truth, vision::ideal_pixel(truth, inverse(truth.body_from_camera) * body));
            points.push_back({{p.u + noise(random), p.v + noise(random)}, body});
        }
    }
    plant::Camera start = true_camera();
    start.body_from_camera = {5.3, 0.02, 0};

    const auto mounting = calibrate_mounting(start, points);

    ASSERT_TRUE(mounting) << mounting.error().what;
    const plant::Camera& c = mounting->camera;
    EXPECT_NEAR(c.height_m, truth.height_m, 4 * mounting->sigma_height_m);
    EXPECT_NEAR(c.tilt_u_rad, truth.tilt_u_rad, 4 * mounting->sigma_tilt_rad);
    EXPECT_NEAR(c.tilt_v_rad, truth.tilt_v_rad, 4 * mounting->sigma_tilt_rad);
    EXPECT_NEAR(c.body_from_camera.x_m, truth.body_from_camera.x_m, 4 * mounting->sigma_foot_m);
    EXPECT_NEAR(c.body_from_camera.y_m, truth.body_from_camera.y_m, 4 * mounting->sigma_foot_m);
    EXPECT_LT(mounting->sigma_tilt_rad, radians(0.01));
    EXPECT_NEAR(mounting->rms_px, 0.02 * std::sqrt(2.0), 0.005);
}

TEST(CalibrateMounting, PointsInOneCornerAreRefused) {
    const plant::Camera camera = true_camera();
    std::mt19937_64 random{8};
    std::normal_distribution<double> noise(0, 0.05);
    std::vector<FloorPoint> points;
    for (int i = 0; i < 8; ++i) {
        const Point2 body{0.05 + 0.002 * (i % 3), 0.04 + 0.002 * (i / 3)};
        const Pixel p = vision::distorted(camera, vision::ideal_pixel(camera, body));
        points.push_back({{p.u + noise(random), p.v + noise(random)}, body});
    }
    const auto mounting = calibrate_mounting(camera, points);
    ASSERT_FALSE(mounting);
    EXPECT_EQ(mounting.error().reason.code, "ill_conditioned");
}

TEST(FindChessboard, FindsItsCornersToATwentiethOfAPixel) {
    cv::Mat large(4 * 1024, 4 * 1280, CV_8U, cv::Scalar(220));
    constexpr int kSquare = 4 * 90;
    for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 10; ++column)
            if ((row + column) % 2 == 0)
                cv::rectangle(
                    large,
                    cv::Rect(4 * 150 + column * kSquare, 4 * 130 + row * kSquare, kSquare, kSquare),
                    cv::Scalar(20), -1);
    cv::Mat image;
    cv::resize(large, image, {1280, 1024}, 0, 0, cv::INTER_AREA);
    const auto view = find_chessboard(image, 9, 7, 0.012);
    ASSERT_TRUE(view);
    ASSERT_EQ(view->size(), 63U);
    for (const BoardPoint& p : *view) {
        const double u = (p.image.u - (150 + 90 - 0.5)) / 90;
        const double v = (p.image.v - (130 + 90 - 0.5)) / 90;
        EXPECT_NEAR(u, std::round(u), 0.05 / 90);
        EXPECT_NEAR(v, std::round(v), 0.05 / 90);
    }
    EXPECT_FALSE(find_chessboard(cv::Mat(1024, 1280, CV_8U, cv::Scalar(99)), 9, 7, 0.012));
}

}  // namespace
}  // namespace pulseline::calibration
