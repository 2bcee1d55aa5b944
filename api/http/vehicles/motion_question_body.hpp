#pragma once

#include "api/json/object_reader.hpp"
#include "core/fleet/views/motion_preview.hpp"
#include "core/geometry/pose2.hpp"

/// Decoders of what a motion preview is asked. Errors are kept by the reader.
namespace pulseline::api {

/// {x_m, y_m, heading_rad}.
geometry::Pose2 read_pose_members(json::ObjectReader& in);

fleet::MotionQuestion read_motion_question_body(json::ObjectReader& in);

}  // namespace pulseline::api
