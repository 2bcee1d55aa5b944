#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <utility>

#include "core/vision/marker_reading.hpp"
#include "core/vision/optics/placement.hpp"

namespace pulseline::vision {

/// Where odometry expects a marker, in ideal pixels.
struct SearchWindow {
    Pixel centre;
    double angle_rad = 0;  // of the print in the image
    double reach_px = 0;
    double reach_rad = 0;

    bool holds(const Placement& placement) const;
};

/// The window of the marker that `options` expect; none when they expect none.
std::optional<SearchWindow> window_of(const ReaderOptions& options, const plant::Camera& camera);

/// What a search looks at: the image, shrunk as far as its smallest feature allows, and where a
/// marker is expected only what one in the window can cover.
struct SearchImage {
    cv::Mat small;
    int shrink = 1;  // a power of two, at most 8
    cv::Point from;  // of its first pixel in the whole image
    std::optional<SearchWindow> window;

    /// `feature_px`: size of the smallest feature that the search needs; `reach_px`: of the marker
    /// from its centre, with the white that belongs to it.
    SearchImage(const cv::Mat& grey, const plant::Camera& camera, double feature_px,
                double reach_px, std::optional<SearchWindow> window);

    /// Ideal pixel of a place in `small`.
    Pixel ideal(const plant::Camera& camera, double u, double v) const {
        return undistorted(camera,
                           {shrink * (u + 0.5) - 0.5 + from.x, shrink * (v + 0.5) - 0.5 + from.y});
    }
    bool wants(const Placement& placement) const { return !window || window->holds(placement); }
};

/// What `try_in(image, scale)` finds first: where the marker is expected, then anywhere, then of
/// another size than it should have, only to be able to say that the size is wrong.
template <typename TryIn>
auto search(const cv::Mat& grey, const plant::Camera& camera, const ReaderOptions& options,
            double feature_px, double reach_px, TryIn try_in)
    -> decltype(try_in(std::declval<SearchImage>(), 1.0)) {
    if (const auto window = window_of(options, camera)) {
        const SearchImage part(grey, camera, feature_px, reach_px, window);
        if (auto found = try_in(part, 1.0)) return found;
    }
    const SearchImage whole(grey, camera, feature_px, reach_px, {});
    for (const double scale : {1.0, 0.84, 1.19})
        if (auto found = try_in(whole, scale)) return found;
    return {};
}

}  // namespace pulseline::vision
