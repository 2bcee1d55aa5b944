#include "core/control/dynamic_window.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "core/control/manoeuvre.hpp"

namespace pulseline::control {
namespace {

constexpr std::size_t kMostSamples = 256;
constexpr double kCorridorSpacing_m = 0.02;
// Enters the tolerance a little inside it, so that noise does not drive it out again.
constexpr double kEnter = 0.7;
// A differential vehicle drives while the target lies ahead more than so many times aside.
constexpr double kAheadOfAside = 2;
constexpr double kStill_mps = 1e-3;
constexpr double kStill_radps = 1e-3;
constexpr double kRounding = 1e-9;

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

/// The greatest rate from which a way still suffices: rate dt + rate^2 / 2a <= way.
double rate_that_ends(double way, double accel, double dt_s) {
    return accel * (std::sqrt(dt_s * dt_s + 2 * way / accel) - dt_s);
}

double way_to_rest(double rate, double accel, double dt_s) {
    return rate * dt_s + rate * std::abs(rate) / (2 * accel);
}

double towards_zero(double rate, double by) {
    return std::copysign(std::max(0.0, std::abs(rate) - by), rate);
}

/// Brings a term of the samples to [0, 1]; all alike: 0.
class Spread {
public:
    void see(double value) {
        least_ = std::min(least_, value);
        most_ = std::max(most_, value);
    }
    double operator()(double value) const {
        return most_ - least_ > 1e-12 ? (value - least_) / (most_ - least_) : 0;
    }

private:
    double least_ = std::numeric_limits<double>::infinity();
    double most_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

DynamicWindow::DynamicWindow(plant::VehicleType type, const DynamicWindowOptions& options)
    : type_(std::move(type)),
      options_(options),
      sideways_(moves_sideways(type_)),
      top_speed_mps_(std::min(options.top_speed_mps, type_.max_speed_mps)),
      ring_(type_.footprint) {
    assert(top_speed_mps_ > 0 && type_.max_accel_mps2 > 0 && type_.max_turn_rate_radps > 0 &&
           type_.max_turn_accel_radps2 > 0);
    for (const plant::Wheel& wheel : type_.wheels) {
        most_lever_m_ =
            std::max(most_lever_m_, std::abs(wheel.position.x_m) + std::abs(wheel.position.y_m));
    }
    samples_.reserve(kMostSamples);
}

void DynamicWindow::set_corridor(const geometry::Polygon& corridor) {
    corridor_.clear();
    for (std::size_t i = 0; i < corridor.size(); ++i) {
        const Point2 from = corridor[i];
        const Point2 way = corridor[(i + 1) % corridor.size()] - from;
        const int pieces = 1 + static_cast<int>(norm(way) / kCorridorSpacing_m);
        for (int k = 0; k < pieces; ++k) {
            corridor_.push_back(from + (static_cast<double>(k) / pieces) * way);
        }
    }
}

bool DynamicWindow::is_in_window(const Twist& from, const Twist& to, double dt_s) const {
    return std::hypot(to.vx_mps - from.vx_mps, to.vy_mps - from.vy_mps) <=
               type_.max_accel_mps2 * dt_s + kRounding &&
           std::abs(to.turn_radps - from.turn_radps) <=
               type_.max_turn_accel_radps2 * dt_s + kRounding;
}

WindowCommand DynamicWindow::step(const WindowInput& input) {
    assert(input.dt_s > 0);
    begin_step(input);
    const Twist stopping = braked(input.present, input.dt_s);
    const bool turned = std::abs(body_from_target_.heading_rad) <= options_.tolerance_rad;
    if (in_tolerance_ && turned) {
        const bool still = stopping == Twist{};
        return {stopping, still ? WindowCommand::State::kReached : WindowCommand::State::kDriving,
                std::nullopt};
    }
    gather_obstacles(input);
    samples_.clear();
    offer(input, stopping);
    if (sideways_) {
        sample_sideways(input);
    } else {
        sample_differential(input);
    }
    weigh_obstacles();

    const Twist chosen = best(true)->twist;
    const Sample* wanted = best(false);
    const bool stands = std::hypot(chosen.vx_mps, chosen.vy_mps) < kStill_mps &&
                        std::abs(chosen.turn_radps) < kStill_radps;
    if (stands && wanted->barred_by) {
        return {stopping, WindowCommand::State::kBlocked,
                ring_.places()[*wanted->barred_by].obstacle};
    }
    return {chosen, WindowCommand::State::kDriving, std::nullopt};
}

void DynamicWindow::begin_step(const WindowInput& input) {
    body_from_target_ = inverse(input.hall_from_body) * input.hall_from_target;
    d_tar_m_ = norm(body_from_target_.position());
    if (approached_ != input.hall_from_target) {
        approached_ = input.hall_from_target;
        d_tar0_m_ = options_.tolerance_m;
        in_tolerance_ = false;
    }
    d_tar0_m_ = std::max(d_tar0_m_, d_tar_m_);
    in_tolerance_ = d_tar_m_ <= (in_tolerance_ ? 1 : kEnter) * options_.tolerance_m;
}

void DynamicWindow::gather_obstacles(const WindowInput& input) {
    ring_.clear(options_.margin_m + options_.clear_m);
    for (const Point2 obstacle : input.obstacles) ring_.add(obstacle);
    if (corridor_.empty()) return;
    const Pose2 body_from_hall = inverse(input.hall_from_body);
    const double c = std::cos(body_from_hall.heading_rad);
    const double s = std::sin(body_from_hall.heading_rad);
    for (const Point2 p : corridor_) {
        ring_.add({body_from_hall.x_m + c * p.x_m - s * p.y_m,
                   body_from_hall.y_m + s * p.x_m + c * p.y_m});
    }
}

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

/// Room left by each sample, and which obstacle bars it. Most places are too far from the least
/// distance to matter to any sample, as the widest of all motions shows.
void DynamicWindow::weigh_obstacles() {
    double least_m = options_.margin_m + options_.clear_m;
    for (const auto& place : ring_.places()) least_m = std::min(least_m, place.distance_m);
    double most_way_m = 0;
    double most_turn_rad = 0;
    geometry::Box shifts{};
    geometry::Box turns{};  // along x
    for (Sample& sample : samples_) {
        const Pose2& rest = sample.rest;
        sample.distance = least_m;
        most_way_m = std::max(most_way_m, norm(rest.position()));
        most_turn_rad = std::max(most_turn_rad, std::abs(rest.heading_rad));
        shifts.min = {std::min(shifts.min.x_m, rest.x_m), std::min(shifts.min.y_m, rest.y_m)};
        shifts.max = {std::max(shifts.max.x_m, rest.x_m), std::max(shifts.max.y_m, rest.y_m)};
        turns.min.x_m = std::min(turns.min.x_m, rest.heading_rad);
        turns.max.x_m = std::max(turns.max.x_m, rest.heading_rad);
    }
    const auto most = [](double factor, double low, double high) {
        return std::max(factor * low, factor * high);
    };
    for (std::size_t i = 0; i < ring_.places().size(); ++i) {
        const ObstacleRing::Place& place = ring_.places()[i];
        const double nearer_m = most(place.away.x_m, shifts.min.x_m, shifts.max.x_m) +
                                most(place.away.y_m, shifts.min.y_m, shifts.max.y_m) +
                                place.away_blur * most_way_m;
        const double turned_m =
            most(place.lever_m, turns.min.x_m, turns.max.x_m) + place.lever_blur_m * most_turn_rad;
        const double slack_m = most_turn_rad * (place.reach_m * most_turn_rad / 2 + most_way_m);
        if (place.distance_m - nearer_m - turned_m - slack_m >
            std::max(least_m, options_.margin_m)) {
            continue;
        }
        for (Sample& sample : samples_) {
            const double after_m = ObstacleRing::distance_after(place, sample.rest);
            const bool barred =
                after_m < options_.margin_m && after_m < place.distance_m - kRounding;
            if (barred && (!sample.barred_by || after_m < sample.distance)) sample.barred_by = i;
            sample.distance = std::min(sample.distance, after_m);
        }
    }
    samples_.front().barred_by.reset();  // it brakes: nothing is safer
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

const DynamicWindow::Sample* DynamicWindow::best(bool obstacles_count) const {
    Spread angle;
    Spread distance;
    Spread speed;
    Spread target;
    const auto counts = [&](const Sample& sample) { return !obstacles_count || !sample.barred_by; };
    for (const Sample& sample : samples_) {
        if (!counts(sample)) continue;
        angle.see(sample.angle);
        distance.see(sample.distance);
        speed.see(sample.speed);
        target.see(sample.target);
    }
    const Sample* best = nullptr;
    double most = 0;
    for (const Sample& sample : samples_) {
        if (!counts(sample)) continue;
        const double value =
            options_.weight_angle * angle(sample.angle) +
            options_.weight_distance * (obstacles_count ? distance(sample.distance) : 0) +
            options_.weight_speed * speed(sample.speed) +
            options_.weight_target * target(sample.target);
        if (best != nullptr && value <= most) continue;
        best = &sample;
        most = value;
    }
    return best;
}

}  // namespace pulseline::control
