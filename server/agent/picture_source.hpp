#pragma once

#include <chrono>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/base/result.hpp"
#include "core/plant/vehicle_type.hpp"

namespace pulseline::agent {

/// Port: where the pictures of one camera come from that its machine does not take. Whoever asks
/// waits; a source never does.
class PictureSource {
public:
    using Clock = std::chrono::steady_clock;

    struct Taken {
        cv::Mat grey;  // 8 bit, of the camera's size
        Clock::time_point exposed;
        double sigma_s = 0;  // of that moment
    };

    virtual ~PictureSource() = default;
    /// The newest picture, each once; nothing: there is none that was exposed at `from` or later.
    /// Errors: camera_silent, camera_wrong_size {camera, told, wanted}, bad_image {camera}.
    virtual Result<std::optional<Taken>> newest(Clock::time_point from) = 0;
};

/// Errors: camera_wrong_size.
[[nodiscard]] Status has_size(cv::Size told_px, const plant::Camera& camera);
/// `why`: "its file is gone", say.
tl::unexpected<Error> camera_silent(const plant::Camera& camera, const std::string& why);
tl::unexpected<Error> bad_image(const plant::Camera& camera, const std::string& why);

}  // namespace pulseline::agent
