#include "server/agent/camera_sensing.hpp"

#include <algorithm>
#include <utility>

#include "core/localisation/dual_camera.hpp"
#include "core/vision/camera_picture.hpp"

namespace pulseline::agent {
namespace {

using simulation::FloorCode;

constexpr double kAround_m = 20;      // farther codes are no camera's business
constexpr std::size_t kQrBytes = 11;  // of a version 1 symbol, level Q
constexpr double kMounting_m = 7e-5;  // true mounting against the calibrated one, per axis
constexpr double kMounting_rad = 2e-4;
constexpr double kSigmaUp_rad = 3e-4;  // mounting and fit together

localisation::CodeObservation observation(const fleet::CameraReading& reading) {
    return {reading.payload, reading.code, reading.angle_rad, reading.sigma_m, kSigmaUp_rad};
}

}  // namespace

CameraSensing::CameraSensing(const simulation::World& world, const plant::HallId& hall,
                             const simulation::Drive& motion, bool rendered, std::uint64_t seed)
    : world_(world), hall_(hall), motion_(motion), random_(seed), actual_(motion.type().cameras) {
    options_.mode = rendered ? simulation::Sensing::kRendered : simulation::Sensing::kAnalytic;
    std::normal_distribution<double> normal;
    for (auto& camera : actual_) {
        camera.body_from_camera =
            camera.body_from_camera * geometry::Pose2{kMounting_m * normal(random_),
                                                      kMounting_m * normal(random_),
                                                      kMounting_rad * normal(random_)};
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

void CameraSensing::look_for_nearest(const std::vector<FloorCode>& codes) {
    double least_m = kAround_m;
    for (const auto& camera : motion_.type().cameras) {
        const auto foot = motion_.true_pose() * camera.body_from_camera.position();
        for (const FloorCode& code : codes) {
            const double away_m = distance(code.pose.position(), foot);
            if (away_m >= least_m) continue;
            least_m = away_m;
            options_.kind = code.kind;
            options_.code_size_m = code.size_m;
        }
    }
}

void CameraSensing::look() { look_expecting(std::nullopt); }

void CameraSensing::look_expecting(std::optional<simulation::KnownFloor> known) {
    options_.dark = dark_;
    const auto codes = codes_around();
    look_for_nearest(codes);
    options_.known = std::move(known);
    auto view = simulation::sense_stop(actual_, motion_.type().cameras, motion_.true_pose(), codes,
                                       options_, random_);
    readings_ = std::move(view.readings);
    pictured_ = readings_;
    images_ = std::move(view.images);
    fresh_ = true;
}

bool CameraSensing::take_fresh() { return std::exchange(fresh_, false); }

Result<fleet::StopMeasurement> CameraSensing::measure(const fleet::StopTarget& target) {
    simulation::KnownFloor known{motion_.believed_pose(), {}};
    for (const auto& marker : target.markers) known.codes.push_back(marker.pose);
    look_expecting(std::move(known));
    std::vector<localisation::CodeObservation> seen;
    for (const auto& reading : readings_) {
        if (reading.found) seen.push_back(observation(reading));
    }
    std::vector<localisation::SurveyedCode> survey;
    for (const auto& marker : target.markers) {
        survey.push_back({marker.payload, marker.pose, marker.sigma_m, kSigmaUp_rad});
    }
    const auto fix = localisation::locate(seen, survey);
    if (!fix) return fail(fix.error());
    fix_ = *fix;
    return fleet::StopMeasurement{fix->pose, fix->sigma_xy_m, fix->sigma_heading_rad,
                                  localisation::to_string(fix->method), fix->payloads};
}

std::vector<CameraSensing::Picture> CameraSensing::pictures() const {
    std::vector<Picture> pictures;
    const auto& cameras = motion_.type().cameras;
    for (std::size_t i = 0; i < images_.size(); ++i) {
        const auto annotated = vision::annotate(
            images_[i], cameras[i], simulation::body_from_code(pictured_[i]), options_.code_size_m);
        const auto jpeg = vision::encode_jpeg(annotated, cameras[i]);
        pictures.push_back({cameras[i].name, std::string(jpeg.begin(), jpeg.end())});
    }
    return pictures;
}

}  // namespace pulseline::agent
