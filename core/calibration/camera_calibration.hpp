#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "core/base/result.hpp"
#include "core/geometry/pose2.hpp"
#include "core/plant/plant.hpp"
#include "core/vision/optics/optics.hpp"

/// Calibration of a downward camera: the lens from pictures of a chessboard held at several tilts,
/// the mounting from known points on the floor. Never the data sheet's numbers (Tang, eq. 14:
/// they are 4 to 14 % off).
namespace pulseline::calibration {

using geometry::Point2;
using vision::Pixel;

/// A point in the image as given and where it is on the board (x right, y down, metres).
struct BoardPoint {
    Pixel image;
    Point2 board;
};
using BoardView = std::vector<BoardPoint>;

/// Inner corners of a chessboard, sub-pixel; fails with no_chessboard.
Result<BoardView> find_chessboard(const cv::Mat& grey, int columns, int rows, double square_m);

struct Residual {
    Pixel image;
    Pixel error;  // seen minus model, px
};

struct LensCalibration {
    plant::Camera camera;  // width, height, F, principal point, k1
    double sigma_f_px = 0;
    double sigma_centre_px = 0;
    double sigma_k1 = 0;
    double rms_px = 0;
    std::vector<Residual> residuals;
};
/// Fails with too_few_views {views, least} and ill_conditioned {sigma_f_px, sigma_centre_px,
/// sigma_k1}: a board always level tells nothing about F.
Result<LensCalibration> calibrate_lens(std::span<const BoardView> views, int width_px,
                                       int height_px);

/// A point in the image and where it lies on the floor, body frame.
struct FloorPoint {
    Pixel image;
    Point2 body;
};

struct MountingCalibration {
    plant::Camera camera;  // height, tilt, foot (body_from_camera); the lens as given
    double sigma_foot_m = 0;
    double sigma_heading_rad = 0;
    double sigma_height_m = 0;
    double sigma_tilt_rad = 0;
    double rms_px = 0;
    std::vector<Residual> residuals;
};
/// Pose of a camera with a known lens over the floor, by Gauss-Newton in six parameters. `start`
/// gives the lens and a mounting good to about 10 cm and 20 deg. Done once unloaded and once
/// loaded: the foot and the height differ. Fails with too_few_points and ill_conditioned
/// {sigma_tilt_rad, sigma_height_m}.
Result<MountingCalibration> calibrate_mounting(const plant::Camera& start,
                                               std::span<const FloorPoint> points);

/// The image size with an arrow for each residual, `magnify` times as long; 8-bit BGR.
cv::Mat residual_picture(const plant::Camera& camera, std::span<const Residual> residuals,
                         double magnify);

}  // namespace pulseline::calibration
