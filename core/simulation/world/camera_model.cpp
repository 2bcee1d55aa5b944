#include "core/simulation/world/camera_model.hpp"

#include <algorithm>

namespace pulseline::simulation {

std::optional<vision::MarkerReading> analytic_reading(const plant::Camera& camera,
                                                      const Pose2& hall_from_body,
                                                      std::span<const FloorCode> codes,
                                                      std::mt19937_64& random,
                                                      const ReadingErrors& errors) {
    const Pose2 camera_from_hall = inverse(hall_from_body * camera.body_from_camera);
    const FloorCode* seen = nullptr;
    Pose2 place;
    for (const FloorCode& code : codes) {
        const Pose2 camera_from_code = camera_from_hall * code.pose;
        const auto corners = vision::code_corners(camera, camera_from_code, code.size_m);
        const bool in_view = std::ranges::all_of(
            corners, [&](vision::Pixel p) { return vision::in_image(camera, p); });
        if (code.mirrored || !in_view) continue;
        if (seen != nullptr && norm(place.position()) <= norm(camera_from_code.position()))
            continue;
        seen = &code;
        place = camera_from_code;
    }
    if (seen == nullptr) return std::nullopt;

    std::normal_distribution<double> normal;
    vision::Pixel ideal = vision::ideal_pixel(camera, place.position());
    ideal.u += errors.sigma_px * normal(random);
    ideal.v += errors.sigma_px * normal(random);
    vision::MarkerReading reading;
    reading.kind = seen->kind;
    reading.size_m = seen->size_m;
    reading.payload = seen->payload;
    reading.centre = vision::distorted(camera, ideal);
    reading.angle_rad = wrap(kPi / 2 - place.heading_rad + errors.sigma_angle_rad * normal(random));
    reading.x_m = ideal.u / vision::pixels_per_metre(camera);
    reading.y_m = ideal.v / vision::pixels_per_metre(camera);
    reading.sigma_px = errors.sigma_px;
    reading.sigma_angle_rad = errors.sigma_angle_rad;
    reading.rms_px = errors.rms_px;
    reading.inlier_share = errors.inlier_share;
    reading.corners = vision::code_corners(camera, place, seen->size_m);
    return reading;
}

}  // namespace pulseline::simulation
