#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/plant/plant.hpp"
#include "core/vision/placement.hpp"

namespace pulseline::vision {

/// Where three finder patterns of a code of known size could be, best first; never mirrored.
/// Method: correlation of the image, shrunk to 1/`shrink`, with a finder averaged over all
/// rotations, then triples of peaks with two equal legs of 14 modules at a right angle. It needs no
/// intact scan line, so dirt on a finder does not hide it. REQUIRES: shrink is a power of two.
std::vector<Placement> search_finders(const cv::Mat& grey, const plant::Camera& camera,
                                      double expected_module_px, int shrink);

}  // namespace pulseline::vision
