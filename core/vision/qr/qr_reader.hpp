#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "core/vision/marker_reading.hpp"

namespace pulseline::vision {

using QrReading = MarkerReading;
using QrReaderOptions = ReaderOptions;

/// Finds, decodes and places a QR code (version 1) in an 8-bit grey image of `camera`. Whether the
/// payload is the expected one is the caller's business.
ReadResult read_qr(const cv::Mat& grey, const plant::Camera& camera,
                   const ReaderOptions& options = {});

}  // namespace pulseline::vision
