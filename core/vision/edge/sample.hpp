#pragma once

#include <opencv2/core/mat.hpp>

#include "core/vision/optics/optics.hpp"

namespace pulseline::vision {

inline bool sampleable(const cv::Mat& grey, Pixel p) {
    return p.u >= 0 && p.v >= 0 && p.u < grey.cols - 1 && p.v < grey.rows - 1;
}

/// Bilinear grey level. REQUIRES: sampleable(grey, p), 8-bit image.
inline float sample(const cv::Mat& grey, Pixel p) {
    const int u = static_cast<int>(p.u);
    const int v = static_cast<int>(p.v);
    const auto fu = static_cast<float>(p.u - u);
    const auto fv = static_cast<float>(p.v - v);
    const std::uint8_t* row = grey.ptr<std::uint8_t>(v) + u;
    const std::uint8_t* below = row + grey.step;
    const float top = static_cast<float>(row[0]) + fu * static_cast<float>(row[1] - row[0]);
    const float low = static_cast<float>(below[0]) + fu * static_cast<float>(below[1] - below[0]);
    return top + fv * (low - top);
}

}  // namespace pulseline::vision
