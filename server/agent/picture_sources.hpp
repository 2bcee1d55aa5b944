#pragma once

#include <vector>

#include "server/agent/options.hpp"
#include "server/agent/source_shutter.hpp"

namespace pulseline::agent {

/// What --camera says, for the cameras of a vehicle's type, which must outlive them. Errors:
/// unknown_camera {camera}, those of open_v4l2, camera_no_folder.
Result<PictureSources> open_sources(const std::vector<CameraSource>& wanted,
                                    const std::vector<plant::Camera>& cameras);

}  // namespace pulseline::agent
