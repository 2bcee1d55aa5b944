#include "server/cli/locate_command.hpp"

#include <fmt/core.h>

#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "api/localization/camera_file.hpp"
#include "api/localization/image_bytes.hpp"
#include "core/vision/marker_reader.hpp"

namespace pulseline::server::cli {
namespace {

using nlohmann::json;
using plant::MarkerKind;

void print(const json& line, std::ostream& out) {
    out << line.dump(-1, ' ', false, json::error_handler_t::replace) << std::endl;
}

void print_found(const std::string& image, const vision::MarkerReading& r, double time_ms,
                 bool as_json, std::ostream& out) {
    if (as_json) {
        print({{"image", image},
               {"found", true},
               {"kind", plant::to_string(r.kind)},
               {"payload", r.payload},
               {"center_px", {r.centre.u, r.centre.v}},
               {"angle_rad", r.angle_rad},
               {"x_m", r.x_m},
               {"y_m", r.y_m},
               {"rms_px", r.rms_px},
               {"inliers", r.inliers},
               {"sigma_px", r.sigma_px},
               {"sigma_angle_rad", r.sigma_angle_rad},
               {"scale_ratio", r.scale_ratio},
               {"time_ms", time_ms}},
              out);
        return;
    }
    out << fmt::format(
        "{}: {} {} at ({:.3f}, {:.3f}) px, {:.4f} deg; {:+.3f} {:+.3f} mm from the foot of the "
        "camera; rms {:.3f} px, {} borders, {:.1f} ms\n",
        image, plant::to_string(r.kind), r.payload, r.centre.u, r.centre.v, degrees(r.angle_rad),
        1e3 * r.x_m, 1e3 * r.y_m, r.rms_px, r.inliers, time_ms);
}

void print_refused(const std::string& image, const Error& why, bool as_json, std::ostream& out) {
    if (as_json) {
        json line{
            {"image", image}, {"found", false}, {"reason", why.reason.code}, {"what", why.what}};
        for (const Param& param : why.reason.params)
            std::visit([&](const auto& value) { line["params"][param.name] = value; }, param.value);
        print(line, out);
    } else {
        out << image << ": nothing accepted (" << why.reason.code << "). " << why.what << "\n";
    }
}

void locate_in(const std::string& name, const cv::Mat& image, const plant::Camera& camera,
               const LocateInput& input, std::ostream& out) {
    std::optional<Error> why;
    bool found_any = false;
    for (const MarkerKind kind : {MarkerKind::kQr, MarkerKind::kAprilTag, MarkerKind::kLandmark}) {
        if (input.kind && *input.kind != kind) continue;
        const auto begin = std::chrono::steady_clock::now();
        const auto first = vision::read_marker(kind, image, camera);
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - begin;
        if (!first) {
            if (!why || vision::tells_more(first.error(), *why)) why = first.error();
            continue;
        }
        found_any = true;
        print_found(name, *first, took.count(), input.json, out);
        for (const auto& other : vision::read_others(*first, image, camera))
            print_found(name, other, took.count(), input.json, out);
    }
    if (!found_any && why) print_refused(name, *why, input.json, out);
}

}  // namespace

int locate(const LocateInput& input, std::ostream& out) {
    const auto camera = api::localization::read_camera_file(input.camera_file);
    if (!camera) {
        print_refused(input.camera_file, camera.error(), input.json, out);
        return kLocateUnreadable;
    }
    int outcome = kLocateDone;
    for (const std::string& name : input.images) {
        const auto image = api::localization::read_grey_file(name);
        if (!image) {
            print_refused(name, image.error(), input.json, out);
            outcome = kLocateUnreadable;
            continue;
        }
        locate_in(name, *image, *camera, input, out);
    }
    return outcome;
}

void add_locate_command(CLI::App& app, int& exit_code) {
    const auto input = std::make_shared<LocateInput>();
    auto* command = app.add_subcommand("locate", "Find floor markers in camera images");
    command->add_option("--camera", input->camera_file, "Camera file (JSON)")->required();
    static const std::map<std::string, MarkerKind> kKinds{{"qr", MarkerKind::kQr},
                                                          {"apriltag", MarkerKind::kAprilTag},
                                                          {"landmark", MarkerKind::kLandmark}};
    command->add_option("--kind", input->kind, "Only this kind: qr, apriltag or landmark")
        ->transform(CLI::CheckedTransformer(kKinds));
    command->add_flag("--json", input->json, "One JSON object a line");
    command->add_option("IMAGE", input->images, "PNG, JPEG, BMP or PGM files")->required();
    command->callback([input, &exit_code] { exit_code = locate(*input, std::cout); });
}

}  // namespace pulseline::server::cli
