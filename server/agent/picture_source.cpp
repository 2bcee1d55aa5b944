#include "server/agent/picture_source.hpp"

#include <string>

namespace pulseline::agent {

Status has_size(cv::Size told_px, const plant::Camera& camera) {
    if (told_px == cv::Size(camera.width_px, camera.height_px)) return {};
    const auto size = [](int width_px, int height_px) {
        return std::to_string(width_px) + " x " + std::to_string(height_px);
    };
    const std::string told = size(told_px.width, told_px.height);
    const std::string wanted = size(camera.width_px, camera.height_px);
    return fail(Errc::kInvalid, "camera_wrong_size",
                "Camera " + camera.name + " gives pictures of " + told + " px instead of " +
                    wanted + ": set it so, or calibrate the plant's camera for that size.",
                {}, {{"camera", camera.name}, {"told", told}, {"wanted", wanted}});
}

tl::unexpected<Error> camera_silent(const plant::Camera& camera, const std::string& why) {
    return fail(Errc::kUnavailable, "camera_silent",
                "Camera " + camera.name + " gives no new pictures: " + why + ".", {},
                {{"camera", camera.name}});
}

tl::unexpected<Error> bad_image(const plant::Camera& camera, const std::string& why) {
    return fail(Errc::kInvalid, "bad_image",
                "The picture of camera " + camera.name + " cannot be read: " + why + ".", {},
                {{"camera", camera.name}});
}

}  // namespace pulseline::agent
