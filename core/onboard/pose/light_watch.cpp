#include "core/onboard/pose/light_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pulseline::onboard {
namespace {

using geometry::Point2;
using localisation::IgpsFix;

// A second's worth: more is as good as what the transmitters' own places allow.
constexpr std::size_t kMostInMean = 25;
constexpr double kStandingEvery_s = 1;  // from then on: nothing changes but the light

}  // namespace

LightWatch::LightWatch(Receivers& receivers, const Drive& drive, PoseEstimate& estimate,
                       const OdometryTrail& trail, const localisation::ReceiverErrors& errors)
    : receivers_(receivers),
      drive_(drive),
      estimate_(estimate),
      trail_(trail),
      correction_(drive, estimate, errors.clock_s),
      errors_(errors) {}

void LightWatch::step(double dt_s, const std::vector<plant::Transmitter>& transmitters,
                      bool located) {
    waited_s_ += dt_s * drive_.time_factor();
    if (!drive_.standing()) since_standing_.clear();
    if (since_standing_.size() == kMostInMean && waited_s_ < kStandingEvery_s) return;
    const auto pulses = receivers_.take_pulses(std::exchange(waited_s_, 0));
    if (!pulses.empty() && !transmitters.empty()) take(pulses, transmitters, located);
}

void LightWatch::take(const std::vector<ReceiverPulses>& pulses,
                      const std::vector<plant::Transmitter>& transmitters, bool located) {
    const auto light = light_of(pulses);
    auto places = localisation::locate_receivers(light, transmitters);
    tell(light, places);
    auto seen = localisation::fit_receivers(std::move(places), transmitters,
                                            drive_.type().receivers, errors_);
    if (!seen) {
        newest_.reset();
        since_standing_.clear();
        why_not_ = seen.error();
        return;
    }
    why_not_.reset();
    correction_.blur(seen->fix);
    if (located && correction_.take(*seen, seen_ago_s_) == BeaconCorrection::Taken::kBegunAnew)
        since_standing_.clear();
    if (drive_.standing() && since_standing_.size() < kMostInMean) since_standing_.push_back(*seen);
    newest_ = std::move(*seen);
}

std::vector<localisation::ReceiverLight> LightWatch::light_of(
    const std::vector<ReceiverPulses>& pulses) {
    std::vector<localisation::ReceiverLight> light;
    double ago_s = 0;
    int sheets = 0;
    for (const ReceiverPulses& seen : pulses) {
        const auto& known = drive_.type().receivers;
        const auto receiver = std::ranges::find(known, seen.receiver, &plant::Receiver::name);
        if (receiver == known.end()) continue;
        light.push_back({seen.receiver, {}});
        for (const auto& turn : seen.turns) {
            auto angles = localisation::feature_angles(turn);
            if (!angles) continue;
            const double oldest_s = -std::min(turn.first_s, turn.second_s);
            if (!drive_.standing() && !trail_.remembers(oldest_s)) continue;
            angles->way_first = way_since(*receiver, turn.first_s);
            angles->way_second = way_since(*receiver, turn.second_s);
            light.back().light.push_back(std::move(*angles));
            ago_s -= turn.first_s + turn.second_s;
            sheets += 2;
        }
    }
    if (sheets > 0) seen_ago_s_ = std::max(0.0, ago_s / sheets);
    return light;
}

Point2 LightWatch::way_since(const plant::Receiver& receiver, double pulse_s) const {
    if (drive_.standing()) return {};
    const Point2 then = trail_.now_from_then(std::max(0.0, -pulse_s)) * receiver.position;
    const geometry::Pose2 turned{0, 0, estimate_.pose().heading_rad};
    return turned * (receiver.position - then);
}

void LightWatch::tell(const std::vector<localisation::ReceiverLight>& light,
                      const std::vector<localisation::ReceiverResult>& results) {
    readings_.clear();
    for (std::size_t i = 0; i < light.size(); ++i) {
        vda5050::ReceiverReading reading;
        reading.receiver = light[i].receiver;
        for (const auto& angles : light[i].light) {
            reading.transmitters.push_back(angles.transmitter.str());
        }
        const auto& fix = results[i].fix;
        reading.found = fix.has_value();
        if (fix) {
            reading.place = {fix->position.x(), fix->position.y()};
            reading.z_m = fix->position.z();
            reading.sigma_m = std::sqrt(fix->covariance.topLeftCorner<2, 2>().trace() / 2);
        } else {
            reading.why_not = fix.error().reason.code;
        }
        readings_.push_back(std::move(reading));
    }
}

std::optional<IgpsFix> LightWatch::mean() const {
    if (since_standing_.empty()) return newest_;
    IgpsFix mean = since_standing_.back();
    const geometry::Pose2 near = mean.fix.pose;
    const auto share = 1 / static_cast<double>(since_standing_.size());
    geometry::Pose2 off;
    for (const IgpsFix& one : since_standing_) {
        off.x_m += share * (one.fix.pose.x_m - near.x_m);
        off.y_m += share * (one.fix.pose.y_m - near.y_m);
        off.heading_rad += share * wrap(one.fix.pose.heading_rad - near.heading_rad);
    }
    mean.fix.pose = {near.x_m + off.x_m, near.y_m + off.y_m,
                     wrap(near.heading_rad + off.heading_rad)};
    const Eigen::Matrix3d lasting = localisation::matrix(mean.lasting);
    set_covariance(mean.fix,
                   lasting + share * (localisation::matrix(mean.fix.covariance) - lasting));
    return mean;
}

}  // namespace pulseline::onboard
