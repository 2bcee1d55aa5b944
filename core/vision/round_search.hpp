#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/plant/plant.hpp"
#include "core/vision/optics.hpp"

namespace pulseline::vision {

/// What is looked for: brightness (0 dark, 1 light) over the distance from the middle, px of the
/// image as given, averaged over all rotations.
struct RoundPattern {
    double reach_px = 0;
    std::function<double(double)> light;
};

struct RoundPeak {
    Pixel ideal;  // about the principal point
    float score = 0;
};

/// How much the image may be shrunk (a power of two, at most 8) for a search of features of a size.
int search_shrink(double feature_px);

/// Image halved log2(shrink) times. REQUIRES: shrink is a power of two.
cv::Mat shrunk(const cv::Mat& grey, int shrink);

/// Places that look like the pattern, best first, to about a tenth of `shrink` pixels. Method:
/// correlation of the shrunk image with taps on rings, normalised by the local deviation: needs no
/// intact outline, so dirt does not hide it. Scores reach about 1.
std::vector<RoundPeak> find_round(const cv::Mat& small, const plant::Camera& camera,
                                  const RoundPattern& pattern, int shrink, float least_score,
                                  std::size_t most);

}  // namespace pulseline::vision
