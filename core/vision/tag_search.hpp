#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/plant/plant.hpp"
#include "core/vision/placement.hpp"

namespace pulseline::vision {

/// Where the black border square of a tag of known size could be, best first, in one of its four
/// turns; unit: cells. Method: directions in which most borders run; the image turned so that they
/// run upright; there the difference between the white margin and the black border by box sums.
/// It needs no closed outline: dirt, tape and glare take a share of the sums, not the tag.
/// `small`: the image shrunk to 1/`shrink`.
std::vector<Placement> search_tags(const cv::Mat& small, const plant::Camera& camera,
                                   double expected_cell_px, int shrink);

}  // namespace pulseline::vision
