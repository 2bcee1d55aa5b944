#include <algorithm>
#include <array>
#include <cmath>

#include "core/control/braking.hpp"
#include "core/control/dynamic_window.hpp"

namespace pulseline::control {
namespace {

// A differential vehicle drives while the target lies ahead more than so many times aside.
constexpr double kAheadOfAside = 2;

/// Candidate values of one axis: evenly over the window, and special ones where they lie in it.
class Axis {
public:
    Axis(double from, double to, int count) : from_(from), to_(to) {
        for (int i = 0; i < count; ++i) add(from + (to - from) * i / (count - 1));
    }
    void add_if_inside(double value) {
        if (value > from_ && value < to_) add(value);
    }
    const double* begin() const { return values_.data(); }
    const double* end() const { return values_.data() + count_; }

private:
    void add(double value) { values_[count_++] = value; }

    double from_;
    double to_;
    std::array<double, 16> values_;
    std::size_t count_ = 0;
};

}  // namespace

void DynamicWindow::sample_differential(const WindowInput& input) {
    const double accel = type_.max_accel_mps2;
    const double dv = accel * input.dt_s;
    const double dw = type_.max_turn_accel_radps2 * input.dt_s;
    const Point2 to = body_from_target_.position();
    const double bearing_rad = std::atan2(to.y_m, to.x_m);
    const double turn_rad = in_tolerance_ ? body_from_target_.heading_rad
                            : to.x_m >= 0 ? bearing_rad
                                          : wrap(bearing_rad + kPi);
    const double ahead_m = std::max(0.0, std::abs(to.x_m) - kAheadOfAside * std::abs(to.y_m));

    Axis turns(input.present.turn_radps - dw, input.present.turn_radps + dw, 11);
    turns.add_if_inside(0);
    turns.add_if_inside(turn_that_ends(turn_rad, input.present.turn_radps, input.dt_s));
    if (in_tolerance_) {
        const double v = towards_zero(input.present.vx_mps, dv);
        for (const double w : turns) offer(input, {v, 0, w});
        return;
    }
    Axis speeds(input.present.vx_mps - dv, input.present.vx_mps + dv, 11);
    speeds.add_if_inside(0);
    speeds.add_if_inside(std::copysign(rate_that_ends(ahead_m, accel, input.dt_s), to.x_m));
    speeds.add_if_inside(std::copysign(top_speed_mps_, to.x_m));
    for (const double v : speeds) {
        const double way_m = way_to_rest(v, accel, input.dt_s);
        if (std::abs(way_m) > (way_m * to.x_m > 0 ? ahead_m : 0) + kRounding) continue;
        for (const double w : turns) offer(input, {v, 0, w});
    }
    for (const double w : turns) offer(input, {towards_zero(input.present.vx_mps, dv), 0, w});
}

void DynamicWindow::sample_sideways(const WindowInput& input) {
    const double accel = type_.max_accel_mps2;
    const double dw = type_.max_turn_accel_radps2 * input.dt_s;
    Axis turns(input.present.turn_radps - dw, input.present.turn_radps + dw, 5);
    turns.add_if_inside(0);
    turns.add_if_inside(
        turn_that_ends(body_from_target_.heading_rad, input.present.turn_radps, input.dt_s));
    if (in_tolerance_) {
        const Twist stopping = braked(input.present, input.dt_s);
        for (const double w : turns) offer(input, {stopping.vx_mps, stopping.vy_mps, w});
        return;
    }
    // Along the way to the target and across it: a square inside the circle of the acceleration.
    const double dv = accel * input.dt_s / std::sqrt(2.0);
    const Point2 ahead = (1 / d_tar_m_) * body_from_target_.position();
    const Point2 present{input.present.vx_mps, input.present.vy_mps};
    const double along = dot(ahead, present);
    const double across = cross(ahead, present);
    Axis alongs(along - dv, along + dv, 5);
    alongs.add_if_inside(0);
    alongs.add_if_inside(rate_that_ends(d_tar_m_, accel, input.dt_s));
    alongs.add_if_inside(top_speed_mps_);
    Axis acrosses(across - dv, across + dv, 3);
    acrosses.add_if_inside(0);
    for (const double v : alongs) {
        for (const double side : acrosses) {
            const Point2 velocity = v * ahead + side * Point2{-ahead.y_m, ahead.x_m};
            const double way_m = way_to_rest(norm(velocity), accel, input.dt_s);
            if (way_m > d_tar_m_ + kRounding) continue;  // eq. 14: it could not stop in time
            for (const double w : turns) offer(input, {velocity.x_m, velocity.y_m, w});
        }
    }
}

void DynamicWindow::offer(const WindowInput& input, const Twist& twist) {
    const double speed = std::hypot(twist.vx_mps, twist.vy_mps);
    if (!samples_.empty()) {  // the first one brakes, whatever the limits
        if (speed > top_speed_mps_ + kRounding ||
            std::abs(twist.turn_radps) > type_.max_turn_rate_radps) {
            return;
        }
        const double fastest = std::abs(twist.vx_mps) + std::abs(twist.vy_mps) +
                               std::abs(twist.turn_radps) * most_lever_m_;
        if (fastest > type_.max_speed_mps && kinematics::within_limits(type_, twist) != twist) {
            return;
        }
    }
    Sample sample;
    sample.twist = twist;
    sample.rest = rest_of(twist, input.dt_s);
    sample.angle = angle_term(sample.rest, twist);
    sample.speed = speed / top_speed_mps_;
    const double left_m = geometry::distance(sample.rest.position(), body_from_target_.position());
    sample.target = std::cos(kPi / 2 * std::min(1.0, left_m / d_tar0_m_));
    samples_.push_back(sample);
}

double DynamicWindow::angle_term(const Pose2& rest, const Twist& twist) const {
    if (sideways_ || in_tolerance_) {
        return 1 - std::abs(wrap(body_from_target_.heading_rad - rest.heading_rad)) / kPi;
    }
    const Point2 left = body_from_target_.position() - rest.position();
    const double off_rad = std::abs(wrap(std::atan2(left.y_m, left.x_m) - rest.heading_rad));
    if (twist.vx_mps > 0) return 1 - off_rad / kPi;
    if (twist.vx_mps < 0) return off_rad / kPi;
    return 1 - std::min(off_rad, kPi - off_rad) / kPi;
}

/// Driven for a step, then braked; an arc where it turns meanwhile.
Pose2 DynamicWindow::rest_of(const Twist& twist, double dt_s) const {
    const double speed = std::hypot(twist.vx_mps, twist.vy_mps);
    const double time_s = dt_s + speed / (2 * type_.max_accel_mps2);
    const double turn_rad = way_to_rest(twist.turn_radps, type_.max_turn_accel_radps2, dt_s);
    const Point2 chord{time_s * twist.vx_mps, time_s * twist.vy_mps};
    const double c = std::cos(turn_rad / 2);
    const double s = std::sin(turn_rad / 2);
    return {c * chord.x_m - s * chord.y_m, s * chord.x_m + c * chord.y_m, turn_rad};
}

double DynamicWindow::turn_that_ends(double turn_rad, double present_radps, double dt_s) const {
    const double rate = rate_that_ends(std::abs(turn_rad), type_.max_turn_accel_radps2, dt_s);
    const double most = std::min(rate, type_.max_turn_rate_radps);
    const double dw = type_.max_turn_accel_radps2 * dt_s;
    return std::clamp(std::copysign(most, turn_rad), present_radps - dw, present_radps + dw);
}

Twist DynamicWindow::braked(const Twist& present, double dt_s) const {
    const double speed = std::hypot(present.vx_mps, present.vy_mps);
    const double share = speed > 0 ? std::max(0.0, 1 - type_.max_accel_mps2 * dt_s / speed) : 0.0;
    const double turn = towards_zero(present.turn_radps, type_.max_turn_accel_radps2 * dt_s);
    return {share * present.vx_mps, share * present.vy_mps, turn == 0 ? 0 : turn};
}

}  // namespace pulseline::control
