#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "core/vision/edge/edge_fit.hpp"

namespace pulseline::vision {

/// How the profiles of one round of a fit are cut.
struct ProfileShape {
    int reach_px = 4;          // to either side of the expected border
    double reference_px = 10;  // where the levels of dark and light are taken
    int every = 1;             // takes every n-th site
};

/// One printed border as the image shows it.
struct EdgeObservation {
    Pixel foot;            // expected place, ideal px about the principal point
    Pixel normal;          // from dark to light, unit length, ideal image frame
    double offset_px = 0;  // image border minus expected one, along the normal
};

struct EdgeObservations {
    std::vector<EdgeObservation> seen;
    int tried = 0;  // sites whose profiles lie in the image
};

/// Measures the borders at the sites of a marker placed about there. Sites without the contrast of
/// the rest are left out (dirt, glare).
EdgeObservations observe_edges(const cv::Mat& grey, const plant::Camera& camera,
                               std::span<const EdgeSite> sites, const Placement& placement,
                               const ProfileShape& shape);

}  // namespace pulseline::vision
