#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/plant/plant.hpp"
#include "core/vision/placement.hpp"

namespace pulseline::vision {

/// Where the five dots of a landmark of known size could be, best first, upright; unit: metres of a
/// landmark of the usual size. Method: correlation with a dot of that size, then constellations:
/// every pair of peaks as every pair of dots, the other three where they must be; four of five
/// suffice, so dirt on a dot or on the ring does not hide the landmark. `small`: the image shrunk
/// to 1/`shrink`.
std::vector<Placement> search_landmarks(const cv::Mat& small, const plant::Camera& camera,
                                        double expected_px_per_m, int shrink);

}  // namespace pulseline::vision
