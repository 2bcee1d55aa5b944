#include "core/planning/manoeuvre/steering.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/kinematics/primitives.hpp"
#include "core/planning/manoeuvre/reeds_shepp.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Pose2;
using kinematics::Segment;
using plant::MotionMode;

constexpr double kLeastRadius_m = 0.3;
constexpr double kNoMove = 1e-12;

bool lists(const plant::VehicleType& type, MotionMode mode) {
    const auto& modes = type.motion_modes;
    return std::find(modes.begin(), modes.end(), mode) != modes.end();
}

double radius_of(const plant::VehicleType& type) {
    if (type.min_turn_radius_m > 0) return type.min_turn_radius_m;
    return std::max(kLeastRadius_m, type.length_m() / 2);
}

Move turn(double amount_rad) { return {.kind = Segment::Kind::kRotate, .amount = amount_rad}; }
Move straight(double length_m, double direction_rad = 0) {
    return {.amount = length_m, .direction_rad = direction_rad};
}

Way way_of(const Steering& steering, std::initializer_list<Move> moves) {
    Way way;
    for (const Move& move : moves) {
        if (std::abs(move.amount) < kNoMove) continue;
        if (way.count > 0) way.cost_m += Steering::kStop_m;
        way.cost_m += steering.cost_m(move);
        way.moves[static_cast<std::size_t>(way.count++)] = move;
    }
    return way;
}

Way way_of(const RsPath& path, double radius_m) {
    Way way;
    way.count = path.count;
    way.cost_m = path.length * radius_m + Steering::kStop_m * std::max(0, path.count - 1);
    for (int i = 0; i < path.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const RsPiece& piece = path.pieces[k];
        Move& move = way.moves[k];
        move.amount = piece.length * radius_m;
        if (piece.steer != 0) {
            move.kind = Segment::Kind::kArc;
            move.curvature = piece.steer / radius_m;
        }
    }
    return way;
}

/// Calls take for every way with turns on the spot.
template <class Take>
void turning_ways(const Steering& steering, const Pose2& from, const Pose2& to, const Take& take) {
    const Point2 off = to.position() - from.position();
    const double length = norm(off);
    const double bearing = length > 0 ? std::atan2(off.y_m, off.x_m) : from.heading_rad;
    const double whole = kinematics::shortest_turn_rad(from.heading_rad, to.heading_rad);
    for (const bool backwards : {false, true}) {
        const double heading = wrap(bearing + (backwards ? kPi : 0));
        take(way_of(steering, {turn(kinematics::shortest_turn_rad(from.heading_rad, heading)),
                               straight(backwards ? -length : length),
                               turn(kinematics::shortest_turn_rad(heading, to.heading_rad))}));
    }
    if (!steering.any_direction()) return;
    take(way_of(steering, {turn(whole), straight(length, wrap(bearing - to.heading_rad))}));
    take(way_of(steering, {straight(length, wrap(bearing - from.heading_rad)), turn(whole)}));
}

/// As kinematics::append_turn, but it drops nothing, so that the segments stay a chain.
void append_spot_turn(std::vector<Segment>& segments, const Pose2& from, const Pose2& to,
                      double turn_rad) {
    const int pieces = std::abs(turn_rad) >= kinematics::kSplitTurn_rad ? 2 : 1;
    Segment piece;
    piece.kind = Segment::Kind::kRotate;
    piece.start = from;
    piece.turn_rad = turn_rad / pieces;
    for (int i = 1; i <= pieces; ++i) {
        piece.end = i == pieces ? to : moved(from, turn(piece.turn_rad));
        segments.push_back(piece);
        piece.start = piece.end;
    }
}

Pose2 in_radii(const Pose2& from, const Pose2& to, double radius_m) {
    const Pose2 goal = inverse(from) * to;
    return {goal.x_m / radius_m, goal.y_m / radius_m, goal.heading_rad};
}

}  // namespace

Pose2 moved(const Pose2& from, const Move& move, double share) {
    const double amount = move.amount * share;
    if (move.kind == Segment::Kind::kRotate) return from * Pose2{0, 0, amount};
    if (move.kind == Segment::Kind::kStraight) {
        const double along = from.heading_rad + move.direction_rad;
        return {from.x_m + amount * std::cos(along), from.y_m + amount * std::sin(along),
                from.heading_rad};
    }
    const double turned = amount * move.curvature;
    return from * Pose2{std::sin(turned) / move.curvature, (1 - std::cos(turned)) / move.curvature,
                        turned};
}

double farthest_moved_m(const Move& move, double reach_m) {
    if (move.kind == Segment::Kind::kRotate) return std::abs(move.amount) * reach_m;
    return std::abs(move.amount) * (1 + std::abs(move.curvature) * reach_m);
}

Steering::Steering(const plant::VehicleType& type)
    : radius_m_(radius_of(type)),
      turn_m_(type.max_speed_mps / type.max_turn_rate_radps),
      spot_(lists(type, MotionMode::kSelfRotation) || lists(type, MotionMode::kLinear) ||
            type.kinematics == plant::Kinematics::kMecanum),
      any_direction_(spot_ && (type.kinematics == plant::Kinematics::kMecanum ||
                               lists(type, MotionMode::kLateral))) {}

double Steering::cost_m(const Move& move) const {
    return std::abs(move.amount) * (move.kind == Segment::Kind::kRotate ? turn_m_ : 1);
}

void Steering::ways(const Pose2& from, const Pose2& to, std::vector<Way>& ways) const {
    ways.clear();
    std::vector<RsPath> paths;
    reeds_shepp_paths(in_radii(from, to, radius_m_), paths);
    for (const RsPath& path : paths) ways.push_back(way_of(path, radius_m_));
    if (spot_) turning_ways(*this, from, to, [&](const Way& way) { ways.push_back(way); });
    std::stable_sort(ways.begin(), ways.end(),
                     [](const Way& a, const Way& b) { return a.cost_m < b.cost_m; });
}

double Steering::least_cost_m(const Pose2& from, const Pose2& to) const {
    double least = radius_m_ * reeds_shepp_length(in_radii(from, to, radius_m_));
    if (spot_) {
        turning_ways(*this, from, to, [&](const Way& way) { least = std::min(least, way.cost_m); });
    }
    return least;
}

std::vector<Segment> segments_of(const Pose2& start, const std::vector<Move>& moves,
                                 const Pose2& goal) {
    std::vector<Segment> segments;
    Pose2 at = start;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const Move& move = moves[i];
        const Pose2 end = i + 1 == moves.size() ? goal : moved(at, move);
        if (move.kind == Segment::Kind::kRotate) {
            append_spot_turn(segments, at, end, move.amount);
        } else if (move.kind == Segment::Kind::kStraight) {
            Segment segment;
            segment.start = at;
            segment.end = end;
            segment.direction_rad = wrap(move.direction_rad + (move.amount < 0 ? kPi : 0));
            const bool backwards = std::abs(segment.direction_rad) > kPi * 3 / 4;
            segment.length_m = std::abs(move.amount) * (backwards ? -1 : 1);
            segments.push_back(segment);
        } else {
            const Point2 centre = at * Point2{0, 1 / move.curvature};
            kinematics::append_arc(segments, at, centre, move.amount * move.curvature,
                                   move.amount < 0, end.position());
            segments.back().end = end;
        }
        at = end;
    }
    return segments;
}

}  // namespace pulseline::planning
