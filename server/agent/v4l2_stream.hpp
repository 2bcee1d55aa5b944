#pragma once

#include <memory>
#include <string>

#include "server/agent/streamed_pictures.hpp"

namespace pulseline::agent {

/// A camera of Video4Linux (/dev/video0), through OpenCV. `camera` must outlive it. Errors:
/// camera_not_opened {camera}, camera_wrong_size.
Result<std::unique_ptr<FrameStream>> open_v4l2(const plant::Camera& camera,
                                               const std::string& device);

/// When a frame was exposed: as the driver's stamp says where that can be true, a monotonic time in
/// milliseconds, else about when it was taken out of the queue.
struct Exposed {
    PictureSource::Clock::time_point at;
    double sigma_s = 0;
};
Exposed exposed_at(double stamp_ms, PictureSource::Clock::time_point taken_out);

}  // namespace pulseline::agent
