#include "core/simulation/stop_sensor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/vision/marker_reader.hpp"

namespace pulseline::simulation {
namespace {

/// Only codes that can touch the image are worth projecting: the rest of the hall is skipped.
std::vector<FloorCode> near(const plant::Camera& camera, const Pose2& hall_from_body,
                            std::span<const FloorCode> codes) {
    const geometry::Point2 foot = hall_from_body * camera.body_from_camera.position();
    const double view_m =
        std::hypot(camera.width_px, camera.height_px) / vision::pixels_per_metre(camera);
    std::vector<FloorCode> kept;
    for (const FloorCode& code : codes)
        if (distance(code.pose.position(), foot) < view_m + 2 * code.size_m) kept.push_back(code);
    return kept;
}

fleet::CameraReading not_found(const plant::Camera& camera, std::string why) {
    fleet::CameraReading reading;
    reading.camera = camera.name;
    reading.why_not = std::move(why);
    return reading;
}

/// The code that lies next to the camera's foot as far as the vehicle knows.
std::optional<vision::ExpectedMarker> expected_below(const plant::Camera& camera,
                                                     const KnownFloor& known) {
    const geometry::Point2 foot = known.hall_from_body * camera.body_from_camera.position();
    const auto nearest = std::ranges::min_element(
        known.codes, {}, [&](const Pose2& code) { return distance(code.position(), foot); });
    if (nearest == known.codes.end()) return std::nullopt;
    return vision::ExpectedMarker{inverse(known.hall_from_body) * *nearest};
}

/// What the vehicle makes of the true image point when its calibration differs from the truth.
vision::MarkerReading reinterpreted(vision::MarkerReading reading, const plant::Camera& actual,
                                    const plant::Camera& calibrated) {
    const vision::Pixel ideal = vision::undistorted(calibrated, reading.centre);
    reading.x_m = ideal.u / vision::pixels_per_metre(calibrated);
    reading.y_m = ideal.v / vision::pixels_per_metre(calibrated);
    reading.scale_ratio = vision::pixels_per_metre(actual) / vision::pixels_per_metre(calibrated);
    return reading;
}

}  // namespace

std::optional<Pose2> body_from_code(const fleet::CameraReading& reading) {
    if (!reading.found) return std::nullopt;
    return Pose2{reading.code.x_m, reading.code.y_m, reading.angle_rad};
}

fleet::CameraReading camera_reading(const plant::Camera& calibrated,
                                    const vision::MarkerReading& reading,
                                    double calibration_sigma_m) {
    const Pose2 code = vision::body_from_marker(reading, calibrated);
    fleet::CameraReading out;
    out.camera = calibrated.name;
    out.found = true;
    out.payload = reading.payload;
    out.code = code.position();
    out.angle_rad = code.heading_rad;
    out.sigma_m =
        std::hypot(reading.sigma_px / vision::pixels_per_metre(calibrated), calibration_sigma_m);
    out.rms_px = reading.rms_px;
    return out;
}

StopView sense_stop(std::span<const plant::Camera> actual,
                    std::span<const plant::Camera> calibrated, const Pose2& hall_from_body,
                    std::span<const FloorCode> codes, const SensingOptions& options,
                    std::mt19937_64& random) {
    assert(actual.size() == calibrated.size());
    StopView view;
    for (std::size_t i = 0; i < actual.size(); ++i) {
        const auto in_reach = near(actual[i], hall_from_body, codes);
        if (options.mode == Sensing::kAnalytic) {
            const auto seen = options.dark
                                  ? std::nullopt
                                  : analytic_reading(actual[i], hall_from_body, in_reach, random);
            view.readings.push_back(
                seen ? camera_reading(calibrated[i], reinterpreted(*seen, actual[i], calibrated[i]),
                                      options.calibration_sigma_m)
                     : not_found(calibrated[i], "no_code"));
            continue;
        }
        auto conditions = ImageConditions::nominal(random);
        if (options.dark) conditions.exposure = 0;
        view.images.push_back(render_floor(actual[i], hall_from_body, in_reach, conditions));
        vision::ReaderOptions reader;
        reader.size_m = options.code_size_m;
        if (options.known) reader.expected = expected_below(calibrated[i], *options.known);
        const auto seen =
            vision::read_marker(options.kind, view.images.back(), calibrated[i], reader);
        view.readings.push_back(
            seen ? camera_reading(calibrated[i], *seen, options.calibration_sigma_m)
                 : not_found(calibrated[i], seen.error().reason.code));
    }
    return view;
}

}  // namespace pulseline::simulation
