#include "core/vision/landmark/landmark_reader.hpp"

#include <optional>

#include "core/plant/marker_geometry.hpp"
#include "core/vision/landmark/landmark_code.hpp"
#include "core/vision/landmark/landmark_search.hpp"
#include "core/vision/search/search_image.hpp"

namespace pulseline::vision {
namespace {

namespace landmark = plant::landmark;

constexpr double kDotWidth_m = 2 * landmark::kDot_m;

}  // namespace

ReadResult read_landmark(const cv::Mat& grey, const plant::Camera& camera,
                         const ReaderOptions& options) {
    if (!is_image_of(grey, camera)) return refuse("bad_image");
    const double outer_m = size_m(plant::MarkerKind::kLandmark, options);
    const double units_per_m = 2 * landmark::kOuter_m / outer_m;
    const double unit_px = pixels_per_metre(camera) / units_per_m;
    const double reach_px = landmark::kOuter_m * unit_px;
    bool ambiguous = false;
    const auto try_in = [&](const SearchImage& image, double scale) -> std::optional<ReadResult> {
        for (const Placement& start : search_landmarks(image, camera, scale * unit_px)) {
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
        return std::nullopt;
    };
    const double dot_px = landmark::kDot_m * unit_px;
    if (auto found = search(grey, camera, options, dot_px, reach_px, try_in)) return *found;
    return refuse(ambiguous ? "ambiguous_code" : kNoCode);
}

}  // namespace pulseline::vision
