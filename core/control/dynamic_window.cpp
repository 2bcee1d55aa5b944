#include "core/control/dynamic_window.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "core/control/braking.hpp"
#include "core/control/manoeuvre.hpp"

namespace pulseline::control {
namespace {

constexpr std::size_t kMostSamples = 256;
constexpr double kCorridorSpacing_m = 0.02;
// Enters the tolerance a little inside it, so that noise does not drive it out again.
constexpr double kEnter = 0.7;
constexpr double kStill_mps = 1e-3;
constexpr double kStill_radps = 1e-3;

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
