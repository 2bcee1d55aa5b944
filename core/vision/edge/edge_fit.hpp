#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

#include "core/plant/plant.hpp"
#include "core/vision/optics/placement.hpp"

namespace pulseline::vision {

/// A point on a printed border, marker units: (na, nb) is the unit normal from dark to light.
struct EdgeSite {
    double a = 0;
    double b = 0;
    double na = 0;
    double nb = 0;
};

struct EdgeFit {
    Placement placement;
    /// Of centre u, v [px] and angle [rad], ideal image frame.
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double growth_px = 0;  // of dark over light: ink, clipped light
    double rms_px = 0;
    double inlier_share = 0;  // of the sites in the image
    int inliers = 0;
    int profiles = 0;
};

/// kLocate: starts up to a quarter of the smallest feature away. kMeasure: the whole accuracy.
enum class FitEffort { kLocate, kMeasure };

/// Robust fit of the placement to printed borders. Input: sites of a marker whose code is known (or
/// of the part of it that every code has), the width of its narrowest feature in marker units, a
/// placement good to a quarter of that. Method: sub-pixel edge position by
/// the area under short profiles between the levels on both sides, Tukey-weighted least squares
/// over position, angle, scale, camera tilt (with a prior, so that it only enters as far as the
/// edges show it) and growth of the ink; lens distortion known. Nothing when too few edges show.
std::optional<EdgeFit> fit_edges(const cv::Mat& grey, const plant::Camera& camera,
                                 std::span<const EdgeSite> sites, double feature_units,
                                 const Placement& start, FitEffort effort = FitEffort::kMeasure);

}  // namespace pulseline::vision
