#include "api/vision/camera_file.hpp"

#include "api/json/object_reader.hpp"
#include "api/vision/file_bytes.hpp"

namespace pulseline::vision {
namespace {

constexpr std::size_t kMostBytes = 1'000'000;

plant::CameraMounting decode_mounting(json::ObjectReader& in) {
    plant::CameraMounting mounting;
    mounting.height_m = in.number("height_m", {0.01, 100});
    mounting.tilt_u_rad = in.number_or("tilt_u_rad", 0, {-0.5, 0.5});
    mounting.tilt_v_rad = in.number_or("tilt_v_rad", 0, {-0.5, 0.5});
    if (auto foot = in.object_if_any("body_from_camera")) {
        mounting.body_from_camera = {foot->number("x_m", {-1e3, 1e3}),
                                     foot->number("y_m", {-1e3, 1e3}),
                                     foot->number("heading_rad", {-10, 10})};
    }
    return mounting;
}

json::Json pose_json(const geometry::Pose2& pose) {
    return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"heading_rad", pose.heading_rad}};
}

}  // namespace

Result<plant::Camera> decode_camera(std::string_view text) {
    const auto parsed = json::parse_json(text);
    if (!parsed) return fail(parsed.error());
    json::FieldErrors errors;
    json::ObjectReader in(*parsed, "", errors);
    plant::Camera camera;
    // Wider than any camera, narrow enough that nothing overflows behind them.
    camera.width_px = static_cast<int>(in.integer("width_px", {64, 20'000}));
    camera.height_px = static_cast<int>(in.integer("height_px", {64, 20'000}));
    camera.f_px = in.number("f_px", {10, 1e6});
    camera.cu_px = in.number("cu_px", {-1e5, 1e5});
    camera.cv_px = in.number("cv_px", {-1e5, 1e5});
    camera.k1 = in.number_or("k1", 0, {-10, 10});
    const auto unloaded = decode_mounting(in);
    camera.body_from_camera = unloaded.body_from_camera;
    camera.height_m = unloaded.height_m;
    camera.tilt_u_rad = unloaded.tilt_u_rad;
    camera.tilt_v_rad = unloaded.tilt_v_rad;
    if (auto loaded = in.object_if_any("loaded")) camera.loaded = decode_mounting(*loaded);
    if (const Status status = errors.status(); !status) return fail(status.error());
    return camera;
}

std::string encode_camera(const plant::Camera& camera) {
    json::Json file{{"width_px", camera.width_px},
                    {"height_px", camera.height_px},
                    {"f_px", camera.f_px},
                    {"cu_px", camera.cu_px},
                    {"cv_px", camera.cv_px},
                    {"k1", camera.k1},
                    {"height_m", camera.height_m},
                    {"tilt_u_rad", camera.tilt_u_rad},
                    {"tilt_v_rad", camera.tilt_v_rad},
                    {"body_from_camera", pose_json(camera.body_from_camera)}};
    if (const auto& loaded = camera.loaded) {
        file["loaded"] = {{"height_m", loaded->height_m},
                          {"tilt_u_rad", loaded->tilt_u_rad},
                          {"tilt_v_rad", loaded->tilt_v_rad},
                          {"body_from_camera", pose_json(loaded->body_from_camera)}};
    }
    return file.dump(2) + "\n";
}

Result<plant::Camera> read_camera_file(const std::string& path) {
    const auto bytes = read_bytes(path, kMostBytes);
    if (!bytes) return fail(bytes.error());
    return decode_camera(*bytes);
}

}  // namespace pulseline::vision
