#pragma once

#include <opencv2/core/mat.hpp>

#include "core/vision/marker_reading.hpp"

namespace pulseline::vision {

/// Finds, decodes and places a circular landmark (Li 2020) in an 8-bit grey image of `camera`. The
/// payload is its number. A mirrored landmark cannot be told from another one: the dots are
/// symmetric and the code has no checksum; only the survey can refuse its number.
ReadResult read_landmark(const cv::Mat& grey, const plant::Camera& camera,
                         const ReaderOptions& options = {});

}  // namespace pulseline::vision
