#include "core/vision/search/search_image.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace pulseline::vision {
namespace {

int shrink_for(double feature_px) {
    constexpr double kLeast_px = 2.5;  // of a feature in the shrunk image
    int shrink = 1;
    while (shrink < 8 && feature_px >= 2 * kLeast_px * shrink) shrink *= 2;
    return shrink;
}

cv::Mat shrunk(const cv::Mat& grey, int shrink) {
    cv::Mat small = grey;  // halved step by step: OpenCV vectorises only that
    for (int step = shrink; step > 1; step /= 2) {
        cv::Mat half;
        const cv::Size size(std::max(1, small.cols / 2), std::max(1, small.rows / 2));
        cv::resize(small, half, size, 0, 0, cv::INTER_AREA);
        small = half;
    }
    return small;
}

/// The part of the image within `reach_px` of the window's centre, in whole shrunk pixels.
cv::Rect part_around(const SearchWindow& window, const plant::Camera& camera, const cv::Mat& grey,
                     double reach_px, int shrink) {
    const Pixel middle = distorted(camera, window.centre);
    const auto in_whole = [&](double at, int size) {
        // Expected too far away for numbers, it is none: then 0.
        const double inside = at > 0 ? std::min(at, static_cast<double>(size)) : 0;
        return static_cast<int>(inside) / shrink * shrink;
    };
    const int left = in_whole(middle.u - reach_px, grey.cols);
    const int top = in_whole(middle.v - reach_px, grey.rows);
    return {left, top, in_whole(middle.u + reach_px + shrink, grey.cols) - left,
            in_whole(middle.v + reach_px + shrink, grey.rows) - top};
}

}  // namespace

bool SearchWindow::holds(const Placement& placement) const {
    const Pixel off = placement.centre - centre;
    return std::hypot(off.u, off.v) <= reach_px &&
           std::abs(wrap(placement.angle_rad - angle_rad)) <= reach_rad;
}

std::optional<SearchWindow> window_of(const ReaderOptions& options, const plant::Camera& camera) {
    if (!options.expected) return std::nullopt;
    const auto& expected = *options.expected;
    const auto in_camera = inverse(camera.body_from_camera) * expected.body_from_marker;
    // A print upright in the image has its "up" along -v, a quarter turn to the left of +u.
    return SearchWindow{ideal_pixel(camera, in_camera.position()), kPi / 2 - in_camera.heading_rad,
                        expected.reach_m * pixels_per_metre(camera), expected.reach_rad};
}

SearchImage::SearchImage(const cv::Mat& grey, const plant::Camera& camera, double feature_px,
                         double reach_px, std::optional<SearchWindow> around)
    : shrink(shrink_for(feature_px)), window(around) {
    if (!window) {
        small = shrunk(grey, shrink);
        return;
    }
    const auto part = part_around(*window, camera, grey, reach_px + window->reach_px, shrink);
    if (part.empty()) return;  // expected out of sight
    from = part.tl();
    small = shrunk(grey(part), shrink);
}

}  // namespace pulseline::vision
