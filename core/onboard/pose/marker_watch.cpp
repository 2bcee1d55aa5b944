#include "core/onboard/pose/marker_watch.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::onboard {
namespace {

// Of a camera's foot from a code: farther than a view is wide and a fine step long.
constexpr double kSoon_m = 0.4;
// What the pose that the drive steers by is moved by at most: less than what its tracker takes for
// a path error of its own, so that it neither jerks nor stops for it.
constexpr double kLead_mps = 0.05;
// At rest noise is not worth a report.
constexpr double kRest_m = 0.005;
constexpr double kRest_rad = 0.002;
// What a person errs by; where senses contradict by more, somebody has to look.
constexpr double kErrs_m = 0.2;
constexpr double kErrs_rad = 0.175;
constexpr double kLead_radps = 0.02;

}  // namespace

MarkerWatch::MarkerWatch(WaySensing& sensing, Drive& drive, PoseEstimate& estimate)
    : sensing_(sensing),
      drive_(drive),
      estimate_(estimate),
      trail_(drive),
      segments_(drive.type()) {}

void MarkerWatch::step(double dt_s, const std::deque<vda5050::OrderEdge>& ahead) {
    const double own_s = dt_s * drive_.time_factor();
    trail_.step(own_s);
    expect(ahead);
    const auto taken_before = static_cast<std::ptrdiff_t>(taken_.size());
    for (const auto& reading : sensing_.look_below(expected_, estimate_.pose(), own_s)) {
        take(reading);
    }
    const std::span<const std::string> taken(taken_.begin() + taken_before, taken_.end());
    segments_.step(ahead, taken, std::abs(drive_.velocity_mps()) * dt_s, estimate_.sigma_xy_m());
    if (!ahead.empty() && !drive_.standing()) lead_drive(own_s);
}

/// Of this edge and the next one, those near a camera. Each counts once while it is near: what the
/// camera's calibration does to a code is the same in every picture of it.
void MarkerWatch::expect(const std::deque<vda5050::OrderEdge>& ahead) {
    expected_.clear();
    std::vector<std::string> still_near;
    const Pose2 body = estimate_.pose();
    for (std::size_t i = 0; i < std::min<std::size_t>(2, ahead.size()); ++i) {
        for (const auto& action : ahead[i].actions) {
            for (const auto& marker : action.markers) {
                const auto& cameras = drive_.type().cameras;
                const bool near = std::any_of(cameras.begin(), cameras.end(), [&](const auto& c) {
                    const auto foot = body * c.body_from_camera.position();
                    return distance(foot, marker.pose.position()) <= kSoon_m;
                });
                if (!near) continue;
                const bool known = std::ranges::find(read_, marker.payload) != read_.end();
                if (known) still_near.push_back(marker.payload);
                if (!known && !drive_.standing()) expected_.push_back(marker);
            }
        }
    }
    read_ = std::move(still_near);
}

/// Where the code lies seen from the body now: the vehicle has driven on since the exposure.
void MarkerWatch::take(const WayReading& reading) {
    if (!(reading.age_s >= 0 && reading.age_s <= OdometryTrail::kRemembered_s)) {
        mistimed_ = reading.marker.payload;
        estimate_.fixes().refused(PoseSource::kCodes, mistimed_, "code_mistimed");
        return;
    }
    if (!trail_.remembers(reading.age_s)) return;  // it has stood since, or was told its place
    if (std::ranges::find(read_, reading.marker.payload) != read_.end()) return;
    read_.push_back(reading.marker.payload);
    if (reading.seen.payload != reading.marker.payload) {
        refused_ = reading.seen.payload;
        refused_by_.clear();
        estimate_.fixes().refused(PoseSource::kCodes, refused_, "other_code");
        return;
    }
    const Pose2 code = trail_.now_from_then(reading.age_s) *
                       Pose2{reading.seen.centre.x_m, reading.seen.centre.y_m, reading.seen.up_rad};
    localisation::CodeObservation seen = reading.seen;
    seen.centre = code.position();
    seen.up_rad = code.heading_rad;
    const localisation::SurveyedCode survey{reading.marker.payload, reading.marker.pose,
                                            reading.marker.sigma_m, reading.marker.sigma_rad};
    if (const Status read = estimate_.see(seen, survey); read) {
        taken_.push_back(reading.marker.payload);
        refused_.clear();
        mistimed_.clear();
    } else {
        refused_ = reading.marker.payload;
        refused_by_ = read.error().reason.params;
    }
}

bool MarkerWatch::has_to_lead() const {
    const Pose2 off = inverse(trail_.believed()) * estimate_.pose();
    const double off_m = norm(off.position());
    const double turned_rad = std::abs(off.heading_rad);
    if (off_m < kRest_m && turned_rad < kRest_rad) return false;
    return off_m <= kErrs_m && turned_rad <= kErrs_rad;
}

void MarkerWatch::lead_at_rest(double dt_s) {
    if (has_to_lead()) lead_drive(dt_s * drive_.time_factor());
}

void MarkerWatch::lead_drive(double own_s) {
    const Pose2 off = inverse(trail_.believed()) * estimate_.pose();
    const double off_m = norm(off.position());
    const double share = off_m > 0 ? std::min(1.0, kLead_mps * own_s / off_m) : 0;
    const double turn_rad = std::clamp(off.heading_rad, -kLead_radps * own_s, kLead_radps * own_s);
    if (share * off_m == 0 && turn_rad == 0) return;
    const Pose2 led = trail_.believed() * Pose2{share * off.x_m, share * off.y_m, turn_rad};
    drive_.set_believed(led);
    estimate_.led_to(led);
    trail_.led_to(led);
}

}  // namespace pulseline::onboard
