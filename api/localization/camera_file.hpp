#pragma once

#include <string>
#include <string_view>

#include "core/base/result.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::api::localization {

/// A camera file (core/vision/README.md): a JSON object with width_px, height_px, f_px, cu_px,
/// cv_px, k1, height_m and, where the calibration knows them, tilt_u_rad, tilt_v_rad,
/// body_from_camera and loaded as in a plant file. Other members are other programs' business.
/// Reason codes: those of json::parse_json and json::ObjectReader.
[[nodiscard]] Result<plant::Camera> decode_camera(std::string_view text);
std::string encode_camera(const plant::Camera& camera);

/// Fails with file_unreadable as well.
[[nodiscard]] Result<plant::Camera> read_camera_file(const std::string& path);

}  // namespace pulseline::api::localization
