#include "api/vda5050/frame.hpp"

#include <cstdint>
#include <utility>

namespace pulseline::vda5050 {
namespace {

// An order of some hundred nodes with trajectories and actions, or a long state.
constexpr json::JsonLimits kLimits{32, 100'000};
constexpr std::size_t kLengthBytes = 4;

}  // namespace

std::string encode_frame(Topic topic, bool retain, std::string_view payload) {
    std::string frame = R"({"topic":")";
    frame += to_string(topic);
    frame += retain ? R"(","retain":true,"payload":)" : R"(","retain":false,"payload":)";
    frame += payload;
    frame += '}';
    return frame;
}

Result<Frame> decode_frame(std::string_view text) {
    auto parsed = json::parse_json(text, kLimits);
    if (!parsed) return fail(parsed.error());
    json::FieldErrors errors;
    json::ObjectReader in(*parsed, "", errors);
    Frame frame;
    frame.topic = in.one_of(
        "topic", {Topic::kOrder, Topic::kInstantActions, Topic::kState, Topic::kVisualization,
                  Topic::kConnection, Topic::kFactsheet, Topic::kHandHeld});
    frame.retain = in.boolean_or("retain", false);
    in.object("payload");
    if (auto status = errors.status(); !status) return fail(status.error());
    frame.payload = std::move((*parsed)["payload"]);
    return frame;
}

Result<std::string> encode_camera_frame(const CameraFrame& frame) {
    const std::string header =
        print({{"camera", frame.camera}, {"timestamp", frame.timestamp}, {"mime", frame.mime}});
    const std::size_t size = kLengthBytes + header.size() + frame.bytes.size();
    if (size > kMaxCameraFrame) {
        return fail(Errc::kInvalid, "picture_too_large",
                    "the picture takes " + std::to_string(size) + " bytes of " +
                        std::to_string(kMaxCameraFrame) + " allowed; compress it more");
    }
    std::string out;
    out.reserve(size);
    const auto length = static_cast<std::uint32_t>(header.size());
    for (int shift = 0; shift < 32; shift += 8) {
        out += static_cast<char>(static_cast<unsigned char>(length >> shift));
    }
    out += header;
    out += frame.bytes;
    return out;
}

Result<CameraFrame> decode_camera_frame(std::string_view bytes) {
    const auto bad = [](const char* what) {
        return fail(Errc::kInvalid, "bad_camera_frame", what);
    };
    if (bytes.size() > kMaxCameraFrame) return bad("the binary frame is longer than 256 KB");
    if (bytes.size() < kLengthBytes) return bad("the binary frame lacks its header length");
    std::uint32_t length = 0;
    for (std::size_t i = 0; i < kLengthBytes; ++i) {
        length |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
    }
    if (length > bytes.size() - kLengthBytes) {
        return bad("the header length of the binary frame passes its end");
    }
    const auto header = json::parse_json(bytes.substr(kLengthBytes, length));
    if (!header) return fail(header.error());
    json::FieldErrors errors;
    json::ObjectReader in(*header, "", errors);
    CameraFrame frame;
    frame.camera = in.text("camera", {1, 64});
    frame.timestamp = in.text("timestamp", {1, 64});
    frame.mime = in.text("mime", {1, 64});
    frame.bytes = bytes.substr(kLengthBytes + length);
    if (auto status = errors.status(); !status) return fail(status.error());
    return frame;
}

}  // namespace pulseline::vda5050
