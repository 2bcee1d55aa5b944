#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/plant/plant.hpp"
#include "core/vision/optics/optics.hpp"

namespace pulseline::vision {

/// Place without payload, as the papers' pipelines give it: px in the image as given.
struct PaperPlace {
    Pixel centre;
    double angle_rad = 0;  // from +u to +v; of a square only modulo a quarter turn
};

/// What the pipeline of Tang 2020 (section 3.2) makes of an image, step by step (Fig. 9).
struct TangSteps {
    cv::Mat smooth;  // grey, behind the Gaussian filter (eq. 15; b and c)
    cv::Mat edges;   // of Canny, 0 and 255 (d)
    std::optional<std::array<Pixel, 4>> corners;  // of the code, px in the image as given (e)
    double angle_rad = 0;                         // of the rectangle they make
};

/// `grey` may be smaller than the camera's own image; the filter is then as much smaller.
TangSteps tang_steps(const cv::Mat& grey, const plant::Camera& camera, double size_m);

/// The mean of the four corners (eq. 16). Kept for comparison: one speck on the outline moves it by
/// many pixels without a warning.
std::optional<PaperPlace> tang_corners(const cv::Mat& grey, const plant::Camera& camera,
                                       double size_m);

}  // namespace pulseline::vision
