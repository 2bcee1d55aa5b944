#include "server/agent/picture_cameras.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/localisation/codes_on_way.hpp"
#include "core/onboard/code_reading.hpp"
#include "core/vision/marker_reader.hpp"
#include "core/vision/optics/camera_picture.hpp"

namespace pulseline::agent {
namespace {

using geometry::Pose2;
using vda5050::SurveyedMarker;

// Nothing is exposed for a code that would be cut by more than this at the picture's border.
constexpr double kCutMost_m = 0.01;

double beside_m(const plant::Camera& camera, const Pose2& hall_from_body,
                const SurveyedMarker& marker) {
    const auto foot = hall_from_body * camera.body_from_camera.position();
    return distance(foot, marker.pose.position());
}

/// The code next to the camera's foot as far as the vehicle knows; null: none of a kind it reads.
const SurveyedMarker* code_below(const plant::Camera& camera, const Pose2& hall_from_body,
                                 std::span<const SurveyedMarker> expected) {
    const SurveyedMarker* nearest = nullptr;
    for (const auto& marker : expected) {
        if (!plant::parse_marker_kind(marker.kind)) continue;
        const bool nearer = nearest == nullptr || beside_m(camera, hall_from_body, marker) <
                                                      beside_m(camera, hall_from_body, *nearest);
        if (nearer) nearest = &marker;
    }
    return nearest;
}

/// Reads a picture for the code that is expected, or without one for what the type usually has.
vda5050::CameraReading read_code(const cv::Mat& grey, const plant::Camera& camera,
                                 const plant::UsualCode& look, const SurveyedMarker* expected,
                                 const Pose2& hall_from_body,
                                 const localisation::ErrorBudget& errors, bool loaded) {
    vision::ReaderOptions options;
    options.size_m = look.size_m;
    if (expected != nullptr) {
        options.expected = vision::ExpectedMarker{inverse(hall_from_body) * expected->pose};
    }
    const auto seen = vision::read_marker(look.kind, grey, camera, options);
    if (!seen) return onboard::no_code(camera, seen.error().reason.code);
    return onboard::code_reading(camera, *seen, errors, loaded);
}

plant::UsualCode look_of(const plant::VehicleType& type, const SurveyedMarker* expected) {
    if (expected == nullptr) return type.usual_code;
    return {*plant::parse_marker_kind(expected->kind), expected->size_m};
}

}  // namespace

PictureCameras::PictureCameras(const plant::VehicleType& type, const onboard::Drive& drive,
                               Shutter& shutter, const localisation::ErrorBudget& errors,
                               bool loaded)
    : type_(type),
      drive_(drive),
      shutter_(shutter),
      errors_(errors),
      loaded_(loaded),
      since_frame_s_(type.cameras.size()) {}

/// Creeping along a stop it may not wait for a picture: its brakes would fall in.
std::optional<Error> PictureCameras::look_expecting(std::span<const SurveyedMarker> expected) {
    readings_.clear();
    images_.clear();
    std::optional<Error> none;
    const auto wish = drive_.standing() ? Shutter::Wish::kFromNow : Shutter::Wish::kNewest;
    const Pose2& at = drive_.believed_pose();
    for (std::size_t i = 0; i < type_.cameras.size(); ++i) {
        const plant::Camera& camera = type_.cameras[i];
        const auto* below = code_below(camera, at, expected);
        const auto look = look_of(type_, below);
        auto picture = shutter_.expose(i, wish);
        if (!picture) none = picture.error();
        images_.push_back(picture ? std::move(picture->grey) : cv::Mat());
        readings_.push_back(
            picture ? read_code(images_.back(), camera, look, below, at, errors_, loaded_)
                    : onboard::no_code(camera, picture.error().reason.code));
    }
    fresh_ = true;
    return none;
}

Result<vda5050::StopMeasurement> PictureCameras::measure(const vda5050::StopTarget& target) {
    const auto none = look_expecting(target.markers);
    const auto fix = onboard::locate_stop(readings_, target, errors_);
    // Whoever has seen nothing for want of pictures is not helped by cleaning codes.
    const bool seen = std::ranges::any_of(readings_, &vda5050::CameraReading::found);
    if (!fix) return fail(none && !seen ? *none : fix.error());
    fix_ = *fix;
    return onboard::measurement_of(*fix);
}

std::vector<onboard::WayReading> PictureCameras::look_below(
    std::span<const SurveyedMarker> expected, const Pose2& hall_from_body, double own_s) {
    std::vector<onboard::WayReading> ready;
    for (std::size_t i = 0; i < type_.cameras.size(); ++i) {
        const plant::Camera& camera = type_.cameras[i];
        since_frame_s_[i] += own_s;
        if (since_frame_s_[i] < 1 / camera.frame_rate_hz) continue;
        since_frame_s_[i] = std::fmod(since_frame_s_[i], 1 / camera.frame_rate_hz);
        const auto* below = code_below(camera, hall_from_body, expected);
        if (below == nullptr) continue;
        const double within_m = localisation::view_radius_m(camera, below->size_m) + kCutMost_m;
        if (beside_m(camera, hall_from_body, *below) > within_m) continue;
        const auto picture = shutter_.expose(i, Shutter::Wish::kNewest);
        if (!picture) continue;
        const auto seen = read_code(picture->grey, camera, look_of(type_, below), below,
                                    hall_from_body, errors_, loaded_);
        if (!seen.found) continue;
        const kinematics::Twist twist = drive_.twist();
        const auto foot = camera.body_from_camera.position();
        const double speed_mps = std::hypot(twist.vx_mps - twist.turn_radps * foot.y_m,
                                            twist.vy_mps + twist.turn_radps * foot.x_m);
        const double smear_m = speed_mps * std::hypot(camera.exposure_s, picture->sigma_s);
        onboard::WayReading reading;
        reading.marker = *below;
        reading.seen = {seen.payload, seen.code, seen.angle_rad, std::hypot(seen.sigma_m, smear_m),
                        localisation::code_sigma_rad(errors_, 0)};
        reading.age_s = picture->age_s * drive_.time_factor();
        ready.push_back(std::move(reading));
    }
    return ready;
}

std::vector<Cameras::Picture> PictureCameras::pictures() const {
    std::vector<Picture> pictures;
    for (std::size_t i = 0; i < images_.size(); ++i) {
        if (images_[i].empty()) continue;
        const auto jpeg = vision::encode_jpeg(images_[i], type_.cameras[i]);
        pictures.push_back({type_.cameras[i].name, std::string(jpeg.begin(), jpeg.end())});
    }
    return pictures;
}

}  // namespace pulseline::agent
