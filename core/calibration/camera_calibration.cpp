#include "core/calibration/camera_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace pulseline::calibration {
namespace {

constexpr std::size_t kFewestViews = 4;
// What a dual-camera fix can bear (core/localisation/README.md): scale to 0.1 %, principal point to
// 1 px.
constexpr double kMostSigmaF = 0.001;
constexpr double kMostSigmaCentre_px = 2;
constexpr double kMostSigmaK1 = 0.02;
// Boards held level leave F and distance to each other, whatever the formal deviations say.
constexpr double kTilted_rad = 0.14;  // 8 deg
constexpr std::size_t kFewestTilted = 3;

std::size_t tilted_views(const std::vector<cv::Mat>& turns) {
    return static_cast<std::size_t>(std::ranges::count_if(turns, [](const cv::Mat& turn) {
        cv::Mat rotation;
        cv::Rodrigues(turn, rotation);
        return std::abs(rotation.at<double>(2, 2)) < std::cos(kTilted_rad);
    }));
}

std::vector<Residual> lens_residuals(std::span<const BoardView> views,
                                     const std::vector<cv::Mat>& turns,
                                     const std::vector<cv::Mat>& shifts, const cv::Mat& matrix,
                                     const cv::Mat& lens) {
    std::vector<Residual> all;
    for (std::size_t i = 0; i < views.size(); ++i) {
        std::vector<cv::Point3d> board;
        for (const BoardPoint& p : views[i]) board.emplace_back(p.board.x_m, p.board.y_m, 0);
        std::vector<cv::Point2d> seen;
        cv::projectPoints(board, turns[i], shifts[i], matrix, lens, seen);
        for (std::size_t k = 0; k < seen.size(); ++k)
            all.push_back({views[i][k].image, views[i][k].image - Pixel{seen[k].x, seen[k].y}});
    }
    return all;
}

}  // namespace

Result<BoardView> find_chessboard(const cv::Mat& grey, int columns, int rows, double square_m) {
    std::vector<cv::Point2f> corners;
    const bool found =
        grey.type() == CV_8UC1 &&
        cv::findChessboardCorners(grey, {columns, rows}, corners,
                                  cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE);
    if (!found)
        return fail(Errc::kNotFound, "no_chessboard",
                    "The whole chessboard is not visible. Check its size, light and focus.");
    cv::cornerSubPix(grey, corners, {7, 7}, {-1, -1},
                     {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 40, 1e-4});
    BoardView view;
    for (int i = 0; i < static_cast<int>(corners.size()); ++i) {
        const auto& c = corners[static_cast<std::size_t>(i)];
        view.push_back({{static_cast<double>(c.x), static_cast<double>(c.y)},
                        {square_m * (i % columns), square_m * (i / columns)}});
    }
    return view;
}

Result<LensCalibration> calibrate_lens(std::span<const BoardView> views, int width_px,
                                       int height_px) {
    if (views.size() < kFewestViews)
        return fail(Errc::kInvalid, "too_few_views",
                    "Take more pictures of the chessboard, tilted to different sides.", {},
                    {{"views", static_cast<std::int64_t>(views.size())},
                     {"least", static_cast<std::int64_t>(kFewestViews)}});
    std::vector<std::vector<cv::Point3f>> board(views.size());
    std::vector<std::vector<cv::Point2f>> image(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) {
        for (const BoardPoint& p : views[i]) {
            board[i].emplace_back(static_cast<float>(p.board.x_m), static_cast<float>(p.board.y_m),
                                  0.0F);
            image[i].emplace_back(static_cast<float>(p.image.u), static_cast<float>(p.image.v));
        }
    }
    cv::Mat matrix = cv::Mat::eye(3, 3, CV_64F);
    cv::Mat lens = cv::Mat::zeros(5, 1, CV_64F);
    std::vector<cv::Mat> turns, shifts;
    cv::Mat deviation, unused_pose, unused_views;
    // Square pixels and one radial term: the camera model of core/vision/README.md.
    constexpr int kModel = cv::CALIB_FIX_ASPECT_RATIO | cv::CALIB_ZERO_TANGENT_DIST |
                           cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3;
    LensCalibration out;
    try {
        out.rms_px = cv::calibrateCamera(board, image, {width_px, height_px}, matrix, lens, turns,
                                         shifts, deviation, unused_pose, unused_views, kModel);
    } catch (const cv::Exception&) {
        return fail(Errc::kInvalid, "ill_conditioned",
                    "The pictures do not determine the lens. Tilt the board more.");
    }
    out.camera.width_px = width_px;
    out.camera.height_px = height_px;
    out.camera.f_px = matrix.at<double>(1, 1);
    out.camera.cu_px = matrix.at<double>(0, 2);
    out.camera.cv_px = matrix.at<double>(1, 2);
    out.camera.k1 = lens.at<double>(0);
    out.sigma_f_px = std::max(deviation.at<double>(0), deviation.at<double>(1));
    out.sigma_centre_px = std::max(deviation.at<double>(2), deviation.at<double>(3));
    out.sigma_k1 = deviation.at<double>(4);
    if (tilted_views(turns) < kFewestTilted || !(out.sigma_f_px < kMostSigmaF * out.camera.f_px) ||
        !(out.sigma_centre_px < kMostSigmaCentre_px) || !(out.sigma_k1 < kMostSigmaK1))
        return fail(Errc::kInvalid, "ill_conditioned",
                    "The pictures do not determine the lens. Tilt the board more and fill the "
                    "corners of the view.",
                    {},
                    {{"sigma_f_px", out.sigma_f_px},
                     {"sigma_centre_px", out.sigma_centre_px},
                     {"sigma_k1", out.sigma_k1}});
    out.residuals = lens_residuals(views, turns, shifts, matrix, lens);
    return out;
}

cv::Mat residual_picture(const plant::Camera& camera, std::span<const Residual> residuals,
                         double magnify) {
    cv::Mat picture(camera.height_px, camera.width_px, CV_8UC3, cv::Scalar(255, 255, 255));
    for (const Residual& r : residuals) {
        const Pixel end = r.image + magnify * r.error;
        cv::arrowedLine(
            picture,
            {static_cast<int>(std::lround(r.image.u)), static_cast<int>(std::lround(r.image.v))},
            {static_cast<int>(std::lround(end.u)), static_cast<int>(std::lround(end.v))},
            cv::Scalar(0xe0, 0x66, 0x1a), 1, cv::LINE_AA);
    }
    return picture;
}

}  // namespace pulseline::calibration
