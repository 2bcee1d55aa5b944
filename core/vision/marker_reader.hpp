#pragma once

#include <opencv2/core/mat.hpp>

#include "core/vision/marker_reading.hpp"

namespace pulseline::vision {

/// The reader of a kind: every kind is read through this one door.
ReadResult read_marker(plant::MarkerKind kind, const cv::Mat& grey, const plant::Camera& camera,
                       const ReaderOptions& options = {});

}  // namespace pulseline::vision
