#pragma once

#include <string>
#include <string_view>

#include "api/vda5050/header.hpp"

namespace pulseline::vda5050 {

/// A text frame of the vehicle link: what an MQTT message would be, in an envelope.
struct Frame {
    Topic topic = Topic::kState;
    bool retain = false;
    Json payload;  // an object
};

/// `payload` goes out byte for byte.
std::string encode_frame(Topic topic, bool retain, std::string_view payload);
[[nodiscard]] Result<Frame> decode_frame(std::string_view text);

/// A binary frame: a picture of one camera.
struct CameraFrame {
    std::string camera;
    std::string timestamp;
    std::string mime;
    std::string_view bytes;  // within the frame it was decoded from
};
inline constexpr std::size_t kMaxCameraFrame = 256 * 1024;

/// Error (Errc::kInvalid, picture_too_large) when the frame would pass kMaxCameraFrame.
[[nodiscard]] Result<std::string> encode_camera_frame(const CameraFrame& frame);
[[nodiscard]] Result<CameraFrame> decode_camera_frame(std::string_view bytes);

}  // namespace pulseline::vda5050
