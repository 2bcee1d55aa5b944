#include "core/kinematics/primitives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/bearing.hpp"

namespace pulseline::kinematics {
namespace {

constexpr double kHalfTurnTie_rad = 1e-9;  // rounding of two headings half a turn apart
constexpr double kArcPiece_rad = kPi / 2;

Segment segment_of(Segment::Kind kind, const Pose2& start, const Pose2& end) {
    Segment segment;
    segment.kind = kind;
    segment.start = start;
    segment.end = end;
    return segment;
}

// Body directions on a combined move are tried this far apart; between them a wheel's share of the
// way is at most 1 / cos(half of it) as large.
constexpr double kDirectionStep_rad = radians(6.0);

double limit_at(const std::vector<double>& limits, std::size_t i) {
    return i < limits.size() ? limits[i] : 0.0;
}

/// The steered wheels of a vehicle that stood with them straight: they turn before each run.
class Steering {
public:
    explicit Steering(const plant::VehicleType& type) : type_(type), present_(type.wheels.size()) {}

    /// Time before a run.
    double before(const Segment& first) {
        auto wheels = wheels_of(type_, twist_along(first, 0), present_);
        if (!wheels) return 0;  // such a motion is refused elsewhere
        const double duration_s = steering_duration_s(type_, present_, *wheels);
        present_ = std::move(*wheels);
        return duration_s;
    }

private:
    const plant::VehicleType& type_;
    std::vector<WheelMotion> present_;
};

/// A piece without its duration.
Segment cut(const Segment& segment, double s0, double s1) {
    Segment piece = segment;
    piece.start = pose_at(segment, s0);
    piece.end = pose_at(segment, s1);
    const double share = std::min(1.0, s1) - std::max(0.0, s0);
    piece.turn_rad *= share;
    piece.length_m *= share;
    if (piece.kind == Segment::Kind::kCombined)
        piece.direction_rad = wrap(segment.direction_rad - std::max(0.0, s0) * segment.turn_rad);
    return piece;
}

}  // namespace

double size_of(const Segment& segment) {
    return segment.kind == Segment::Kind::kRotate ? std::abs(segment.turn_rad)
                                                  : std::abs(segment.length_m);
}

double profile_duration_s(double distance, double max_rate, double max_accel) {
    if (distance <= 0) return 0;
    if (max_accel <= 0) return distance / max_rate;
    if (distance >= max_rate * max_rate / max_accel) {
        return distance / max_rate + max_rate / max_accel;
    }
    return 2 * std::sqrt(distance / max_accel);
}

double shortest_turn_rad(double from_rad, double to_rad) {
    const double turn = wrap(to_rad - from_rad);
    return turn < -kPi + kHalfTurnTie_rad ? turn + 2 * kPi : turn;
}

void append_turn(std::vector<Segment>& segments, const Pose2& from, double turn_rad) {
    if (std::abs(turn_rad) < kNothing) return;
    const int pieces = std::abs(turn_rad) >= kSplitTurn_rad ? 2 : 1;
    Pose2 pose = from;
    for (int i = 1; i <= pieces; ++i) {
        Pose2 end = from;
        end.heading_rad = wrap(from.heading_rad + turn_rad * i / pieces);
        Segment segment = segment_of(Segment::Kind::kRotate, pose, end);
        segment.turn_rad = turn_rad / pieces;
        segments.push_back(segment);
        pose = end;
    }
}

void append_straight(std::vector<Segment>& segments, const Pose2& from, Point2 target) {
    const Point2 way = target - from.position();
    const double length = norm(way);
    if (length < kNothing) return;
    Segment segment =
        segment_of(Segment::Kind::kStraight, from, {target.x_m, target.y_m, from.heading_rad});
    segment.direction_rad = geometry::move_direction_rad(from, target);
    segment.length_m = std::abs(segment.direction_rad) > kPi * 3 / 4 ? -length : length;
    segments.push_back(segment);
}

void append_arc(std::vector<Segment>& segments, const Pose2& from, Point2 centre, double turn_rad,
                bool backwards, Point2 target) {
    const int pieces =
        std::max(1, static_cast<int>(std::ceil(std::abs(turn_rad) / kArcPiece_rad - 1e-9)));
    const double radius = geometry::distance(from.position(), centre);
    Segment whole = segment_of(Segment::Kind::kArc, from,
                               {target.x_m, target.y_m, wrap(from.heading_rad + turn_rad)});
    whole.turn_rad = turn_rad;
    whole.length_m = radius * std::abs(turn_rad) * (backwards ? -1 : 1);
    whole.centre = centre;
    Segment piece = whole;
    piece.turn_rad /= pieces;
    piece.length_m /= pieces;
    for (int i = 1; i <= pieces; ++i) {
        piece.end = pose_at(whole, static_cast<double>(i) / pieces);
        segments.push_back(piece);
        piece.start = piece.end;
    }
}

void append_combined(std::vector<Segment>& segments, const Pose2& from, Point2 target,
                     double turn_rad) {
    const Point2 way = target - from.position();
    if (norm(way) < kNothing) return append_turn(segments, from, turn_rad);
    if (std::abs(turn_rad) < kNothing) return append_straight(segments, from, target);
    Segment whole = segment_of(Segment::Kind::kCombined, from,
                               {target.x_m, target.y_m, wrap(from.heading_rad + turn_rad)});
    whole.turn_rad = turn_rad;
    whole.length_m = norm(way);
    whole.direction_rad = geometry::move_direction_rad(from, target);
    const int pieces =
        std::max(1, static_cast<int>(std::ceil(std::abs(turn_rad) / kArcPiece_rad - 1e-9)));
    for (int i = 0; i < pieces; ++i) {
        segments.push_back(
            cut(whole, static_cast<double>(i) / pieces, static_cast<double>(i + 1) / pieces));
    }
}

Twist twist_along(const Segment& segment, double s) {
    const double direction = segment.direction_rad - s * segment.turn_rad;
    switch (segment.kind) {
        case Segment::Kind::kRotate:
            return {0, 0, segment.turn_rad < 0 ? -1.0 : 1.0};
        case Segment::Kind::kStraight:
            return {std::cos(segment.direction_rad), std::sin(segment.direction_rad), 0};
        case Segment::Kind::kArc:
            return {segment.length_m < 0 ? -1.0 : 1.0, 0,
                    segment.turn_rad / std::abs(segment.length_m)};
        case Segment::Kind::kCombined:
            return {std::cos(direction), std::sin(direction), segment.turn_rad / segment.length_m};
    }
    return {};
}

double max_rate(const plant::VehicleType& type, const Segment& segment, double max_speed_mps) {
    double rate = most_times(type, twist_along(segment, 0));
    if (segment.kind == Segment::Kind::kCombined) {
        const int steps = std::max(
            1, static_cast<int>(std::ceil(std::abs(segment.turn_rad) / kDirectionStep_rad)));
        for (int i = 1; i <= steps; ++i) {
            const double s = static_cast<double>(i) / steps;
            rate = std::min(rate, most_times(type, twist_along(segment, s)));
        }
        rate *= std::cos(segment.turn_rad / steps / 2);
    }
    const bool on_the_spot = segment.kind == Segment::Kind::kRotate;
    return max_speed_mps > 0 && !on_the_spot ? std::min(rate, max_speed_mps) : rate;
}

double max_accel(const plant::VehicleType& type, const Segment& segment) {
    if (segment.kind == Segment::Kind::kRotate) return type.max_turn_accel_radps2;
    const double turn_per_m = std::abs(twist_along(segment, 0).turn_radps);
    if (turn_per_m <= 0) return type.max_accel_mps2;
    return std::min(type.max_accel_mps2, type.max_turn_accel_radps2 / turn_per_m);
}

bool runs_on(const Segment& before, const Segment& after) {
    if (before.kind != after.kind) return false;
    switch (before.kind) {
        case Segment::Kind::kRotate:
            return (before.turn_rad > 0) == (after.turn_rad > 0);
        case Segment::Kind::kStraight:
            return std::abs(wrap(before.direction_rad - after.direction_rad)) < kNothing &&
                   std::abs(wrap(before.end.heading_rad - after.start.heading_rad)) < kNothing;
        case Segment::Kind::kArc:
            return geometry::distance(before.centre, after.centre) < kNothing &&
                   (before.turn_rad > 0) == (after.turn_rad > 0);
        case Segment::Kind::kCombined:
            return std::abs(wrap(before.direction_rad - before.turn_rad - after.direction_rad)) <
                       kNothing &&
                   std::abs(before.turn_rad / before.length_m - after.turn_rad / after.length_m) <
                       kNothing;
    }
    return false;
}

std::size_t run_end(const std::vector<Segment>& segments, std::size_t begin,
                    const std::vector<double>& max_speed_mps) {
    std::size_t end = begin + 1;
    while (end < segments.size() && runs_on(segments[end - 1], segments[end]) &&
           limit_at(max_speed_mps, end) == limit_at(max_speed_mps, begin)) {
        ++end;
    }
    return end;
}

void set_durations(const plant::VehicleType& type, std::vector<Segment>& segments,
                   const std::vector<double>& max_speed_mps) {
    Steering steering(type);
    for (std::size_t begin = 0, end = 0; begin < segments.size(); begin = end) {
        end = run_end(segments, begin, max_speed_mps);
        double size = 0;
        double rate = std::numeric_limits<double>::infinity();
        for (std::size_t i = begin; i < end; ++i) {
            size += size_of(segments[i]);
            rate = std::min(rate, max_rate(type, segments[i], limit_at(max_speed_mps, begin)));
        }
        const double total_s = profile_duration_s(size, rate, max_accel(type, segments[begin]));
        for (std::size_t i = begin; i < end; ++i) {
            segments[i].duration_s = size > 0 ? total_s * size_of(segments[i]) / size : 0;
        }
        segments[begin].duration_s += steering.before(segments[begin]);
    }
}

MotionPlan summed(MotionMode mode, std::vector<Segment> segments) {
    MotionPlan plan{.mode = mode, .segments = std::move(segments)};
    for (const Segment& segment : plan.segments) {
        plan.length_m += std::abs(segment.length_m);
        plan.turn_rad += std::abs(segment.turn_rad);
        plan.duration_s += segment.duration_s;
    }
    return plan;
}

Pose2 pose_at(const Segment& segment, double s) {
    if (s <= 0) return segment.start;
    if (s >= 1) return segment.end;
    const Pose2& a = segment.start;
    const double turned = s * segment.turn_rad;
    switch (segment.kind) {
        case Segment::Kind::kRotate:
            return {a.x_m, a.y_m, wrap(a.heading_rad + turned)};
        case Segment::Kind::kStraight:
            return {a.x_m + s * (segment.end.x_m - a.x_m), a.y_m + s * (segment.end.y_m - a.y_m),
                    a.heading_rad};
        case Segment::Kind::kCombined:
            return {a.x_m + s * (segment.end.x_m - a.x_m), a.y_m + s * (segment.end.y_m - a.y_m),
                    wrap(a.heading_rad + turned)};
        case Segment::Kind::kArc:
            break;
    }
    const Point2 at =
        Pose2{segment.centre.x_m, segment.centre.y_m, turned} * (a.position() - segment.centre);
    return {at.x_m, at.y_m, wrap(a.heading_rad + turned)};
}

Segment part(const plant::VehicleType& type, const Segment& segment, double s0, double s1) {
    Segment piece = cut(segment, s0, s1);
    piece.duration_s =
        profile_duration_s(size_of(piece), max_rate(type, piece, 0), max_accel(type, piece));
    return piece;
}

}  // namespace pulseline::kinematics
