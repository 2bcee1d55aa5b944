#include "core/vision/landmark_reader.hpp"

#include <array>

#include "core/plant/marker_geometry.hpp"
#include "core/vision/landmark_code.hpp"
#include "core/vision/landmark_search.hpp"
#include "core/vision/round_search.hpp"

namespace pulseline::vision {
namespace {

namespace landmark = plant::landmark;

constexpr double kDotWidth_m = 2 * landmark::kDot_m;

// The usual size first, then others, only to be able to say that the size is wrong.
constexpr std::array<double, 3> kScales{1, 0.84, 1.19};

}  // namespace

ReadResult read_landmark(const cv::Mat& grey, const plant::Camera& camera,
                         const ReaderOptions& options) {
    if (!is_image_of(grey, camera)) return refuse("bad_image");
    const double outer_m = size_m(plant::MarkerKind::kLandmark, options);
    const double units_per_m = 2 * landmark::kOuter_m / outer_m;
    const double unit_px = pixels_per_metre(camera) / units_per_m;
    bool ambiguous = false;
    const int shrink = search_shrink(landmark::kDot_m * unit_px);
    const cv::Mat small = shrunk(grey, shrink);
    for (const double scale : kScales) {
        for (const Placement& start : search_landmarks(small, camera, scale * unit_px, shrink)) {
            const auto dots =
                fit_edges(grey, camera, dot_borders(), kDotWidth_m, start, FitEffort::kLocate);
            if (!dots) continue;
            const RingCode ring = read_ring(grey, camera, dots->placement);
            ambiguous |= ring.state == RingCode::State::kAmbiguous;
            if (ring.state != RingCode::State::kRead) continue;
            return accept(
                plant::MarkerKind::kLandmark, std::to_string(ring.code),
                fit_edges(grey, camera, landmark_borders(ring.code), kDotWidth_m, dots->placement),
                camera, units_per_m, options);
        }
    }
    return refuse(ambiguous ? "ambiguous_code" : "no_code");
}

}  // namespace pulseline::vision
