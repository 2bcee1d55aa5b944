#include "server/agent/picture_sources.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "server/agent/picture_file.hpp"
#include "server/agent/v4l2_stream.hpp"

namespace pulseline::agent {
namespace {

using Opened = Result<std::unique_ptr<PictureSource>>;

/// The file itself may come later; without its folder the name is wrong.
Opened open_file(const plant::Camera& camera, const std::string& path) {
    const auto folder = std::filesystem::absolute(path).parent_path();
    std::error_code ec;
    if (!std::filesystem::is_directory(folder, ec)) {
        return fail(Errc::kNotFound, "camera_no_folder",
                    "--camera " + camera.name + "=file:" + path + ": there is no folder " +
                        folder.string() + "; name the file that the camera's program writes");
    }
    return std::make_unique<PictureFile>(camera, path);
}

Opened open_device(const plant::Camera& camera, const std::string& device) {
    auto opened = StreamedPictures::open([&camera, device] { return open_v4l2(camera, device); });
    if (!opened) return fail(opened.error());
    return std::move(*opened);
}

}  // namespace

Result<PictureSources> open_sources(const std::vector<CameraSource>& wanted,
                                    const std::vector<plant::Camera>& cameras) {
    PictureSources sources(cameras.size());
    for (const auto& one : wanted) {
        const auto found = std::ranges::find(cameras, one.camera, &plant::Camera::name);
        if (found == cameras.end()) {
            std::string names;
            for (const auto& camera : cameras) names += (names.empty() ? "" : ", ") + camera.name;
            return fail(Errc::kNotFound, "unknown_camera",
                        "--camera " + one.camera + ": the vehicle's type has no such camera; " +
                            (names.empty() ? "it has none" : "name one of " + names),
                        {}, {{"camera", one.camera}});
        }
        auto source = one.kind == CameraSource::Kind::kV4l2 ? open_device(*found, one.where)
                                                            : open_file(*found, one.where);
        if (!source) return fail(source.error());
        sources[static_cast<std::size_t>(found - cameras.begin())] = std::move(*source);
    }
    return sources;
}

}  // namespace pulseline::agent
