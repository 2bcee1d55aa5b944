#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/geometry/pose2.hpp"
#include "core/localisation/covariance.hpp"

/// Pose of a vehicle from the floor codes its cameras see (Tang 2020 eq. 16 to 19 in the general,
/// corrected form of surveyed codes). Tang's platform frame has y to the RIGHT; everything here
/// uses the body frame of geometry::Pose2, y to the LEFT, so his y are negated where they enter.
namespace pulseline::localisation {

using geometry::Point2;
using geometry::Pose2;

/// A code as a camera measured it, in the body frame.
struct CodeObservation {
    std::string payload;
    Point2 centre;
    double up_rad = 0;   // direction of the code's "up" edge, counter-clockwise from body x
    double sigma_m = 0;  // per axis: image and calibration of the camera together
    double sigma_up_rad = 0;
};

/// Where the survey says it lies, in the hall frame; heading = direction of the "up" edge.
struct SurveyedCode {
    std::string payload;
    Pose2 pose;
    double sigma_m = 0;
    double sigma_heading_rad = 0;
};

enum class Method { kSingleCamera, kDualCamera, kIgps, kReflectors, kContours };

struct PoseFix {
    Pose2 pose;
    /// Covariance of (x_m, y_m, heading_rad) in the hall frame, row by row.
    CovarianceRows covariance{};
    double sigma_xy_m = 0;  // the worse axis
    double sigma_heading_rad = 0;
    Method method = Method::kSingleCamera;
    std::vector<std::string> payloads;  // of the codes; the transmitters of iGPS
    /// Measured minus surveyed distance of the pair of codes that disagrees most, and its limit
    /// (4 sigma). Nothing with a single code: there is no check then.
    std::optional<double> residual_m;
    std::optional<double> residual_limit_m;
};

/// Sets the covariance of a fix and the sigmas that follow from it.
void set_covariance(PoseFix& fix, const Eigen::Matrix3d& covariance);

/// Weighted planar rigid fit of all observed codes to their surveyed places; with one code its own
/// angle gives the heading. Fails with
/// - no_marker_in_view
/// - unknown_code {payload}: a code the survey given does not contain
/// - code_out_of_view {payload}: an observation that no camera can have made
/// - code_distance_mismatch {residual_m, limit_m}: a code moved, a wrong code, wrong camera scale
/// - code_angle_mismatch {payload, residual_rad, limit_rad}: codes or cameras exchanged for each
///   other, a code turned
/// - pose_not_finite: codes that tell no place
Result<PoseFix> locate(std::span<const CodeObservation> observations,
                       std::span<const SurveyedCode> survey);

const char* to_string(Method method);  // "dual_camera"

}  // namespace pulseline::localisation
