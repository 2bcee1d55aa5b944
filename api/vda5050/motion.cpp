#include "api/vda5050/motion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "api/vda5050/limits.hpp"
#include "core/geometry/bearing.hpp"

namespace pulseline::vda5050 {
namespace {

using geometry::Point2;
using geometry::Pose2;
using kinematics::Segment;
using Kind = Segment::Kind;

constexpr double kSamePlace_m = 1e-4;
constexpr double kHalfTurn_rad = 0.01;  // nearer to a half turn its sense must be said
constexpr double kArcWeight = 1e-3;
constexpr double kArcFit_m = 0.01;
constexpr std::size_t kMostPieces = 16;

struct ControlPoint {
    Point2 at;
    double weight = 1;
};

/// Rational quadratic pieces of at most a quarter turn: exact circles (weights 1, cos, 1).
Json encode_arc(const Segment& arc) {
    const int pieces =
        std::max(1, static_cast<int>(std::ceil(std::abs(arc.turn_rad) / (kPi / 2) - 1e-9)));
    const double phi = arc.turn_rad / pieces;
    const Point2 radius = arc.start.position() - arc.centre;
    const auto on_circle = [&](double angle, double stretch) {
        const Point2 p = Pose2{0, 0, angle} * radius;
        return arc.centre + stretch * p;
    };
    const auto point = [](Point2 p, double weight) {
        return Json{{"x", finite(p.x_m)}, {"y", finite(p.y_m)}, {"weight", weight}};
    };
    const double weight = std::cos(phi / 2);
    Json points = Json::array({point(arc.start.position(), 1)});
    Json knots = Json::array({0.0, 0.0, 0.0});
    for (int i = 0; i < pieces; ++i) {
        const bool last = i + 1 == pieces;
        points.push_back(point(on_circle((i + 0.5) * phi, 1 / weight), weight));
        points.push_back(point(last ? arc.end.position() : on_circle((i + 1) * phi, 1), 1));
        const double knot = last ? 1.0 : static_cast<double>(i + 1) / pieces;
        knots.push_back(knot);
        knots.push_back(knot);
    }
    knots.push_back(1.0);
    return {{"degree", 2}, {"knotVector", std::move(knots)}, {"controlPoints", std::move(points)}};
}

std::vector<ControlPoint> read_points(json::ObjectReader& trajectory) {
    std::vector<ControlPoint> points;
    trajectory.items(
        "controlPoints", {2, 2 * kMostPieces + 1},
        [&](const Json& item, const std::string& pointer) {
            json::ObjectReader in(item, pointer, trajectory.errors());
            ControlPoint point;
            point.at = {in.number("x", limits::kPlace_m), in.number("y", limits::kPlace_m)};
            point.weight = in.number_or("weight", 1.0, {1e-6, 1e6});
            points.push_back(point);
        });
    return points;
}

/// The circle through the control points of an arc; nullopt when they are none.
std::optional<Segment> arc_through(const std::vector<ControlPoint>& points, bool backwards) {
    if (points.size() < 3 || points.size() % 2 == 0) return std::nullopt;
    Segment arc;
    arc.kind = Kind::kArc;
    double radius_m = 0;
    for (std::size_t i = 0; i + 2 < points.size(); i += 2) {
        const Point2 tangent = points[i + 1].at - points[i].at;
        const Point2 chord = points[i + 2].at - points[i].at;
        const double phi = 2 * std::atan2(cross(tangent, chord), dot(tangent, chord));
        if (std::abs(phi) < 1e-9 || std::abs(phi) > kPi - 0.01) return std::nullopt;
        if (std::abs(points[i + 1].weight - std::cos(phi / 2)) > kArcWeight) return std::nullopt;
        const double signed_radius_m = norm(chord) / (2 * std::sin(phi / 2));
        const Point2 left{-tangent.y_m / norm(tangent), tangent.x_m / norm(tangent)};
        const Point2 centre = points[i].at + signed_radius_m * left;
        if (i == 0) {
            arc.centre = centre;
            radius_m = std::abs(signed_radius_m);
            arc.start = {points[0].at.x_m, points[0].at.y_m,
                         wrap(std::atan2(tangent.y_m, tangent.x_m) + (backwards ? kPi : 0))};
        } else if (distance(centre, arc.centre) > kArcFit_m || (phi > 0) != (arc.turn_rad > 0)) {
            return std::nullopt;
        }
        arc.turn_rad += phi;
    }
    arc.length_m = (backwards ? -1 : 1) * radius_m * std::abs(arc.turn_rad);
    arc.end = {points.back().at.x_m, points.back().at.y_m,
               wrap(arc.start.heading_rad + arc.turn_rad)};
    // Control points at one place but for rounding have no circle.
    if (!std::isfinite(arc.length_m + arc.centre.x_m + arc.centre.y_m)) return std::nullopt;
    return arc;
}

Segment turn_on_the_spot(json::ObjectReader& edge, const Pose2& from, const Pose2& to) {
    Segment turn;
    turn.kind = Kind::kRotate;
    turn.start = from;
    turn.end = to;
    turn.turn_rad = wrap(to.heading_rad - from.heading_rad);
    const std::string sense = edge.text_or("direction", "", {0, 64});
    if (sense == "ccw" && turn.turn_rad < 0) turn.turn_rad += 2 * kPi;
    if (sense == "cw" && turn.turn_rad > 0) turn.turn_rad -= 2 * kPi;
    return turn;
}

/// Straight there while the heading turns from one node's theta to the other's, the short way.
Segment combined(const Pose2& from, const Pose2& to) {
    Segment move;
    move.kind = Kind::kCombined;
    move.start = from;
    move.end = to;
    move.length_m = distance(from.position(), to.position());
    move.turn_rad = wrap(to.heading_rad - from.heading_rad);
    move.direction_rad = move_direction_rad(from, to.position());
    return move;
}

Segment straight_on(const OrderNode& from, const OrderNode& to, double orientation, bool global) {
    Segment straight;
    straight.kind = Kind::kStraight;
    const double tangent = bearing_rad(from.pose.position(), to.pose.position());
    const double heading = wrap(global ? orientation : tangent + orientation);
    straight.start = {from.pose.x_m, from.pose.y_m, heading};
    straight.end = {to.pose.x_m, to.pose.y_m, heading};
    straight.length_m = distance(from.pose.position(), to.pose.position());
    straight.direction_rad = move_direction_rad(straight.start, to.pose.position());
    return straight;
}

}  // namespace

void encode_motion(Json& edge, const Segment& segment) {
    edge["length"] = finite(std::abs(segment.length_m));
    edge["orientationType"] = "TANGENTIAL";
    switch (segment.kind) {
        case Kind::kRotate:
            edge["rotationAllowed"] = true;
            edge["length"] = 0.0;
            edge.erase("orientationType");
            if (std::abs(segment.turn_rad) > kPi - kHalfTurn_rad) {
                edge["direction"] = segment.turn_rad > 0 ? "ccw" : "cw";
            }
            return;
        case Kind::kStraight:
            edge["rotationAllowed"] = false;
            edge["orientation"] = std::clamp(wrap(-finite(segment.direction_rad)),
                                             -limits::kSchemaPi, limits::kSchemaPi);
            return;
        case Kind::kArc:
            edge["rotationAllowed"] = false;
            edge["orientation"] = segment.length_m < 0 ? limits::kSchemaPi : 0.0;
            edge["trajectory"] = encode_arc(segment);
            return;
        case Kind::kCombined:
            edge["rotationAllowed"] = true;
            edge["orientationType"] = "GLOBAL";
            edge["orientation"] =
                std::clamp(finite(segment.end.heading_rad), -limits::kSchemaPi, limits::kSchemaPi);
            return;
    }
}

Segment decode_motion(json::ObjectReader& edge, const OrderNode& from, const OrderNode& to) {
    const double orientation = edge.number_or("orientation", 0, {-3.2, 3.2});
    const std::string type = edge.text_or("orientationType", "TANGENTIAL", {0, 64});
    const auto refuse = [&](const char* field, const char* what) {
        edge.errors().add(json::child_pointer(edge.pointer(), std::string_view(field)),
                          {"motion_not_supported", {}}, what);
        return Segment{};
    };
    if (type != "TANGENTIAL" && type != "GLOBAL") {
        return refuse("orientationType", "orientationType must be TANGENTIAL or GLOBAL");
    }
    if (auto trajectory = edge.object_if_any("trajectory")) {
        const std::int64_t degree = trajectory->integer_or("degree", 1, {1, 16});
        trajectory->items("knotVector", {0, 4 * kMostPieces},
                          [&](const Json& item, const std::string& pointer) {
                              json::read_number(item, pointer, edge.errors(), {0, 1});
                          });
        const auto points = read_points(*trajectory);
        if (!edge.errors().empty()) return {};
        const bool backwards = std::abs(orientation) > kPi / 2;
        const bool along = std::abs(std::abs(orientation) - (backwards ? kPi : 0)) < 1e-3;
        if (type == "GLOBAL" || !along) {
            return refuse("orientation", "a trajectory is driven forwards or backwards only");
        }
        const auto arc = degree == 2 ? arc_through(points, backwards) : std::nullopt;
        if (!arc) return refuse("trajectory", "the trajectory is no circular arc");
        if (distance(arc->start.position(), from.pose.position()) > kArcFit_m ||
            distance(arc->end.position(), to.pose.position()) > kArcFit_m) {
            return refuse("trajectory", "the trajectory does not join the edge's nodes");
        }
        return *arc;
    }
    if (distance(from.pose.position(), to.pose.position()) < kSamePlace_m) {
        if (!to.has_heading || !from.has_heading) {
            return refuse("edgeId", "a turn on the spot needs theta at both nodes");
        }
        return turn_on_the_spot(edge, from.pose, to.pose);
    }
    if (type == "GLOBAL" && edge.boolean_or("rotationAllowed", false) && from.has_heading &&
        to.has_heading && wrap(to.pose.heading_rad - from.pose.heading_rad) != 0) {
        return combined(from.pose, to.pose);
    }
    return straight_on(from, to, orientation, type == "GLOBAL");
}

}  // namespace pulseline::vda5050
