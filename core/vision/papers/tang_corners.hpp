#pragma once

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

/// The pipeline of Tang 2020 (section 3.2): grey image, Gaussian filter (eq. 15), Canny, the
/// outline as a rectangle, mean of its four corners (eq. 16). Kept for comparison: one speck on the
/// outline moves it by many pixels without a warning.
std::optional<PaperPlace> tang_corners(const cv::Mat& grey, const plant::Camera& camera,
                                       double size_m);

}  // namespace pulseline::vision
