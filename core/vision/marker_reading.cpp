#include "core/vision/marker_reading.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/plant/marker_geometry.hpp"

namespace pulseline::vision {
namespace {

struct Refusal {
    const char* reason;
    const char* what;
};
constexpr std::array<Refusal, 7> kRefusals{{
    {"bad_image", "The image is not 8-bit grey of the camera's size. Check the camera file."},
    {kNoCode, "No code can be read. Clean the code and the lens, check the light."},
    {"mirrored", "The code is mirrored. Print it again; do not copy it through film."},
    {"ambiguous_code", "Glare or dirt hides part of the code. Clean it and check the light."},
    {"scale_off", "The code has not the expected size. Check print and camera height."},
    {"tilt_off", "The code looks tilted. Check the camera's mounting and calibration."},
    {"fit_poor", "The edges of the code do not agree on one place. Clean the code."},
}};

}  // namespace

tl::unexpected<Error> refuse(const char* reason, Params params) {
    const auto* known = std::ranges::find_if(
        kRefusals, [&](const Refusal& r) { return std::strcmp(r.reason, reason) == 0; });
    return fail(std::strcmp(reason, "bad_image") == 0 ? Errc::kInvalid : Errc::kNotFound, reason,
                known == kRefusals.end() ? "" : known->what, {}, std::move(params));
}

bool tells_more(const Error& a, const Error& b) {
    return b.reason.code == kNoCode && a.reason.code != kNoCode;
}

bool is_image_of(const cv::Mat& grey, const plant::Camera& camera) {
    return grey.type() == CV_8UC1 && grey.cols == camera.width_px && grey.rows == camera.height_px;
}

double size_m(plant::MarkerKind kind, const ReaderOptions& options) {
    return options.size_m > 0 ? options.size_m : plant::usual_size_m(kind);
}

ReadResult accept(plant::MarkerKind kind, const std::string& payload,
                  const std::optional<EdgeFit>& fit, const plant::Camera& camera,
                  double units_per_m, const ReaderOptions& options) {
    if (!fit) return refuse("fit_poor");
    const Placement& place = fit->placement;
    MarkerReading reading;
    reading.kind = kind;
    reading.payload = payload;
    reading.scale_ratio = place.unit_px * units_per_m / pixels_per_metre(camera);
    if (!(std::abs(reading.scale_ratio - 1) <= options.max_scale_error))
        return refuse("scale_off", {{"ratio", reading.scale_ratio}});
    reading.covariance = fit->covariance;
    reading.sigma_px = std::sqrt(std::max(fit->covariance(0, 0), fit->covariance(1, 1)));
    reading.sigma_angle_rad = std::sqrt(fit->covariance(2, 2));
    reading.rms_px = fit->rms_px;
    reading.inlier_share = fit->inlier_share;
    reading.inliers = fit->inliers;
    reading.profiles = fit->profiles;
    if (!reading.covariance.allFinite() || !(reading.sigma_angle_rad >= 0) ||
        reading.inlier_share < options.min_inlier_share ||
        !(reading.rms_px <= options.max_rms_px) || !(reading.sigma_px <= options.max_sigma_px))
        return refuse("fit_poor", {{"inlier_share", reading.inlier_share},
                                   {"rms_px", reading.rms_px},
                                   {"sigma_px", reading.sigma_px}});
    reading.tilt_rad = std::hypot(place.keystone.u, place.keystone.v) * camera.f_px;
    if (!(reading.tilt_rad <= options.max_tilt_rad))
        return refuse("tilt_off", {{"tilt_rad", reading.tilt_rad}});
    reading.centre = distorted(camera, place.centre);
    reading.angle_rad = wrap(place.angle_rad);
    reading.x_m = place.centre.u / pixels_per_metre(camera);
    reading.y_m = place.centre.v / pixels_per_metre(camera);
    reading.size_m = size_m(kind, options);
    const double h = reading.size_m * units_per_m / 2;
    reading.corners = {distorted(camera, place.at(-h, -h)), distorted(camera, place.at(h, -h)),
                       distorted(camera, place.at(h, h)), distorted(camera, place.at(-h, h))};
    return reading;
}

geometry::Pose2 body_from_marker(const MarkerReading& reading, const plant::Camera& camera) {
    // Up is -v, that is +y of the camera's floor frame; image angles count clockwise.
    return camera.body_from_camera *
           geometry::Pose2{reading.x_m, -reading.y_m, kPi / 2 - reading.angle_rad};
}

}  // namespace pulseline::vision
