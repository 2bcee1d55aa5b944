#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/plant/plant.hpp"
#include "core/vision/edge_fit.hpp"

namespace pulseline::vision {

/// Where three finder patterns of a code of known size could be, best first: for codes whose
/// finders are too dirty for the decoder's line scans. Method: correlation of the quarter-size
/// image with a finder averaged over all rotations, then triples of peaks with two equal legs of
/// 14 modules at a right angle.
std::vector<CodePlacement> search_finders(const cv::Mat& grey, const plant::Camera& camera,
                                          double expected_module_px);

}  // namespace pulseline::vision
