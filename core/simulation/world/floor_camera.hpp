#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "core/geometry/pose2.hpp"
#include "core/plant/plant.hpp"
#include "core/simulation/world/image_conditions.hpp"
#include "core/vision/optics/optics.hpp"

namespace pulseline::simulation {

using geometry::Pose2;

/// A marker glued to the simulated floor: its true place, heading = direction of its "up" edge.
struct FloorCode {
    std::string payload;
    Pose2 pose;
    double size_m = 0.060;
    bool mirrored = false;
    plant::MarkerKind kind = plant::MarkerKind::kQr;
};

/// The 8-bit grey image that `camera` takes at the true body pose: markers on white sheets, printed
/// edges sampled by exact pixel area, on a textured floor fixed to the hall. The same input gives
/// the same image. REQUIRES: payloads of their markers' kinds (printing::marker_cells).
cv::Mat render_floor(const plant::Camera& camera, const Pose2& hall_from_body,
                     std::span<const FloorCode> codes, const ImageConditions& conditions);

/// True projection of floor points, tilt and height error included (what `render_floor` draws).
class FloorProjection {
public:
    FloorProjection(const plant::Camera& camera, const ImageConditions& conditions);

    /// Camera floor frame (x along +u, y to the left of it) from an image point and back.
    geometry::Point2 floor_from_image(vision::Pixel image) const;
    vision::Pixel image_from_floor(geometry::Point2 floor) const;

private:
    plant::Camera camera_;
    double height_m_;
    std::array<double, 9> floor_from_ray_;  // rotation of the optical axis by the tilts
};

}  // namespace pulseline::simulation
