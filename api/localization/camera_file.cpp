#include "api/localization/camera_file.hpp"

#include "api/json/object_reader.hpp"
#include "api/localization/file_bytes.hpp"

namespace pulseline::api::localization {

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

json::Json encode(const plant::CameraMounting& mounting) {
    const geometry::Pose2& foot = mounting.body_from_camera;
    return {{"height_m", mounting.height_m},
            {"tilt_u_rad", mounting.tilt_u_rad},
            {"tilt_v_rad", mounting.tilt_v_rad},
            {"body_from_camera",
             {{"x_m", foot.x_m}, {"y_m", foot.y_m}, {"heading_rad", foot.heading_rad}}}};
}

}  // namespace

Result<plant::Camera> decode_camera(std::string_view text) {
    const auto parsed = json::parse_json(text);
    if (!parsed) return fail(parsed.error());
    json::FieldErrors errors;
    json::ObjectReader in(*parsed, "", errors);
    plant::Camera camera;
    static_cast<plant::CameraMounting&>(camera) = decode_mounting(in);
    // Wider than any camera, narrow enough that nothing overflows behind them.
    camera.width_px = static_cast<int>(in.integer("width_px", {64, 20'000}));
    camera.height_px = static_cast<int>(in.integer("height_px", {64, 20'000}));
    camera.f_px = in.number("f_px", {10, 1e6});
    camera.cu_px = in.number("cu_px", {-1e5, 1e5});
    camera.cv_px = in.number("cv_px", {-1e5, 1e5});
    camera.k1 = in.number_or("k1", 0, {-10, 10});
    if (auto loaded = in.object_if_any("loaded")) camera.loaded = decode_mounting(*loaded);
    if (const Status status = errors.status(); !status) return fail(status.error());
    return camera;
}

std::string encode_camera(const plant::Camera& camera) {
    json::Json file = encode(static_cast<const plant::CameraMounting&>(camera));
    file.update({{"width_px", camera.width_px},
                 {"height_px", camera.height_px},
                 {"f_px", camera.f_px},
                 {"cu_px", camera.cu_px},
                 {"cv_px", camera.cv_px},
                 {"k1", camera.k1}});
    if (camera.loaded) file["loaded"] = encode(*camera.loaded);
    return file.dump(2) + "\n";
}

Result<plant::Camera> read_camera_file(const std::string& path) {
    const auto bytes = read_bytes(path, kMostBytes);
    if (!bytes) return fail(bytes.error());
    return decode_camera(*bytes);
}

}  // namespace pulseline::api::localization
