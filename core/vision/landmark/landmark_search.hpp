#pragma once

#include <vector>

#include "core/plant/plant.hpp"
#include "core/vision/search/search_image.hpp"

namespace pulseline::vision {

/// Where the five dots of a landmark of known size could be, best first, upright; unit: metres of a
/// landmark of the usual size. Method: correlation with a dot of that size, then constellations:
/// every pair of peaks as every pair of dots, the other three where they must be; four of five
/// suffice, in a window three, so dirt on a dot or on the ring does not hide the landmark.
std::vector<Placement> search_landmarks(const SearchImage& image, const plant::Camera& camera,
                                        double expected_px_per_m);

}  // namespace pulseline::vision
