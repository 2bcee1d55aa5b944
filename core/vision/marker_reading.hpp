#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "core/geometry/pose2.hpp"
#include "core/plant/plant.hpp"
#include "core/vision/edge/edge_fit.hpp"
#include "core/vision/optics/optics.hpp"

namespace pulseline::vision {

/// A floor marker found in an image, placed by a fit to all its printed borders: the same for every
/// kind.
struct MarkerReading {
    plant::MarkerKind kind = plant::MarkerKind::kQr;
    std::string payload;   // "ST01-F", "17"
    Pixel centre;          // px in the image as given (distorted)
    double angle_rad = 0;  // from +u to +v; 0 when the print stands upright
    double x_m = 0;        // floor plane, from the foot of the optical centre, along +u
    double y_m = 0;        // and along +v
    /// Of centre u, v [px] and angle [rad], from the fit: image noise only, not the calibration.
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double sigma_px = 0;  // the worse axis of the centre
    double sigma_angle_rad = 0;
    double rms_px = 0;        // residual of the borders the fit kept
    double inlier_share = 0;  // of the border profiles tried
    int inliers = 0;
    int profiles = 0;
    double scale_ratio = 1;  // fitted size / expected size
    double tilt_rad = 0;     // of the camera against its calibration, as the keystone shows it
    double size_m = 0;
    std::array<Pixel, 4> corners{};  // top left, top right, bottom right, bottom left, in the image
};

/// A marker that must be near, by odometry and survey.
struct ExpectedMarker {
    geometry::Pose2 body_from_marker;  // heading: its "up"
    double reach_m = 0.015;            // how far away it may be
    double reach_rad = 0.02;
};

/// What is known beforehand, and when a reading is refused.
struct ReaderOptions {
    /// Where a marker is looked for first, and found by less of its print: with its direction known
    /// one finder or three dots suffice. What lies elsewhere is found all the same.
    std::optional<ExpectedMarker> expected;
    double size_m = 0;               // outer size of the black print; 0: the usual one of the kind
    double max_scale_error = 0.015;  // 3 mm of height are 0.7 %
    double min_inlier_share = 0.6;
    double max_rms_px = 0.5;
    double max_sigma_px = 0.05;
    double max_tilt_rad = 0.02;  // 1.1 deg: no mounted camera, or not the marker's shape
};

using ReadResult = Result<MarkerReading>;

/// Refusal reasons of all readers:
/// - bad_image: size or type does not fit the camera
/// - no_code: no marker of about the expected size can be decoded
/// - mirrored: printed or seen mirrored
/// - ambiguous_code: glare or dirt leaves more than one payload possible (landmark)
/// - scale_off {ratio}: wrong print size, camera height or tilt
/// - tilt_off {tilt_rad}: the borders show a keystone no mounted camera has
/// - fit_poor {inlier_share, rms_px, sigma_px}: the borders do not agree on one place
tl::unexpected<Error> refuse(const char* reason, Params params = {});
inline constexpr const char* kNoCode = "no_code";
/// Of two refusals: one that saw a marker and refused it tells more than one that saw nothing.
bool tells_more(const Error& a, const Error& b);

/// The reading that a fit gives, or why it is refused. `units` are marker units per metre.
ReadResult accept(plant::MarkerKind kind, const std::string& payload,
                  const std::optional<EdgeFit>& fit, const plant::Camera& camera,
                  double units_per_m, const ReaderOptions& options);

/// True for an 8-bit grey image of the camera's size.
bool is_image_of(const cv::Mat& grey, const plant::Camera& camera);

double size_m(plant::MarkerKind kind, const ReaderOptions& options);

/// Centre and "up" direction of the marker in the body frame.
geometry::Pose2 body_from_marker(const MarkerReading& reading, const plant::Camera& camera);

}  // namespace pulseline::vision
