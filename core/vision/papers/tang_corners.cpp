#include "core/vision/papers/tang_corners.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace pulseline::vision {

std::optional<PaperPlace> tang_corners(const cv::Mat& grey, const plant::Camera& camera,
                                       double size_m) {
    cv::Mat smooth;
    cv::GaussianBlur(grey, smooth, {}, 2);
    cv::Mat edges;
    cv::Canny(smooth, edges, 30, 90);
    // Modules are joined to one blob whose outline is the code's.
    const double side_px = size_m * pixels_per_metre(camera);
    const int gap = static_cast<int>(side_px / 21) | 1;
    cv::Mat blobs;
    cv::morphologyEx(edges, blobs, cv::MORPH_CLOSE, cv::Mat::ones(gap, gap, CV_8U));
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(blobs, outlines, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
    std::optional<PaperPlace> best;
    double best_error = 0.15;  // of the side
    for (const auto& outline : outlines) {
        const cv::RotatedRect box = cv::minAreaRect(outline);
        const double error =
            std::max(std::abs(box.size.width - side_px), std::abs(box.size.height - side_px)) /
            side_px;
        if (error >= best_error) continue;
        best_error = error;
        std::array<cv::Point2f, 4> corners;
        box.points(corners.data());
        Pixel sum;
        for (const cv::Point2f& p : corners)
            sum = sum + Pixel{static_cast<double>(p.x), static_cast<double>(p.y)};
        best = PaperPlace{0.25 * sum, radians(static_cast<double>(box.angle))};
    }
    return best;
}

}  // namespace pulseline::vision
