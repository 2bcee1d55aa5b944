#include "core/onboard/code_reading.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace pulseline::onboard {

using geometry::Pose2;

vda5050::CameraReading code_reading(const plant::Camera& camera,
                                    const vision::MarkerReading& reading,
                                    const localisation::ErrorBudget& errors, bool loaded) {
    const Pose2 code = vision::body_from_marker(reading, camera);
    vda5050::CameraReading out;
    out.camera = camera.name;
    out.found = true;
    out.payload = reading.payload;
    out.code = code.position();
    out.angle_rad = code.heading_rad;
    out.sigma_m =
        localisation::code_sigma_m(errors, camera, std::hypot(reading.x_m, reading.y_m),
                                   reading.sigma_px / vision::pixels_per_metre(camera), loaded);
    out.rms_px = reading.rms_px;
    return out;
}

vda5050::CameraReading no_code(const plant::Camera& camera, std::string why) {
    vda5050::CameraReading reading;
    reading.camera = camera.name;
    reading.why_not = std::move(why);
    return reading;
}

std::optional<Pose2> body_from_code(const vda5050::CameraReading& reading) {
    if (!reading.found) return std::nullopt;
    return Pose2{reading.code.x_m, reading.code.y_m, reading.angle_rad};
}

Result<localisation::PoseFix> locate_stop(std::span<const vda5050::CameraReading> readings,
                                          const vda5050::StopTarget& target,
                                          const localisation::ErrorBudget& errors) {
    std::vector<localisation::CodeObservation> seen;
    for (const auto& reading : readings) {
        if (!reading.found) continue;
        seen.push_back({reading.payload, reading.code, reading.angle_rad, reading.sigma_m,
                        localisation::code_sigma_rad(errors, 0)});
    }
    std::vector<localisation::SurveyedCode> survey;
    for (const auto& marker : target.markers) {
        if (!plant::parse_marker_kind(marker.kind)) continue;
        // An older server does not say how well it knows the direction.
        const double sigma_rad = marker.sigma_rad > 0 ? marker.sigma_rad : errors.marker.survey_rad;
        survey.push_back({marker.payload, marker.pose, marker.sigma_m, sigma_rad});
    }
    return localisation::locate(seen, survey);
}

vda5050::StopMeasurement measurement_of(const localisation::PoseFix& fix) {
    return {fix.pose, fix.sigma_xy_m, fix.sigma_heading_rad, localisation::to_string(fix.method),
            fix.payloads};
}

}  // namespace pulseline::onboard
