#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/plant/plant.hpp"
#include "core/vision/edge/edge_fit.hpp"

namespace pulseline::vision {

/// The ring of a landmark as read.
struct RingCode {
    enum class State {
        kRead,
        kNoRing,     // no landmark here, or codes 0 and 255
        kAmbiguous,  // a sector is hidden by dirt or glare: the code has no checksum, so no guess
    };
    State state = State::kNoRing;
    int code = 0;
};

/// Reads the eight sectors of a landmark whose dots are placed; unit: metres of a landmark of the
/// usual size.
RingCode read_ring(const cv::Mat& grey, const plant::Camera& camera, const Placement& placement);

/// Borders of the five dots, which every landmark has.
const std::vector<EdgeSite>& dot_borders();
/// Borders of the dots and of the ring of a code.
std::vector<EdgeSite> landmark_borders(int code);

}  // namespace pulseline::vision
