#pragma once

#include <vector>

#include "core/plant/plant.hpp"
#include "core/vision/search/search_image.hpp"

namespace pulseline::vision {

/// Where the black border square of a tag of known size could be, best first, in one of its four
/// turns; unit: cells. Method: directions in which most borders run; the image turned so that they
/// run upright; there the difference between the white margin and the black border by box sums.
/// It needs no closed outline: dirt, tape and glare take a share of the sums, not the tag. In a
/// window the direction is known, and less has to be left of the frame.
std::vector<Placement> search_tags(const SearchImage& image, const plant::Camera& camera,
                                   double expected_cell_px);

}  // namespace pulseline::vision
