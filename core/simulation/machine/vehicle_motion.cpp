#include "core/simulation/machine/vehicle_motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace pulseline::simulation {
namespace {

using geometry::Point2;

constexpr double kNoMove = 1e-6;     // metres or radians that count as none
constexpr double kSubstep_s = 0.02;  // of the vehicle's own, not accelerated, time
constexpr double kConverge_m = 1.0;  // way over which a path deviation falls to 1/e
constexpr double kConverge_rad = 0.1;
constexpr double kFineMove_m = 0.01;  // a usual one

}  // namespace

localisation::OdometryNoise odometry_noise(const MotionErrors& errors) {
    localisation::OdometryNoise noise;
    noise.forward_m_per_sqrt_m = noise.left_m_per_sqrt_m = errors.slip_m_per_sqrt_m;
    noise.heading_rad_per_sqrt_m = errors.heading_rad_per_sqrt_m;
    // Its scale of turns is a constant that codes under way do not show.
    noise.heading_rad_per_sqrt_rad =
        std::hypot(errors.heading_rad_per_sqrt_rad, errors.turn_scale * std::sqrt(kPi));
    noise.sideways_m_per_sqrt_m = noise.sideways_rad_per_sqrt_m = 0;
    noise.scale = errors.distance_scale;
    noise.crab_rad = errors.steering_bias_rad;
    noise.bend_rad_per_m = noise.slope_scale = noise.slope_crab_rad = 0;
    noise.fine_m = std::hypot(errors.fine_m, errors.fine_offset_m, errors.fine_scale * kFineMove_m);
    noise.fine_rad = std::hypot(errors.fine_rad, errors.fine_offset_rad);
    noise.settle_m = errors.settle_m;
    noise.settle_rad = errors.settle_rad;
    return noise;
}

VehicleMotion::VehicleMotion(plant::VehicleType type, const Pose2& true_pose, std::uint64_t seed,
                             double time_factor, const MotionErrors& errors)
    : type_(std::move(type)),
      time_factor_(time_factor),
      errors_(errors),
      random_(seed),
      true_(true_pose),
      believed_(true_pose),
      reference_(type_, time_factor) {
    distance_scale_ = normal(errors_.distance_scale);
    turn_scale_ = normal(errors_.turn_scale);
    steering_bias_rad_ = normal(errors_.steering_bias_rad);
    for (std::size_t k = 0; k < fine_.size(); ++k) {
        fine_[k].scale = 1 + normal(errors_.fine_scale);
        fine_[k].offset = normal(k == 2 ? errors_.fine_offset_rad : errors_.fine_offset_m);
    }
}

/// No move comes to less than nothing.
double VehicleMotion::FineError::share_of(double size) const {
    if (std::abs(size) <= kNoMove) return 1;
    return std::max(0.0, scale + offset / std::abs(size));
}

void VehicleMotion::append(const kinematics::Segment& segment, double max_speed_mps) {
    reference_.append(segment, max_speed_mps);
}

void VehicleMotion::correct(std::span<const kinematics::Segment> moves) {
    assert(idle());
    fine_shares_.clear();
    for (const auto& move : moves) {
        reference_.append_fine(move);
        const double length_m = std::abs(move.length_m);
        fine_shares_.push_back({fine_[0].share_of(length_m * std::cos(move.direction_rad)),
                                fine_[1].share_of(length_m * std::sin(move.direction_rad)),
                                fine_[2].share_of(move.turn_rad)});
    }
}

void VehicleMotion::set_believed(const Pose2& pose) {
    if (reference_.steered()) reference_.shift(pose * inverse(believed_));
    believed_ = pose;
}

void VehicleMotion::step(double dt_s) {
    // Fine enough in the vehicle's own time, however much faster than that it runs.
    const int substeps = std::max(1, static_cast<int>(std::ceil(dt_s * time_factor_ / kSubstep_s)));
    for (int i = 0; i < substeps && !reference_.empty(); ++i) {
        for (const auto& passed : reference_.step(dt_s / substeps)) take(passed);
    }
}

void VehicleMotion::take(const onboard::PathReference::Passed& passed) {
    if (passed.way > 0) displace(passed);
    if (passed.fine && passed.finished) {
        fine_shares_.pop_front();
        true_ =
            true_ * (passed.on_the_spot ? Pose2{0, 0, normal(errors_.fine_rad)}
                                        : Pose2{normal(errors_.fine_m), normal(errors_.fine_m), 0});
    }
    rests_ += passed.rests;
    const bool gentle = passed.finished && (passed.fine || passed.on_the_spot);
    if (passed.rests && !gentle) settle(passed.peak_rate);
}

/// Moves the believed pose along the path, steering out its deviation from it, and the true pose by
/// the same motion with the vehicle's errors.
void VehicleMotion::displace(const onboard::PathReference::Passed& passed) {
    const Pose2& from = passed.from;
    const Pose2& to = passed.to;
    const Pose2 driven = believed_ * (inverse(from) * to);

    const double gain =
        1 - std::exp(-passed.way / (passed.on_the_spot ? kConverge_rad : kConverge_m));
    Pose2 next = driven;
    if (!passed.on_the_spot) {
        next.x_m += gain * (to.x_m - driven.x_m);
        next.y_m += gain * (to.y_m - driven.y_m);
    }
    next.heading_rad = wrap(driven.heading_rad + gain * wrap(to.heading_rad - driven.heading_rad));

    Pose2 motion = inverse(believed_) * next;
    believed_ = next;
    if (passed.fine) {
        const auto [ahead, sideways, turned] = fine_shares_.front();
        true_ =
            true_ * Pose2{ahead * motion.x_m, sideways * motion.y_m, turned * motion.heading_rad};
        return;
    }
    const double way_m = norm(motion.position());
    const double root_m = std::sqrt(way_m);
    const Point2 slip{normal(errors_.slip_m_per_sqrt_m) * root_m,
                      normal(errors_.slip_m_per_sqrt_m) * root_m};
    const double wander_rad =
        normal(errors_.heading_rad_per_sqrt_m) * root_m +
        normal(errors_.heading_rad_per_sqrt_rad) * std::sqrt(std::abs(motion.heading_rad));
    const Pose2 steered =
        Pose2{0, 0, steering_bias_rad_} *
        Pose2{motion.x_m * (1 + distance_scale_), motion.y_m * (1 + distance_scale_), 0};
    true_ = true_ * Pose2{steered.x_m + slip.x_m, steered.y_m + slip.y_m,
                          motion.heading_rad * (1 + turn_scale_) + wander_rad};
}

/// Braking shakes the platform a little, the more the faster it was.
void VehicleMotion::settle(double peak_rate) {
    const double share = std::min(1.0, peak_rate / (type_.max_speed_mps * time_factor_));
    true_ = true_ * Pose2{share * normal(errors_.settle_m), share * normal(errors_.settle_m),
                          share * normal(errors_.settle_rad)};
}

}  // namespace pulseline::simulation
