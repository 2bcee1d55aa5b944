#pragma once

#include <functional>
#include <vector>

#include "core/plant/plant.hpp"
#include "core/vision/optics/optics.hpp"
#include "core/vision/search/search_image.hpp"

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

/// Places that look like the pattern, best first, to about a tenth of a shrunk pixel. Method:
/// correlation of the shrunk image with taps on rings, normalised by the local deviation: needs no
/// intact outline, so dirt does not hide it. Scores reach about 1.
std::vector<RoundPeak> find_round(const SearchImage& image, const plant::Camera& camera,
                                  const RoundPattern& pattern, float least_score, std::size_t most);

}  // namespace pulseline::vision
