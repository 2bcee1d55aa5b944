#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/plant/plant.hpp"
#include "core/vision/placement.hpp"

namespace pulseline::vision {

/// Where three finder patterns of a code of known size could be, best first; never mirrored.
/// Method: correlation with a finder averaged over all rotations, then triples of peaks with two
/// equal legs of 14 modules at a right angle; after them, for codes with a spoilt finder, pairs of
/// peaks with the third corner where it must be. `small`: the image shrunk to 1/`shrink`.
std::vector<Placement> search_finders(const cv::Mat& small, const plant::Camera& camera,
                                      double expected_module_px, int shrink);

}  // namespace pulseline::vision
