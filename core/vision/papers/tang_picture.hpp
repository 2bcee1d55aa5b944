#pragma once

#include <opencv2/core/mat.hpp>

#include "core/vision/papers/tang_corners.hpp"

namespace pulseline::vision {

/// Fig. 9 e of Tang 2020: the picture with the image's axes from its centre, x forwards and y to
/// the left as the camera is mounted, and the corners that were found, in colour. `grey` is what
/// `steps` were made of.
cv::Mat tang_picture(const cv::Mat& grey, const TangSteps& steps, const plant::Camera& camera);

}  // namespace pulseline::vision
