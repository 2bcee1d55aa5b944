#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>

#include "core/simulation/floor_camera.hpp"

namespace pulseline::simulation {

/// Lays one code with its white sheet into a scene of reflectances (CV_32F). Each pixel is the mean
/// over its quadrilateral on the floor, by clipping it at module borders: exact, no supersampling.
/// `corners(v)`: floor points of the upper pixel corners of row v, one more than pixels.
void print_code(cv::Mat& scene, const FloorCode& code, const Pose2& camera_from_code,
                const FloorProjection& projection,
                const std::function<const cv::Vec2f*(int)>& corners);

}  // namespace pulseline::simulation
