#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>

#include "core/simulation/world/floor_camera.hpp"

namespace pulseline::simulation {

/// Floor points of the upper pixel corners of row v, one more than pixels.
using FloorRows = std::function<const cv::Vec2f*(int)>;

/// Lays one marker with its white sheet into a scene of reflectances (CV_32F). Each pixel is the
/// mean over its quadrilateral on the floor, cut exactly at every printed border, straight or
/// round: no supersampling. REQUIRES: a payload of the marker's kind.
void print_code(cv::Mat& scene, const FloorCode& code, const Pose2& camera_from_code,
                const FloorProjection& projection, const FloorRows& corners);

}  // namespace pulseline::simulation
