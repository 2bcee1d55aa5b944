#pragma once

#include <opencv2/core/mat.hpp>

#include "core/vision/marker_reading.hpp"

namespace pulseline::vision {

/// Finds, decodes and places an AprilTag 36h11 in an 8-bit grey image of `camera`. The payload is
/// its number.
ReadResult read_apriltag(const cv::Mat& grey, const plant::Camera& camera,
                         const ReaderOptions& options = {});

}  // namespace pulseline::vision
