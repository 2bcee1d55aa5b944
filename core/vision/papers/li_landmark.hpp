#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/plant/plant.hpp"
#include "core/vision/optics/optics.hpp"

/// The pipeline of Li 2020, kept as a named alternative for comparison.
namespace pulseline::vision {

struct LiLandmark {
    int code = 0;
    std::array<Pixel, 5> dots;  // A, C, D, E, F: centroids, px in the image as given
    Pixel centre;               // of the least-squares similarity of the dots
    double angle_rad = 0;
};

/// Sections 3.1 to 3.3: mean filter, Otsu (eq. 4, 5), opening and closing, contour tree with area,
/// circularity, colour and convexity constraints, five dots in a ring, line and cross-ratio test
/// (eq. 6), ring read upright.
std::optional<LiLandmark> li_landmark(const cv::Mat& grey, const plant::Camera& camera,
                                      double size_m);

/// The marker (x right, y down as printed, z into the floor; metres) in the camera's frame.
struct LiPose {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d translation;

    Eigen::Vector3d camera_in_marker() const { return -rotation.transpose() * translation; }
};

/// From four coplanar points: eq. (9) in its corrected form (core/localisation/README.md), by the
/// null vector of the eight equations. `rays`: x/z and y/z of A, D, E, F after undistortion. Not
/// for positioning: its tilt noise times the height is a thousand times the planar fit's error.
LiPose li_p4p(const std::array<Eigen::Vector2d, 4>& marker_m,
              const std::array<Eigen::Vector2d, 4>& rays);

/// The same of a landmark as found.
LiPose li_p4p(const LiLandmark& landmark, const plant::Camera& camera);

}  // namespace pulseline::vision
