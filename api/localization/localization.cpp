#include "api/localization/localization.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "api/localization/image_bytes.hpp"
#include "core/localisation/error_budget.hpp"
#include "core/vision/marker_reader.hpp"
#include "core/vision/optics/camera_picture.hpp"
#include "core/vision/optics/optics.hpp"

namespace pulseline::api::localization {

using namespace vision;

namespace {

// As the vehicles count it in their own measurements.
const auto kErrors = localisation::ErrorBudget::nominal();

struct Print {
    plant::MarkerKind kind;
    double size_m;
    auto operator<=>(const Print&) const = default;
};

std::string at(const char* field, std::size_t i) {
    return "/images/" + std::to_string(i) + "/" + field;
}

std::vector<const plant::Marker*> markers_of(const plant::Plant& plant,
                                             const plant::Station* station) {
    std::vector<const plant::Marker*> markers;
    if (!station) {
        for (const auto& marker : plant.markers) markers.push_back(&marker);
        return markers;
    }
    for (const auto& id : station->markers) {
        if (const auto* marker = plant::find_marker(plant, id)) markers.push_back(marker);
    }
    return markers;
}

/// What may lie below a camera: every kind and size that the plant has, for a code of another
/// station is to be told by its name.
std::set<Print> prints_of(const plant::Plant& plant) {
    std::set<Print> prints;
    for (const auto& marker : plant.markers) prints.insert({marker.kind, marker.size_m});
    return prints;
}

Result<MarkerReading> read_any(const cv::Mat& grey, const plant::Camera& camera,
                               const std::set<Print>& prints) {
    Result<MarkerReading> best = refuse(kNoCode);
    for (const Print& print : prints) {
        ReaderOptions options;
        options.size_m = print.size_m;
        auto reading = read_marker(print.kind, grey, camera, options);
        if (reading) return reading;
        if (tells_more(reading.error(), best.error())) best = std::move(reading);
    }
    return best;
}

Result<CameraFinding> look(const CameraImage& image, std::size_t i, const plant::Camera& camera,
                           const std::set<Print>& prints, bool loaded) {
    auto grey = decode_grey(image.bytes, image.camera);
    if (!grey) {
        Error error = grey.error();
        error.field = at("image", i);
        return fail(std::move(error));
    }
    if (grey->cols != camera.width_px || grey->rows != camera.height_px) {
        return fail(Errc::kInvalid, "image_size",
                    "The image is not of the camera's size. Send it as the camera gave it.",
                    at("image", i),
                    {{"width_px", std::int64_t{camera.width_px}},
                     {"height_px", std::int64_t{camera.height_px}}});
    }
    CameraFinding finding{image.camera, read_any(*grey, camera, prints), {}, 0, {}};
    std::optional<geometry::Pose2> seen;
    double size_m = 0.060;
    if (finding.reading) {
        seen = finding.body_from_marker = body_from_marker(*finding.reading, camera);
        finding.sigma_m = localisation::code_sigma_m(
            kErrors, camera, std::hypot(finding.reading->x_m, finding.reading->y_m),
            finding.reading->sigma_px / pixels_per_metre(camera), loaded);
        size_m = finding.reading->size_m;
    }
    const auto jpeg = encode_jpeg(annotate(*grey, camera, seen, size_m), camera);
    finding.picture.assign(jpeg.begin(), jpeg.end());
    return finding;
}

const plant::Station* station_with(const plant::Plant& plant, const std::string& payload) {
    const auto* marker = plant::find_marker_by_payload(plant, payload);
    if (!marker) return nullptr;
    const auto found = std::ranges::find_if(plant.stations, [&](const plant::Station& station) {
        return std::ranges::find(station.markers, marker->id) != station.markers.end();
    });
    return found == plant.stations.end() ? nullptr : &*found;
}

Result<localisation::PoseFix> fix_of(const std::vector<CameraFinding>& cameras,
                                     const std::vector<const plant::Marker*>& markers) {
    std::vector<localisation::CodeObservation> seen;
    for (const CameraFinding& finding : cameras) {
        if (!finding.reading) continue;
        seen.push_back({finding.reading->payload, finding.body_from_marker.position(),
                        finding.body_from_marker.heading_rad, finding.sigma_m,
                        localisation::code_sigma_rad(kErrors, finding.reading->sigma_angle_rad)});
    }
    std::vector<localisation::SurveyedCode> survey;
    for (const auto* marker : markers) {
        survey.push_back(
            {marker->payload, marker->pose, marker->sigma_xy_m, marker->sigma_heading_rad});
    }
    return localisation::locate(seen, survey);
}

}  // namespace

Result<Localization> localize(const plant::Plant& plant, const LocalizationQuestion& question) {
    const auto* vehicle = plant::find_vehicle(plant, question.vehicle);
    const auto* type = vehicle ? plant::find_vehicle_type(plant, vehicle->type) : nullptr;
    if (!type) {
        return fail(Errc::kNotFound, "unknown_vehicle",
                    "There is no such vehicle. GET /api/v1/vehicles lists them.", "/vehicle",
                    {{"vehicle", question.vehicle.str()}});
    }
    Localization answer{{}, localisation::PoseFix{}, nullptr, {}};
    if (question.station) {
        answer.station = plant::find_station(plant, *question.station);
        if (!answer.station) {
            return fail(Errc::kNotFound, "unknown_station",
                        "There is no station " + std::to_string(*question.station) +
                            ". GET /api/v1/stations lists them.",
                        "/station", {{"station", std::int64_t{*question.station}}});
        }
    }
    const auto prints = prints_of(plant);
    const bool loaded = plant::first_load(plant, vehicle->id) != nullptr;
    const auto cameras = plant::cameras_of(*type, loaded);
    for (std::size_t i = 0; i < question.images.size(); ++i) {
        const CameraImage& image = question.images[i];
        const auto camera = std::ranges::find(cameras, image.camera, &plant::Camera::name);
        if (camera == cameras.end()) {
            return fail(Errc::kNotFound, "unknown_camera",
                        "The vehicle has no camera of that name. GET /api/v1/plant lists them.",
                        at("camera", i), {{"camera", image.camera}});
        }
        const auto same = [&](const CameraFinding& other) { return other.camera == image.camera; };
        if (std::ranges::any_of(answer.cameras, same)) {
            return fail(Errc::kInvalid, "camera_twice",
                        "One image of each camera can be told apart. Leave out the other one.",
                        at("camera", i), {{"camera", image.camera}});
        }
        auto finding = look(image, i, *camera, prints, loaded);
        if (!finding) return fail(finding.error());
        answer.cameras.push_back(std::move(*finding));
    }
    answer.fix = fix_of(answer.cameras, markers_of(plant, answer.station));
    if (!answer.station && answer.fix) {
        answer.station = station_with(plant, answer.fix->payloads.front());
    }
    if (answer.station && answer.fix) {
        answer.deviation = plant::deviation(*answer.station, answer.fix->pose);
    }
    return answer;
}

}  // namespace pulseline::api::localization
