#include "server/agent/camera_sensing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/kinematics/past_poses.hpp"
#include "core/localisation/codes_on_way.hpp"
#include "core/onboard/code_reading.hpp"
#include "core/simulation/world/true_camera.hpp"
#include "core/vision/optics/camera_picture.hpp"
#include "server/agent/hall_truth.hpp"

namespace pulseline::agent {
namespace {

using simulation::FloorCode;

// Under way: pictures are read within the time that bench_vision measures and a bus adds, and
// stamped by a clock that is not the wheels'.
constexpr double kReadSoonest_s = 0.02;
constexpr double kReadLatest_s = 0.08;
constexpr double kClockSigma_s = 5e-4;
// Nothing is exposed for a code that would be cut by more than this at the picture's border.
constexpr double kBeside_m = 0.01;

/// Of a point of the body, in the body frame and the vehicle's own time.
geometry::Point2 velocity_at(const onboard::Drive& drive, geometry::Point2 point) {
    const kinematics::Twist twist = drive.twist();
    const double share = 1 / drive.time_factor();
    return {share * (twist.vx_mps - twist.turn_radps * point.y_m),
            share * (twist.vy_mps + twist.turn_radps * point.x_m)};
}

/// The vehicle's motion in so much of its own time, as it takes it to be; 0 is where it is.
geometry::Pose2 driven_in(const onboard::Drive& drive, double own_s) {
    const kinematics::Twist twist = drive.twist();
    const double share = own_s / drive.time_factor();
    return {share * twist.vx_mps, share * twist.vy_mps, share * twist.turn_radps};
}

}  // namespace

CameraSensing::CameraSensing(const simulation::World& world, const plant::HallId& hall,
                             const simulation::SimulatedDrive& motion, bool rendered,
                             std::uint64_t seed, bool loaded)
    : world_(world),
      hall_(hall),
      motion_(motion),
      random_(seed),
      actual_(motion.type().cameras),
      since_frame_s_(actual_.size()),
      true_at_look_(motion.true_pose()) {
    options_.mode = rendered ? simulation::Sensing::kRendered : simulation::Sensing::kAnalytic;
    options_.errors = world.errors;
    options_.loaded = loaded;
    options_.look = motion.type().usual_code;
    for (auto& camera : actual_) {
        camera = simulation::true_camera(camera, world.errors.camera, loaded, random_);
    }
}

std::vector<FloorCode> CameraSensing::codes_below() const {
    if (covered_) return {};
    return codes_around(world_, hall_, motion_.true_pose(),
                        options_.mode == simulation::Sensing::kRendered);
}

void CameraSensing::look() { look_expecting(std::nullopt); }

void CameraSensing::look_expecting(std::optional<simulation::KnownFloor> known) {
    options_.dark = dark_;
    const auto codes = codes_below();
    options_.known = std::move(known);
    auto view = simulation::sense_stop(actual_, motion_.type().cameras, motion_.true_pose(), codes,
                                       options_, random_);
    readings_ = std::move(view.readings);
    images_ = std::move(view.images);
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
    const auto fix = onboard::locate_stop(readings_, target, options_.errors);
    if (!fix) return fail(fix.error());
    fix_ = *fix;
    return onboard::measurement_of(*fix);
}

std::vector<onboard::WayReading> CameraSensing::look_below(
    std::span<const vda5050::SurveyedMarker> expected, const geometry::Pose2& hall_from_body,
    double own_s) {
    for (OnTheWay& reading : on_the_way_) reading.reading.age_s += own_s;
    const auto true_before = std::exchange(true_at_look_, motion_.true_pose());
    const auto& cameras = motion_.type().cameras;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        // A camera's clock runs on whatever steps the vehicle's time goes in.
        const double frame_s = 1 / cameras[i].frame_rate_hz;
        since_frame_s_[i] += own_s;
        if (since_frame_s_[i] < frame_s) continue;
        const double late_s = since_frame_s_[i] = std::fmod(since_frame_s_[i], frame_s);
        if (expected.empty() || late_s > own_s) continue;
        expose(i, expected,
               {late_s, kinematics::part_way(motion_.true_pose(), true_before, late_s / own_s),
                hall_from_body * driven_in(motion_, -late_s)});
    }
    std::vector<onboard::WayReading> ready;
    std::erase_if(on_the_way_, [&](OnTheWay& reading) {
        if (reading.reading.age_s < reading.ready_s) return false;
        ready.push_back(std::move(reading.reading));
        return true;
    });
    return ready;
}

void CameraSensing::expose(std::size_t camera, std::span<const vda5050::SurveyedMarker> expected,
                           const Exposure& at) {
    const plant::Camera& calibrated = motion_.type().cameras[camera];
    const auto foot = at.believed * calibrated.body_from_camera.position();
    const auto off_m = [&](const vda5050::SurveyedMarker& marker) {
        return distance(foot, marker.pose.position());
    };
    const auto& marker = *std::ranges::min_element(expected, {}, off_m);
    const double within_m = localisation::view_radius_m(calibrated, marker.size_m) + kBeside_m;
    const auto kind = plant::parse_marker_kind(marker.kind);
    if (!kind || off_m(marker) > within_m) return;
    const auto velocity = velocity_at(motion_, calibrated.body_from_camera.position());
    const double exposure_s = calibrated.exposure_s;
    simulation::SensingOptions options = options_;
    options.dark = dark_;
    options.known = simulation::KnownFloor{at.believed, {{marker.pose, {*kind, marker.size_m}}}};
    options.smear_m =
        geometry::Pose2{0, 0, -calibrated.body_from_camera.heading_rad} * (exposure_s * velocity);
    const auto codes = codes_below();
    const auto view =
        simulation::sense_stop(std::span(&actual_[camera], 1), std::span(&calibrated, 1),
                               at.true_pose, codes, options, random_);
    const auto& seen = view.readings.front();
    if (!seen.found) return;
    std::normal_distribution<double> clock(0, kClockSigma_s);
    const double smear_m = norm(velocity) * std::hypot(exposure_s, kClockSigma_s);
    OnTheWay read;
    read.reading.marker = marker;
    read.reading.seen = {seen.payload, seen.code, seen.angle_rad, std::hypot(seen.sigma_m, smear_m),
                         localisation::code_sigma_rad(options_.errors, 0)};
    read.reading.age_s = at.ago_s + clock(random_);
    read.ready_s = std::uniform_real_distribution<double>(kReadSoonest_s, kReadLatest_s)(random_);
    on_the_way_.push_back(std::move(read));
}

std::vector<CameraSensing::Picture> CameraSensing::pictures() const {
    std::vector<Picture> pictures;
    const auto& cameras = motion_.type().cameras;
    for (std::size_t i = 0; i < images_.size(); ++i) {
        const auto jpeg = vision::encode_jpeg(images_[i], cameras[i]);
        pictures.push_back({cameras[i].name, std::string(jpeg.begin(), jpeg.end())});
    }
    return pictures;
}

}  // namespace pulseline::agent
