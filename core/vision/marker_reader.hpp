#pragma once

#include <opencv2/core/mat.hpp>

#include <optional>
#include <vector>

#include "core/vision/marker_reading.hpp"

namespace pulseline::vision {

/// The reader of a kind: every kind is read through this one door.
ReadResult read_marker(plant::MarkerKind kind, const cv::Mat& grey, const plant::Camera& camera,
                       const ReaderOptions& options = {});

/// All markers of a kind in one image.
struct MarkersFound {
    std::vector<MarkerReading> readings;
    std::optional<Error> refusal;  // why there is none
    double first_ms = 0;           // time the first reading, or the refusal, took
};
MarkersFound read_markers(plant::MarkerKind kind, const cv::Mat& grey, const plant::Camera& camera,
                          const ReaderOptions& options = {});

}  // namespace pulseline::vision
