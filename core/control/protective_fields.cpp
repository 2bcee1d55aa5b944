#include "core/control/protective_fields.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace pulseline::control {
namespace {

using geometry::Point2;
using geometry::Pose2;
using kinematics::Twist;

constexpr double kResolution_m = 0.01;  // of a way beside something
constexpr int kSweepPoses = 16;
constexpr std::size_t kStride = 32;

/// Where a body is after a while of one twist.
Pose2 after(const Twist& twist, double time_s) {
    const double half = twist.turn_radps * time_s / 2;
    const double chord_s = std::abs(half) < 1e-9 ? time_s : time_s * std::sin(half) / half;
    const double c = std::cos(half);
    const double s = std::sin(half);
    return {chord_s * (c * twist.vx_mps - s * twist.vy_mps),
            chord_s * (s * twist.vx_mps + c * twist.vy_mps), wrap(2 * half)};
}

}  // namespace

ProtectiveFields::ProtectiveFields(const plant::VehicleType& type, const geometry::Polygon& outline,
                                   const FieldOptions& options)
    : accel_mps2_(type.max_accel_mps2),
      turn_accel_radps2_(type.max_turn_accel_radps2),
      options_(options),
      hull_(geometry::convex_hull(outline)),
      outline_(outline) {
    assert(accel_mps2_ > 0 && turn_accel_radps2_ > 0);
    for (const Point2 corner : hull_) radius_m_ = std::max(radius_m_, norm(corner));
}

void ProtectiveFields::prepare(const Scan& scan) {
    if (rays_.size() == scan.ranges_m.size() && body_from_sensor_ == scan.body_from_sensor &&
        first_rad_ == scan.first_rad && step_rad_ == scan.step_rad) {
        return;
    }
    body_from_sensor_ = scan.body_from_sensor;
    first_rad_ = scan.first_rad;
    step_rad_ = scan.step_rad;
    rays_.clear();
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
        const double angle =
            body_from_sensor_.heading_rad + first_rad_ + static_cast<double>(i) * step_rad_;
        rays_.push_back({std::cos(angle), std::sin(angle)});
    }
}

FieldAnswer ProtectiveFields::check(const Scan& scan, const Twist& driven) {
    prepare(scan);
    FieldAnswer answer;
    const double speed = std::hypot(driven.vx_mps, driven.vy_mps);
    const double turn_rate = std::abs(driven.turn_radps);
    answer.speed_mps = speed;
    if (speed == 0 && turn_rate == 0) return answer;

    // Times of driving on as now; braking goes half as far in the same time.
    const double half_braking_s = std::max(speed / accel_mps2_, turn_rate / turn_accel_radps2_) / 2;
    const double stopping_s = options_.reaction_s + half_braking_s;
    double until_s = stopping_s + options_.look_ahead_s;
    const geometry::Box box = swept_box(driven, until_s);
    bool met = false;
    const auto look = [&](std::size_t i) {
        const double range = scan.ranges_m[i];
        if (!(range > 0) || !std::isfinite(range)) return;
        const Point2 p = body_from_sensor_.position() + range * rays_[i];
        if (p.x_m < box.min.x_m || p.x_m > box.max.x_m || p.y_m < box.min.y_m ||
            p.y_m > box.max.y_m) {
            return;
        }
        const auto contact = contact_s(p, driven, until_s);
        if (!contact || (met && *contact >= until_s)) return;
        met = true;
        until_s = *contact;
        answer.nearest = p;
    };
    // In strides: what is met early shortens the look at all the rest.
    for (std::size_t first = 0; first < kStride; ++first) {
        for (std::size_t i = first; i < rays_.size() && until_s > 0; i += kStride) look(i);
    }
    if (!met) return answer;
    answer.way_m = until_s * speed;
    if (until_s <= stopping_s) {
        answer.verdict = FieldAnswer::Verdict::kStop;
        answer.speed_share = 0;
    } else {
        // share (reaction + look ahead) + share^2 braking / 2 = until contact
        const double steady_s = options_.reaction_s + options_.look_ahead_s;
        answer.verdict = FieldAnswer::Verdict::kSlow;
        answer.speed_share =
            2 * until_s /
            (steady_s + std::sqrt(steady_s * steady_s + 4 * half_braking_s * until_s));
    }
    answer.speed_mps = answer.speed_share * speed;
    return answer;
}

/// A box that holds the field: outside it no return needs a closer look.
geometry::Box ProtectiveFields::swept_box(const Twist& twist, double time_s) const {
    geometry::Box box = geometry::bounding_box(hull_);
    for (int i = 1; i <= kSweepPoses; ++i) {
        const Pose2 pose = after(twist, time_s * i / kSweepPoses);
        for (const Point2 corner : hull_) {
            const Point2 at = pose * corner;
            box.min = {std::min(box.min.x_m, at.x_m), std::min(box.min.y_m, at.y_m)};
            box.max = {std::max(box.max.x_m, at.x_m), std::max(box.max.y_m, at.y_m)};
        }
    }
    // Between two poses a corner moves on an arc, at most its sagitta beside the chord.
    const double turn_rad = std::abs(twist.turn_radps) * time_s / kSweepPoses;
    const double way_m = std::hypot(twist.vx_mps, twist.vy_mps) * time_s / kSweepPoses;
    const double more_m = options_.margin_m + (way_m + radius_m_ * turn_rad) * turn_rad / 8;
    box.min = {box.min.x_m - more_m, box.min.y_m - more_m};
    box.max = {box.max.x_m + more_m, box.max.y_m + more_m};
    return box;
}

/// When the outline comes within the margin of a point, by conservative advancement: no point of
/// the body is faster than the bound, so what is that far away cannot be met sooner.
std::optional<double> ProtectiveFields::contact_s(Point2 p, const Twist& twist,
                                                  double until_s) const {
    const auto distance_m = [&](double time_s) {
        return outline_.outline_distance_m(inverse(after(twist, time_s)) * p);
    };
    const double fastest_mps =
        std::hypot(twist.vx_mps, twist.vy_mps) + std::abs(twist.turn_radps) * radius_m_;
    const double resolution_s = kResolution_m / fastest_mps;
    double time_s = 0;
    double now_m = distance_m(0);
    bool leaving = now_m > 0 && now_m <= options_.margin_m;
    while (time_s <= until_s) {
        if (leaving) {
            time_s += resolution_s;
            const double then_m = distance_m(time_s);
            if (then_m < now_m - 1e-9) return 0;
            now_m = then_m;
            leaving = now_m <= options_.margin_m;
            continue;
        }
        if (now_m <= options_.margin_m) return std::max(0.0, time_s - resolution_s);
        time_s += std::max((now_m - options_.margin_m) / fastest_mps, resolution_s);
        now_m = distance_m(time_s);
    }
    return std::nullopt;
}

}  // namespace pulseline::control
