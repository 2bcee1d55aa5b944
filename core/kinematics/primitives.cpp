#include "core/kinematics/primitives.hpp"

#include <algorithm>
#include <cmath>

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

double run_duration_s(const plant::VehicleType& type, const Segment& shape, double length_m,
                      double turn_rad, double max_speed_mps) {
    if (shape.kind == Segment::Kind::kRotate) {
        return profile_duration_s(turn_rad, type.max_turn_rate_radps, type.max_turn_accel_radps2);
    }
    const double speed =
        max_speed_mps > 0 ? std::min(max_speed_mps, type.max_speed_mps) : type.max_speed_mps;
    if (shape.kind == Segment::Kind::kStraight || turn_rad <= 0) {
        return profile_duration_s(length_m, speed, type.max_accel_mps2);
    }
    const double radius = length_m / turn_rad;  // both limits hold: of the way and of the turn
    return profile_duration_s(turn_rad, std::min(type.max_turn_rate_radps, speed / radius),
                              std::min(type.max_turn_accel_radps2, type.max_accel_mps2 / radius));
}

}  // namespace

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
    segment.direction_rad = wrap(std::atan2(way.y_m, way.x_m) - from.heading_rad);
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
    }
    return false;
}

void set_durations(const plant::VehicleType& type, std::vector<Segment>& segments,
                   const std::vector<double>& max_speed_mps) {
    const auto limit = [&](std::size_t i) {
        return i < max_speed_mps.size() ? max_speed_mps[i] : 0.0;
    };
    for (std::size_t begin = 0, end = 0; begin < segments.size(); begin = end) {
        double length = 0;
        double turn = 0;
        for (end = begin;
             end < segments.size() && (end == begin || (runs_on(segments[end - 1], segments[end]) &&
                                                        limit(end) == limit(begin)));
             ++end) {
            length += std::abs(segments[end].length_m);
            turn += std::abs(segments[end].turn_rad);
        }
        const double total = run_duration_s(type, segments[begin], length, turn, limit(begin));
        const bool by_turn = segments[begin].kind == Segment::Kind::kRotate;
        for (std::size_t i = begin; i < end; ++i) {
            const double share = by_turn ? std::abs(segments[i].turn_rad) / turn
                                         : std::abs(segments[i].length_m) / length;
            segments[i].duration_s = total > 0 ? total * share : 0;
        }
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
        case Segment::Kind::kArc:
            break;
    }
    const Point2 at =
        Pose2{segment.centre.x_m, segment.centre.y_m, turned} * (a.position() - segment.centre);
    return {at.x_m, at.y_m, wrap(a.heading_rad + turned)};
}

Segment part(const plant::VehicleType& type, const Segment& segment, double s0, double s1) {
    Segment piece = segment;
    piece.start = pose_at(segment, s0);
    piece.end = pose_at(segment, s1);
    const double share = std::min(1.0, s1) - std::max(0.0, s0);
    piece.turn_rad *= share;
    piece.length_m *= share;
    std::vector<Segment> alone{piece};
    set_durations(type, alone);
    return alone.front();
}

}  // namespace pulseline::kinematics
