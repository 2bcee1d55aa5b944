#include "core/geometry/convex.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::geometry {
namespace {

bool in_triangle(Point2 p, Point2 a, Point2 b, Point2 c) {
    return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

bool on_segment(Point2 p, Point2 a, Point2 b) {
    return cross(b - a, p - a) == 0 && dot(p - a, p - b) <= 0;
}

bool segments_meet(Point2 a, Point2 b, Point2 c, Point2 d) {
    const double c_side = cross(b - a, c - a);
    const double d_side = cross(b - a, d - a);
    const double a_side = cross(d - c, a - c);
    const double b_side = cross(d - c, b - c);
    if (c_side * d_side < 0 && a_side * b_side < 0) return true;
    return on_segment(c, a, b) || on_segment(d, a, b) || on_segment(a, c, d) || on_segment(b, c, d);
}

using Indices = std::vector<std::size_t>;

/// Triangles of a simple counter-clockwise polygon; empty when rounding left no ear.
std::vector<Indices> triangulate(const Polygon& polygon) {
    Indices rest(polygon.size());
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = i;
    std::vector<Indices> triangles;
    while (rest.size() > 3) {
        bool clipped = false;
        for (std::size_t i = 0; i < rest.size() && !clipped; ++i) {
            const std::size_t a = rest[(i + rest.size() - 1) % rest.size()];
            const std::size_t b = rest[i];
            const std::size_t c = rest[(i + 1) % rest.size()];
            const double turn = cross(polygon[b] - polygon[a], polygon[c] - polygon[b]);
            if (turn < 0) continue;
            const bool ear = std::none_of(rest.begin(), rest.end(), [&](std::size_t k) {
                return k != a && k != b && k != c && turn > 0 &&
                       in_triangle(polygon[k], polygon[a], polygon[b], polygon[c]);
            });
            if (!ear) continue;
            if (turn > 0) triangles.push_back({a, b, c});
            rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
            clipped = true;
        }
        if (!clipped) return {};
    }
    triangles.push_back(rest);
    return triangles;
}

bool is_convex(const Polygon& polygon, const Indices& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point2 a = polygon[ring[i]];
        const Point2 b = polygon[ring[(i + 1) % ring.size()]];
        const Point2 c = polygon[ring[(i + 2) % ring.size()]];
        if (cross(b - a, c - b) < 0) return false;
    }
    return true;
}

/// Both rings as one over a shared edge, when the result is convex.
bool merge(const Polygon& polygon, const Indices& a, const Indices& b, Indices& joined) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        const std::size_t from = a[i];
        const std::size_t to = a[(i + 1) % a.size()];
        for (std::size_t j = 0; j < b.size(); ++j) {
            if (b[j] != to || b[(j + 1) % b.size()] != from) continue;
            joined.clear();
            for (std::size_t k = 1; k <= a.size(); ++k) joined.push_back(a[(i + k) % a.size()]);
            for (std::size_t k = 2; k < b.size(); ++k) joined.push_back(b[(j + k) % b.size()]);
            return is_convex(polygon, joined);
        }
    }
    return false;
}

void merge_all(const Polygon& polygon, std::vector<Indices>& pieces) {
    Indices joined;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (std::size_t j = i + 1; j < pieces.size();) {
            if (merge(polygon, pieces[i], pieces[j], joined)) {
                pieces[i] = joined;
                pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
                j = i + 1;
            } else {
                ++j;
            }
        }
    }
}

}  // namespace

bool is_simple(const Polygon& polygon) {
    const std::size_t n = polygon.size();
    if (n < 3) return false;
    for (std::size_t i = 0; i < n; ++i) {
        const Point2 a = polygon[i];
        const Point2 b = polygon[(i + 1) % n];
        if (a == b) return false;
        // The next edge may only share the corner: it must not fold back.
        const Point2 c = polygon[(i + 2) % n];
        if (cross(b - a, c - b) == 0 && dot(b - a, c - b) < 0) return false;
        for (std::size_t j = i + 2; j < n; ++j) {
            if (i == 0 && j == n - 1) continue;
            if (segments_meet(a, b, polygon[j], polygon[(j + 1) % n])) return false;
        }
    }
    return signed_area(polygon) != 0;
}

std::vector<Polygon> convex_pieces(const Polygon& polygon) {
    if (!is_simple(polygon)) return {convex_hull(polygon)};
    Polygon ccw = polygon;
    if (signed_area(ccw) < 0) std::reverse(ccw.begin(), ccw.end());
    std::vector<Indices> pieces = triangulate(ccw);
    if (pieces.empty()) return {convex_hull(polygon)};
    merge_all(ccw, pieces);
    std::vector<Polygon> result;
    for (const Indices& piece : pieces) {
        Polygon ring;
        for (const std::size_t i : piece) ring.push_back(ccw[i]);
        result.push_back(std::move(ring));
    }
    return result;
}

Polygon clipped(const Polygon& convex, const Box& box) {
    Polygon left = convex;
    // One side after the other: `inside` is how far a corner is on the good side of it.
    const auto cut = [&left](auto inside) {
        Polygon kept;
        for (std::size_t i = 0; i < left.size(); ++i) {
            const Point2& a = left[i];
            const Point2& b = left[(i + 1) % left.size()];
            const double at_a = inside(a);
            const double at_b = inside(b);
            if (at_a >= 0) kept.push_back(a);
            if ((at_a >= 0) == (at_b >= 0)) continue;
            const double share = at_a / (at_a - at_b);
            kept.push_back({a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m)});
        }
        left = std::move(kept);
    };
    cut([&](const Point2& p) { return p.x_m - box.min.x_m; });
    cut([&](const Point2& p) { return box.max.x_m - p.x_m; });
    cut([&](const Point2& p) { return p.y_m - box.min.y_m; });
    cut([&](const Point2& p) { return box.max.y_m - p.y_m; });
    return left;
}

}  // namespace pulseline::geometry
