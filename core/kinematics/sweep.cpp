#include <algorithm>
#include <cmath>

#include "core/kinematics/motion.hpp"

// Each step's hull holds, for every corner, its place before and after and, when the body turns,
// the point where the tangents of its circular path meet: the path lies inside that triangle, so
// the hull holds the body at every moment in between and not just at the samples.
namespace pulseline::kinematics {
namespace {

using geometry::Polygon;

int steps_of(const Segment& segment, double reach_m, const SweepDetail& detail) {
    // excess = r (1 / cos(step / 2) - 1), about r step^2 / 8
    const double step =
        std::min(detail.step_rad, std::sqrt(8 * detail.excess_m / std::max(reach_m, 1e-3)));
    return std::max(1, static_cast<int>(std::ceil(std::abs(segment.turn_rad) / step - 1e-9)));
}

void sweep_straight(const Polygon& piece, const Segment& segment, std::vector<Polygon>& swept) {
    std::vector<Point2> points = geometry::transformed(segment.start, piece);
    const Polygon after = geometry::transformed(segment.end, piece);
    points.insert(points.end(), after.begin(), after.end());
    swept.push_back(geometry::convex_hull(std::move(points)));
}

void sweep_turn(const Polygon& piece, const Segment& segment, const SweepDetail& detail,
                std::vector<Polygon>& swept) {
    const Point2 centre =
        segment.kind == Segment::Kind::kArc ? segment.centre : segment.start.position();
    const Polygon first = geometry::transformed(segment.start, piece);
    double reach = 0;
    for (const Point2& p : first) reach = std::max(reach, geometry::distance(p, centre));
    const int steps = steps_of(segment, reach, detail);
    const double step = segment.turn_rad / steps;
    const double stretch = 1 / std::cos(step / 2);

    Polygon before = first;
    for (int i = 1; i <= steps; ++i) {
        const Pose2 turned{centre.x_m, centre.y_m, i * step};
        const Pose2 halfway{centre.x_m, centre.y_m, (i - 0.5) * step};
        Polygon after;
        std::vector<Point2> points = before;
        for (const Point2& p : first) {
            after.push_back(turned * (p - centre));
            points.push_back(halfway * (stretch * (p - centre)));
        }
        points.insert(points.end(), after.begin(), after.end());
        swept.push_back(geometry::convex_hull(std::move(points)));
        before = std::move(after);
    }
}

/// Corners of a body that moves and turns at once: in a step by d about the moving centre the path
/// of a corner at r leaves the straight line between its ends by at most r d^2 / 8, in any
/// direction, so that a square of twice that width about every corner holds it.
void sweep_combined(const Polygon& piece, const Segment& segment, const SweepDetail& detail,
                    std::vector<Polygon>& swept) {
    double reach = 0;
    for (const Point2& p : piece) reach = std::max(reach, norm(p));
    const int steps = steps_of(segment, reach, detail);
    const double step = segment.turn_rad / steps;
    const double out = reach * step * step / 8;
    Polygon before = geometry::transformed(segment.start, piece);
    for (int i = 1; i <= steps; ++i) {
        Polygon after =
            geometry::transformed(pose_at(segment, static_cast<double>(i) / steps), piece);
        std::vector<Point2> points;
        for (const Polygon* corners : {&before, &after}) {
            for (const Point2& p : *corners) {
                for (const Point2 side : {Point2{out, out}, {out, -out}, {-out, out}, {-out, -out}})
                    points.push_back(p + side);
            }
        }
        swept.push_back(geometry::convex_hull(std::move(points)));
        before = std::move(after);
    }
}

}  // namespace

std::vector<Polygon> sweep(const std::vector<Polygon>& body, const std::vector<Segment>& segments,
                           const SweepDetail& detail) {
    std::vector<Polygon> swept;
    for (const Segment& segment : segments) {
        for (const Polygon& piece : body) {
            if (segment.kind == Segment::Kind::kStraight) {
                sweep_straight(piece, segment, swept);
            } else if (segment.kind == Segment::Kind::kCombined) {
                sweep_combined(piece, segment, detail, swept);
            } else {
                sweep_turn(piece, segment, detail, swept);
            }
        }
    }
    return swept;
}

}  // namespace pulseline::kinematics
