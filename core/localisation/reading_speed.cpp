#include "core/localisation/reading_speed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/kinematics/primitives.hpp"
#include "core/localisation/codes_on_way.hpp"

namespace pulseline::localisation {
namespace {

/// How much faster than the body the camera's foot moves there.
double foot_ratio(const kinematics::Twist& along, geometry::Point2 foot) {
    return std::hypot(along.vx_mps - along.turn_radps * foot.y_m,
                      along.vy_mps + along.turn_radps * foot.x_m);
}

/// As fast as the type drives there, its turning included.
double top_mps(const plant::VehicleType& type, const kinematics::Twist& along) {
    const double turn_radpm = std::abs(along.turn_radps);
    return turn_radpm > 0 ? std::min(type.max_speed_mps, type.max_turn_rate_radps / turn_radpm)
                          : type.max_speed_mps;
}

}  // namespace

double reading_speed_mps(const plant::Camera& camera, double size_m) {
    const double radius_m = view_radius_m(camera, size_m);
    if (radius_m <= 0) return 0;
    const double by_frames_mps = std::numbers::sqrt3 * radius_m * camera.frame_rate_hz;
    const double by_smear_mps = kMostSmear_px * camera.height_m / (camera.f_px * camera.exposure_s);
    return std::min(by_frames_mps, by_smear_mps);
}

std::optional<double> limit_to_read_mps(const plant::VehicleType& type,
                                        std::span<const plant::Camera> cameras,
                                        const plant::Marker& marker,
                                        const kinematics::Segment& segment) {
    if (segment.kind == kinematics::Segment::Kind::kRotate) return std::nullopt;
    std::optional<double> best_mps;
    for (const plant::Camera& camera : cameras) {
        const double foot_mps = reading_speed_mps(camera, marker.size_m);
        double limit_mps = std::numeric_limits<double>::infinity();
        bool faster = false;
        const auto shares = seen_at(marker, std::span(&camera, 1), segment);
        if (shares.empty()) continue;
        for (const double share : shares) {
            const auto along = kinematics::twist_along(segment, share);
            const double body_mps =
                foot_mps / std::max(foot_ratio(along, camera.body_from_camera.position()), 1e-9);
            limit_mps = std::min(limit_mps, body_mps);
            faster |= body_mps < top_mps(type, along);
        }
        if (!faster) return std::nullopt;
        best_mps = std::max(best_mps.value_or(0), limit_mps);
    }
    return best_mps;
}

}  // namespace pulseline::localisation
