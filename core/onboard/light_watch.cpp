#include "core/onboard/light_watch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/square.hpp"

namespace pulseline::onboard {
namespace {

using geometry::Point2;
using localisation::IgpsFix;

// A second's worth: more is as good as what the transmitters' own places allow.
constexpr std::size_t kMostInMean = 25;
constexpr double kStandingEvery_s = 1;  // from then on: nothing changes but the light
// Poses by light that contradict the way driven, in a row and all alike: by chance there is not
// even one.
constexpr int kBelievedAfter = 5;
constexpr double kAlike_m = 0.005;
constexpr double kAlike_rad = 0.003;

bool alike(const geometry::Pose2& a, const geometry::Pose2& b) {
    return distance(a.position(), b.position()) <= kAlike_m &&
           std::abs(wrap(a.heading_rad - b.heading_rad)) <= kAlike_rad;
}

}  // namespace

LightWatch::LightWatch(Receivers& receivers, const Drive& drive, PoseEstimate& estimate,
                       const OdometryTrail& trail, const localisation::ReceiverErrors& errors)
    : receivers_(receivers), drive_(drive), estimate_(estimate), trail_(trail), errors_(errors) {}

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
    blur(seen->fix);
    if (located) correct(*seen);
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

/// Stamps of receivers and wheels do not quite agree, and meanwhile the vehicle drives.
void LightWatch::blur(localisation::PoseFix& fix) const {
    const kinematics::Twist twist = drive_.twist();
    const Point2 off =
        geometry::Pose2{0, 0, fix.pose.heading_rad} * Point2{twist.vx_mps, twist.vy_mps};
    const Eigen::Vector3d error = errors_.clock_s / drive_.time_factor() *
                                  Eigen::Vector3d(off.x_m, off.y_m, twist.turn_radps);
    set_covariance(fix, localisation::matrix(fix.covariance) + error * error.transpose());
}

/// Of the way that the wheels have told since the sheets passed.
Eigen::Matrix3d LightWatch::odometry_since(double heading_rad) const {
    const kinematics::Twist twist = drive_.twist();
    const double way_m =
        std::hypot(twist.vx_mps, twist.vy_mps) / drive_.time_factor() * seen_ago_s_;
    const auto& noise = estimate_.noise();
    const Eigen::Vector3d variance(square(noise.forward_m_per_sqrt_m) * way_m,
                                   square(noise.left_m_per_sqrt_m) * way_m,
                                   square(noise.heading_rad_per_sqrt_m) * way_m);
    const Eigen::AngleAxisd turned(heading_rad, Eigen::Vector3d::UnitZ());
    return turned.toRotationMatrix() * variance.asDiagonal() *
           turned.toRotationMatrix().transpose();
}

void LightWatch::correct(const IgpsFix& seen) {
    if (estimate_.see(seen, odometry_since(seen.fix.pose.heading_rad))) {
        refused_ = 0;
        return;
    }
    // The way driven since moves both alike, so that the same contradiction stays the same.
    const geometry::Pose2 off = inverse(estimate_.pose()) * seen.fix.pose;
    refused_ = refused_ > 0 && alike(off, refused_by_) ? refused_ + 1 : 1;
    refused_by_ = off;
    if (refused_ < kBelievedAfter) return;
    estimate_.restart_at(seen);
    since_standing_.clear();
    refused_ = 0;
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
