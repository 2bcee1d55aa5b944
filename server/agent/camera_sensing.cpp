#include "server/agent/camera_sensing.hpp"

#include <algorithm>
#include <utility>

#include "core/localisation/dual_camera.hpp"
#include "core/simulation/world/true_camera.hpp"
#include "core/vision/optics/camera_picture.hpp"

namespace pulseline::agent {
namespace {

using simulation::FloorCode;

constexpr double kAround_m = 20;      // farther codes are no camera's business
constexpr std::size_t kQrBytes = 11;  // of a version 1 symbol, level Q

}  // namespace

CameraSensing::CameraSensing(const simulation::World& world, const plant::HallId& hall,
                             const simulation::SimulatedDrive& motion, bool rendered,
                             std::uint64_t seed, bool loaded)
    : world_(world), hall_(hall), motion_(motion), random_(seed), actual_(motion.type().cameras) {
    options_.mode = rendered ? simulation::Sensing::kRendered : simulation::Sensing::kAnalytic;
    options_.errors = world.errors;
    options_.loaded = loaded;
    options_.look = motion.type().usual_code;
    for (auto& camera : actual_) {
        camera = simulation::true_camera(camera, world.errors.camera, loaded, random_);
    }
}

std::vector<FloorCode> CameraSensing::codes_around() const {
    std::vector<FloorCode> codes;
    if (covered_) return codes;
    for (const auto& marker : world_.markers) {
        const bool drawable =
            marker.kind != plant::MarkerKind::kQr || marker.payload.size() <= kQrBytes;
        if (options_.mode == simulation::Sensing::kRendered && !drawable) continue;
        if (marker.hall != hall_) continue;
        if (distance(marker.pose.position(), motion_.true_pose().position()) > kAround_m) continue;
        codes.push_back({marker.payload, marker.pose, marker.size_m, false, marker.kind});
    }
    return codes;
}

void CameraSensing::look() { look_expecting(std::nullopt); }

void CameraSensing::look_expecting(std::optional<simulation::KnownFloor> known) {
    options_.dark = dark_;
    const auto codes = codes_around();
    options_.known = std::move(known);
    auto view = simulation::sense_stop(actual_, motion_.type().cameras, motion_.true_pose(), codes,
                                       options_, random_);
    readings_ = std::move(view.readings);
    pictured_ = readings_;
    images_ = std::move(view.images);
    sizes_m_ = std::move(view.sizes_m);
    fresh_ = true;
}

bool CameraSensing::take_fresh() { return std::exchange(fresh_, false); }

Result<vda5050::StopMeasurement> CameraSensing::measure(const vda5050::StopTarget& target) {
    simulation::KnownFloor known{motion_.believed_pose(), {}};
    for (const auto& marker : target.markers) {
        // Of a kind that it has never heard of it sees none.
        const auto kind = plant::parse_marker_kind(marker.kind);
        if (kind) known.codes.push_back({marker.pose, {*kind, marker.size_m}});
    }
    look_expecting(std::move(known));
    std::vector<localisation::CodeObservation> seen;
    for (const auto& reading : readings_) {
        if (!reading.found) continue;
        seen.push_back({reading.payload, reading.code, reading.angle_rad, reading.sigma_m,
                        localisation::code_sigma_rad(options_.errors, 0)});
    }
    std::vector<localisation::SurveyedCode> survey;
    for (const auto& marker : target.markers) {
        if (!plant::parse_marker_kind(marker.kind)) continue;
        // An older server does not say how well it knows the direction.
        const double sigma_rad =
            marker.sigma_rad > 0 ? marker.sigma_rad : options_.errors.marker.survey_rad;
        survey.push_back({marker.payload, marker.pose, marker.sigma_m, sigma_rad});
    }
    const auto fix = localisation::locate(seen, survey);
    if (!fix) return fail(fix.error());
    fix_ = *fix;
    return vda5050::StopMeasurement{fix->pose, fix->sigma_xy_m, fix->sigma_heading_rad,
                                    localisation::to_string(fix->method), fix->payloads};
}

std::vector<CameraSensing::Picture> CameraSensing::pictures() const {
    std::vector<Picture> pictures;
    const auto& cameras = motion_.type().cameras;
    for (std::size_t i = 0; i < images_.size(); ++i) {
        const auto annotated = vision::annotate(
            images_[i], cameras[i], simulation::body_from_code(pictured_[i]), sizes_m_[i]);
        const auto jpeg = vision::encode_jpeg(annotated, cameras[i]);
        pictures.push_back({cameras[i].name, std::string(jpeg.begin(), jpeg.end())});
    }
    return pictures;
}

}  // namespace pulseline::agent
