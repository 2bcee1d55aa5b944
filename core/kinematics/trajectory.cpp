#include "core/kinematics/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/kinematics/primitives.hpp"

namespace pulseline::kinematics {
namespace {

/// Way and speed of a trapezoidal profile from rest to rest.
struct Progress {
    double way = 0;
    double rate = 0;
};

Progress progress_at(double time_s, double duration_s, double size, double rate, double accel) {
    if (accel <= 0) return {std::min(size, rate * time_s), rate};
    const double peak = std::min(rate, std::sqrt(size * accel));
    const double ramp_s = peak / accel;
    if (time_s < ramp_s) return {accel * time_s * time_s / 2, accel * time_s};
    const double left_s = std::max(0.0, duration_s - time_s);
    if (left_s < ramp_s) return {size - accel * left_s * left_s / 2, accel * left_s};
    return {peak * (time_s - ramp_s / 2), peak};
}

Twist times(double k, const Twist& twist) {
    return {k * twist.vx_mps, k * twist.vy_mps, k * twist.turn_radps};
}

}  // namespace

Result<Trajectory> Trajectory::of(const plant::VehicleType& type,
                                  const std::vector<Segment>& segments,
                                  const std::vector<double>& max_speed_mps) {
    Trajectory made(type);
    std::vector<WheelMotion> present(type.wheels.size());
    for (std::size_t begin = 0, end = 0; begin < segments.size(); begin = end) {
        end = run_end(segments, begin, max_speed_mps);
        const double limit = begin < max_speed_mps.size() ? max_speed_mps[begin] : 0.0;
        Run run;
        run.begin_s = made.duration_s_;
        run.before = present;
        run.rate = std::numeric_limits<double>::infinity();
        run.accel = max_accel(type, segments[begin]);
        for (std::size_t i = begin; i < end; ++i) {
            const auto wheels = wheels_of(type, twist_along(segments[i], 0), present);
            if (!wheels) return fail(wheels.error());
            if (i == begin) run.first = *wheels;
            present = *wheels;
            run.segments.push_back(segments[i]);
            run.size += size_of(segments[i]);
            run.rate = std::min(run.rate, max_rate(type, segments[i], limit));
        }
        run.steering_s = steering_duration_s(type, run.before, run.first);
        run.moving_s = profile_duration_s(run.size, run.rate, run.accel);
        made.duration_s_ += run.steering_s + run.moving_s;
        made.runs_.push_back(std::move(run));
    }
    return made;
}

TrajectoryState Trajectory::at(double time_s) const {
    if (runs_.empty()) return {{}, {}, std::vector<WheelMotion>(type_->wheels.size())};
    const double when_s = std::clamp(time_s, 0.0, duration_s_);
    const auto next =
        std::upper_bound(runs_.begin() + 1, runs_.end(), when_s,
                         [](double t_s, const Run& run) { return t_s < run.begin_s; });
    const Run& run = *std::prev(next);
    const double in_run_s = when_s - run.begin_s;
    return in_run_s < run.steering_s ? steering(run, in_run_s)
                                     : moving(run, in_run_s - run.steering_s);
}

WheelPeaks Trajectory::wheel_peaks() const {
    constexpr int kParts = 32;  // even: the profile's peak is in its middle
    WheelPeaks peaks;
    for (const Run& run : runs_) {
        for (int part = 0; part <= kParts; ++part) {
            for (const WheelMotion& wheel : moving(run, run.moving_s * part / kParts).wheels) {
                peaks.speed_mps = std::max(peaks.speed_mps, std::abs(wheel.speed_mps));
                peaks.steering_rad = std::max(peaks.steering_rad, std::abs(wheel.angle_rad));
            }
        }
    }
    return peaks;
}

TrajectoryState Trajectory::steering(const Run& run, double time_s) const {
    TrajectoryState state{run.segments.front().start, {}, run.before};
    const double turned = type_->max_steering_rate_radps * time_s;
    for (std::size_t i = 0; i < state.wheels.size(); ++i) {
        WheelMotion& wheel = state.wheels[i];
        wheel.angle_rad += std::clamp(run.first[i].angle_rad - wheel.angle_rad, -turned, turned);
        wheel.speed_mps = 0;
    }
    return state;
}

TrajectoryState Trajectory::moving(const Run& run, double time_s) const {
    const Progress now = progress_at(time_s, run.moving_s, run.size, run.rate, run.accel);
    double before = 0;
    std::size_t i = 0;
    while (i + 1 < run.segments.size() && before + size_of(run.segments[i]) < now.way) {
        before += size_of(run.segments[i++]);
    }
    const Segment& segment = run.segments[i];
    const double s = std::clamp((now.way - before) / size_of(segment), 0.0, 1.0);
    TrajectoryState state{pose_at(segment, s), times(now.rate, twist_along(segment, s)), run.first};
    // Steered wheels stand still on the way: no motion of theirs curves unevenly.
    if (auto wheels = wheels_of(*type_, twist_along(segment, s), run.first)) state.wheels = *wheels;
    for (WheelMotion& wheel : state.wheels) wheel.speed_mps *= now.rate;
    return state;
}

}  // namespace pulseline::kinematics
