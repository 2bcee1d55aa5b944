#include <algorithm>
#include <boost/geometry/algorithms/append.hpp>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/union.hpp>
#include <boost/geometry/algorithms/unique.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <cmath>

#include "core/geometry/polygon.hpp"

// Union of swept pieces. Boost's overlay may throw or lose a part where edges touch within
// rounding, so every step is checked by area, repeated with a slightly grown piece, and in the end
// replaced by the convex hull of what would not join: too large is safe, too small is not.
namespace pulseline::geometry {
namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
using BoostPolygon = bg::model::polygon<BoostPoint, false, true>;  // counter-clockwise, closed
using Rings = bg::model::multi_polygon<BoostPolygon>;

constexpr double kSnap_m = 1e-6;     // far below any clearance, far above rounding
constexpr double kSliver_m2 = 1e-9;  // pieces below this have no floor of their own
constexpr double kLost_m2 = 1e-6;    // a union smaller than its parts by more has lost one

double snap(double value) { return std::round(value / kSnap_m) * kSnap_m; }

/// The piece as Boost wants it, `grow_m` larger about its centre; empty when degenerate.
BoostPolygon to_boost(const Polygon& piece, double grow_m) {
    Point2 centre;
    for (const Point2& p : piece) centre = centre + (1.0 / static_cast<double>(piece.size())) * p;
    BoostPolygon result;
    for (const Point2& p : piece) {
        const Point2 out = p - centre;
        const double length = norm(out);
        const Point2 q = length > 0 ? p + (grow_m / length) * out : p;
        bg::append(result.outer(), BoostPoint(snap(q.x_m), snap(q.y_m)));
    }
    bg::correct(result);
    bg::unique(result);
    return result;
}

Polygon from_boost(const BoostPolygon& polygon) {
    Polygon result;
    for (const BoostPoint& p : polygon.outer()) result.push_back({p.x(), p.y()});
    if (!result.empty()) result.pop_back();  // closing point
    return result;
}

bool sound(const Rings& rings) {
    for (const BoostPolygon& polygon : rings) {
        if (polygon.outer().size() < 4) return false;
        for (const BoostPoint& p : polygon.outer()) {
            if (!std::isfinite(p.x()) || !std::isfinite(p.y())) return false;
        }
    }
    return true;
}

void drop_holes(Rings& rings) {
    for (BoostPolygon& polygon : rings) polygon.inners().clear();
    rings.erase(std::remove_if(rings.begin(), rings.end(),
                               [](const BoostPolygon& p) { return bg::area(p) < kSliver_m2; }),
                rings.end());
}

bool try_union(const Rings& a, const Rings& b, Rings& result) {
    const double area_a = bg::area(a);
    const double area_b = bg::area(b);
    try {
        result.clear();
        bg::union_(a, b, result);
        if (!sound(result)) return false;
        drop_holes(result);
    } catch (const bg::exception&) {
        return false;
    }
    // Holes are gone, so rings may overlap rings inside them; the lower bound still holds.
    return bg::area(result) >= std::max(area_a, area_b) - kLost_m2;
}

Rings hull_of(const Rings& a, const Rings& b) {
    std::vector<Point2> points;
    for (const Rings* rings : {&a, &b}) {
        for (const BoostPolygon& polygon : *rings) {
            const Polygon ring = from_boost(polygon);
            points.insert(points.end(), ring.begin(), ring.end());
        }
    }
    return {to_boost(convex_hull(std::move(points)), 0)};
}

Rings grown(const Rings& rings, double grow_m) {
    Rings result;
    for (const BoostPolygon& polygon : rings)
        result.push_back(to_boost(from_boost(polygon), grow_m));
    return result;
}

Rings join(const Rings& a, const Rings& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    Rings result;
    for (const double grow_m : {0.0, 3.7e-6, 2.3e-5, 1.9e-4}) {
        if (try_union(a, grow_m > 0 ? grown(b, grow_m) : b, result)) return result;
    }
    return hull_of(a, b);
}

/// Halves are joined as a tree: neighbours on the way stay neighbours and rings stay short.
Rings join_range(const std::vector<BoostPolygon>& pieces, std::size_t begin, std::size_t end) {
    if (end - begin == 1) return {pieces[begin]};
    const std::size_t middle = begin + (end - begin) / 2;
    return join(join_range(pieces, begin, middle), join_range(pieces, middle, end));
}

bool usable(const Polygon& piece) {
    return piece.size() >= 3 && std::all_of(piece.begin(), piece.end(), [](Point2 p) {
               return std::isfinite(p.x_m) && std::isfinite(p.y_m);
           });
}

/// Rings that still meet (one inside another's dropped hole, or touching) become one.
void absorb_inner(std::vector<Polygon>& rings) {
    std::sort(rings.begin(), rings.end(),
              [](const Polygon& a, const Polygon& b) { return area_m2(a) > area_m2(b); });
    std::vector<Polygon> kept;
    for (const Polygon& ring : rings) {
        const bool inside = std::any_of(kept.begin(), kept.end(), [&](const Polygon& outer) {
            return std::all_of(ring.begin(), ring.end(),
                               [&](Point2 p) { return contains(outer, p); });
        });
        if (!inside) kept.push_back(ring);
    }
    rings = std::move(kept);
}

}  // namespace

std::vector<Polygon> union_outline(const std::vector<Polygon>& convex_pieces) {
    std::vector<BoostPolygon> pieces;
    for (const Polygon& piece : convex_pieces) {
        if (!usable(piece)) continue;
        BoostPolygon polygon = to_boost(convex_hull(piece), 0);
        if (polygon.outer().size() >= 4 && bg::area(polygon) >= kSliver_m2) {
            pieces.push_back(std::move(polygon));
        }
    }
    if (pieces.empty()) return {};
    std::vector<Polygon> rings;
    for (const BoostPolygon& polygon : join_range(pieces, 0, pieces.size())) {
        rings.push_back(from_boost(polygon));
    }
    absorb_inner(rings);
    return rings;
}

}  // namespace pulseline::geometry
