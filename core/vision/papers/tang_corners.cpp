#include "core/vision/papers/tang_corners.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace pulseline::vision {
namespace {

constexpr double kSigma_px = 2;      // of the camera's own image, as the paper says
constexpr double kMostError = 0.15;  // of the side

}  // namespace

TangSteps tang_steps(const cv::Mat& grey, const plant::Camera& camera, double size_m) {
    const double scale = static_cast<double>(grey.cols) / camera.width_px;
    TangSteps steps;
    cv::GaussianBlur(grey, steps.smooth, {}, kSigma_px * scale);
    cv::Canny(steps.smooth, steps.edges, 30, 90);
    // Modules are joined to one blob whose outline is the code's.
    const double side_px = scale * size_m * pixels_per_metre(camera);
    const int gap = static_cast<int>(side_px / 21) | 1;
    cv::Mat blobs;
    cv::morphologyEx(steps.edges, blobs, cv::MORPH_CLOSE, cv::Mat::ones(gap, gap, CV_8U));
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(blobs, outlines, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
    double best_error = kMostError;
    for (const auto& outline : outlines) {
        const cv::RotatedRect box = cv::minAreaRect(outline);
        const double error =
            std::max(std::abs(box.size.width - side_px), std::abs(box.size.height - side_px)) /
            side_px;
        if (error >= best_error) continue;
        best_error = error;
        std::array<cv::Point2f, 4> points;
        box.points(points.data());
        steps.corners.emplace();
        std::ranges::transform(points, steps.corners->begin(), [](const cv::Point2f& p) {
            return Pixel{static_cast<double>(p.x), static_cast<double>(p.y)};
        });
        steps.angle_rad = radians(static_cast<double>(box.angle));
    }
    return steps;
}

std::optional<PaperPlace> tang_corners(const cv::Mat& grey, const plant::Camera& camera,
                                       double size_m) {
    const TangSteps steps = tang_steps(grey, camera, size_m);
    if (!steps.corners) return std::nullopt;
    Pixel sum;
    for (const Pixel& corner : *steps.corners) sum = sum + corner;
    return PaperPlace{0.25 * sum, steps.angle_rad};
}

}  // namespace pulseline::vision
