#include "core/simulation/world/stop_sensor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/localisation/reading_speed.hpp"
#include "core/onboard/code_reading.hpp"
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

/// The code that lies next to the camera's foot as far as the vehicle knows; null: it knows none.
const KnownCode* code_below(const plant::Camera& camera, const std::optional<KnownFloor>& known) {
    if (!known) return nullptr;
    const geometry::Point2 foot = known->hall_from_body * camera.body_from_camera.position();
    const auto nearest = std::ranges::min_element(known->codes, {}, [&](const KnownCode& code) {
        return distance(code.pose.position(), foot);
    });
    return nearest == known->codes.end() ? nullptr : &*nearest;
}

/// What a reader that looks for codes of that kind and size would not take.
const char* refused(const vision::MarkerReading& seen, const plant::UsualCode& look) {
    if (seen.kind != look.kind) return "no_code";
    const double ratio = seen.scale_ratio * seen.size_m / look.size_m;
    return std::abs(ratio - 1) > vision::ReaderOptions{}.max_scale_error ? "scale_off" : nullptr;
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

StopView sense_stop(std::span<const plant::Camera> actual,
                    std::span<const plant::Camera> calibrated, const Pose2& hall_from_body,
                    std::span<const FloorCode> codes, const SensingOptions& options,
                    std::mt19937_64& random) {
    assert(actual.size() == calibrated.size());
    StopView view;
    for (std::size_t i = 0; i < actual.size(); ++i) {
        const auto in_reach = near(actual[i], hall_from_body, codes);
        const KnownCode* expected = code_below(calibrated[i], options.known);
        const plant::UsualCode look = expected ? expected->look : options.look;
        const double smear_px = norm(options.smear_m) * vision::pixels_per_metre(actual[i]);
        const auto found = [&](const vision::MarkerReading& reading) {
            view.readings.push_back(
                onboard::code_reading(calibrated[i], reading, options.errors, options.loaded));
        };
        const auto missed = [&](const char* why) {
            view.readings.push_back(onboard::no_code(calibrated[i], why));
        };
        if (options.mode == Sensing::kAnalytic) {
            const bool blind = options.dark || smear_px > localisation::kMostSmear_px;
            ReadingErrors errors;
            errors.sigma_px *= 1 + smear_px;
            const auto seen =
                blind ? std::nullopt
                      : analytic_reading(actual[i], hall_from_body, in_reach, random, errors);
            const auto read =
                seen ? std::optional(reinterpreted(*seen, actual[i], calibrated[i])) : std::nullopt;
            const char* why_not = read ? refused(*read, look) : "no_code";
            why_not ? missed(why_not) : found(*read);
            continue;
        }
        auto conditions = ImageConditions::nominal(random);
        if (options.dark) conditions.exposure = 0;
        conditions.motion_blur_px = smear_px;
        conditions.motion_direction_rad = std::atan2(-options.smear_m.y_m, options.smear_m.x_m);
        view.images.push_back(render_floor(actual[i], hall_from_body, in_reach, conditions));
        vision::ReaderOptions reader;
        reader.size_m = look.size_m;
        if (expected) {
            reader.expected =
                vision::ExpectedMarker{inverse(options.known->hall_from_body) * expected->pose};
        }
        const auto seen = vision::read_marker(look.kind, view.images.back(), calibrated[i], reader);
        seen ? found(*seen) : missed(seen.error().reason.code.c_str());
    }
    return view;
}

}  // namespace pulseline::simulation
