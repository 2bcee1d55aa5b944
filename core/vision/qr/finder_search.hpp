#pragma once

#include <vector>

#include "core/plant/plant.hpp"
#include "core/vision/search/search_image.hpp"

namespace pulseline::vision {

/// Where three finder patterns of a code of known size could be, best first; never mirrored.
/// Method: correlation with a finder averaged over all rotations, then triples of peaks with two
/// equal legs of 14 modules at a right angle; after them, for codes with a spoilt finder, pairs of
/// peaks with the third corner where it must be. In a window a single finder suffices, too: each
/// peak as each of the three, turned by half degrees.
std::vector<Placement> search_finders(const SearchImage& image, const plant::Camera& camera,
                                      double expected_module_px);

}  // namespace pulseline::vision
