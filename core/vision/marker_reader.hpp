#pragma once

#include <opencv2/core/mat.hpp>

#include <vector>

#include "core/vision/marker_reading.hpp"

namespace pulseline::vision {

/// The reader of a kind: every kind is read through this one door.
ReadResult read_marker(plant::MarkerKind kind, const cv::Mat& grey, const plant::Camera& camera,
                       const ReaderOptions& options = {});

/// The other markers of the same kind in an image in which `first` was read.
std::vector<MarkerReading> read_others(const MarkerReading& first, const cv::Mat& grey,
                                       const plant::Camera& camera,
                                       const ReaderOptions& options = {});

}  // namespace pulseline::vision
