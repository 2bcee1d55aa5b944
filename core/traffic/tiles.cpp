#include "core/traffic/tiles.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

// A piece grown by the margin (a polygon around the rounded shape) is convex, so its tiles in one
// row are one run: between the least and the greatest x of the piece within the row.
namespace pulseline::traffic {
namespace {

using geometry::Point2;
using geometry::Polygon;

constexpr int kCoordinateBits = 24;  // +-4,194 km in tiles of 0.5 m
constexpr std::int64_t kOffset = std::int64_t{1} << (kCoordinateBits - 1);
constexpr std::uint64_t kMask = (std::uint64_t{1} << kCoordinateBits) - 1;
constexpr TileId kStorey = TileId{1} << 63;  // beyond all indexes of halls
constexpr double kTouch_m = 1e-9;            // rounding: touching counts
constexpr int kCorners = 8;  // of the polygon around the margin's circle: 8 % too large

TileId tile_id(std::size_t hall, std::int64_t col, std::int64_t row) {
    const auto place = [](std::int64_t index) {
        return static_cast<std::uint64_t>(
            std::clamp(index + kOffset, std::int64_t{0}, static_cast<std::int64_t>(kMask)));
    };
    return static_cast<TileId>(hall) << (2 * kCoordinateBits) | place(row) << kCoordinateBits |
           place(col);
}

/// Of the outermost tile for all that lies beyond it, and for what is no number.
std::int64_t index_of(double coordinate_m) {
    constexpr auto kMost = static_cast<double>(kOffset - 1);
    const double index = std::floor(coordinate_m / kTile_m);
    return static_cast<std::int64_t>(index < kMost ? std::max(index, -kMost) : kMost);
}

/// Counterclockwise from the lowest corner, as a convex polygon's edges are sorted by angle.
Polygon from_lowest(const Polygon& convex) {
    Polygon turned = convex;
    if (geometry::signed_area(turned) < 0) std::reverse(turned.begin(), turned.end());
    const auto lowest = std::min_element(turned.begin(), turned.end(), [](Point2 a, Point2 b) {
        return a.y_m != b.y_m ? a.y_m < b.y_m : a.x_m < b.x_m;
    });
    std::rotate(turned.begin(), lowest, turned.end());
    return turned;
}

/// Around a circle of radius 1 m.
const Polygon& unit_circle() {
    static const Polygon kCircle = [] {
        Polygon corners;
        for (int i = 0; i < kCorners; ++i) {
            const double angle = 2 * kPi * i / kCorners;
            corners.push_back({std::cos(angle) / std::cos(kPi / kCorners),
                               std::sin(angle) / std::cos(kPi / kCorners)});
        }
        return from_lowest(corners);
    }();
    return kCircle;
}

/// Minkowski sum of the piece and the margin's circle: both have their edges sorted by angle, so
/// the edges of the sum are theirs, merged.
Polygon grown(const Polygon& piece, double margin_m) {
    if (margin_m <= 0) return piece;
    const Polygon body = from_lowest(piece);
    const Polygon& circle = unit_circle();
    const auto edge = [](const Polygon& ring, std::size_t i) {
        return ring[(i + 1) % ring.size()] - ring[i];
    };
    Polygon sum;
    sum.reserve(body.size() + circle.size());
    for (std::size_t i = 0, j = 0; i < body.size() || j < circle.size();) {
        sum.push_back(body[i % body.size()] + margin_m * circle[j % circle.size()]);
        const bool of_body =
            j == circle.size() || (i < body.size() && cross(edge(body, i), edge(circle, j)) >= 0);
        ++(of_body ? i : j);
    }
    return sum;
}

struct Run {
    double min_m = std::numeric_limits<double>::infinity();
    double max_m = -std::numeric_limits<double>::infinity();
    void add(double x_m) {
        min_m = std::min(min_m, x_m);
        max_m = std::max(max_m, x_m);
    }
};

/// Rows of a piece with the run of x that the piece has in each.
std::vector<Run> runs_of(const Polygon& piece, std::int64_t first_row, std::int64_t last_row) {
    std::vector<Run> runs(static_cast<std::size_t>(last_row - first_row + 1));
    const auto add = [&](std::int64_t row, double x_m) {
        if (row >= first_row && row <= last_row) {
            runs[static_cast<std::size_t>(row - first_row)].add(x_m);
        }
    };
    for (std::size_t i = 0; i < piece.size(); ++i) {
        Point2 a = piece[i];
        Point2 b = piece[(i + 1) % piece.size()];
        if (a.y_m > b.y_m) std::swap(a, b);
        for (const Point2& p : {a, b}) {
            for (std::int64_t row = index_of(p.y_m - kTouch_m); row <= index_of(p.y_m + kTouch_m);
                 ++row) {
                add(row, p.x_m);
            }
        }
        // Where the edge crosses from a row into the next, both have that x.
        for (std::int64_t row = index_of(a.y_m) + 1; row <= index_of(b.y_m); ++row) {
            const double y = static_cast<double>(row) * kTile_m;
            const double x = a.x_m + (y - a.y_m) / (b.y_m - a.y_m) * (b.x_m - a.x_m);
            add(row - 1, x);
            add(row, x);
        }
    }
    return runs;
}

}  // namespace

TileSet tiles_under(std::size_t hall_index, const std::vector<Polygon>& pieces, double margin_m) {
    // Pieces of a sweep overlap a lot: their runs are joined before they become tiles.
    struct Columns {
        std::int64_t row;
        std::int64_t first;
        std::int64_t last;
    };
    std::vector<Columns> columns;
    for (const Polygon& piece : pieces) {
        if (piece.empty()) continue;
        const Polygon area = grown(piece, margin_m);
        const geometry::Box box = geometry::bounding_box(area);
        // What lies nowhere covers no floor; its rows would have no end.
        if (!std::isfinite(box.min.x_m + box.min.y_m + box.max.x_m + box.max.y_m)) continue;
        const std::int64_t first_row = index_of(box.min.y_m - kTouch_m);
        const std::int64_t last_row = index_of(box.max.y_m + kTouch_m);
        const auto runs = runs_of(area, first_row, last_row);
        for (std::size_t i = 0; i < runs.size(); ++i) {
            if (runs[i].min_m > runs[i].max_m) continue;
            columns.push_back({first_row + static_cast<std::int64_t>(i),
                               index_of(runs[i].min_m - kTouch_m),
                               index_of(runs[i].max_m + kTouch_m)});
        }
    }
    std::sort(columns.begin(), columns.end(), [](const Columns& a, const Columns& b) {
        return a.row != b.row ? a.row < b.row : a.first < b.first;
    });
    TileSet tiles;
    for (std::size_t i = 0; i < columns.size();) {
        const std::int64_t row = columns[i].row;
        std::int64_t next = columns[i].first;
        for (; i < columns.size() && columns[i].row == row; ++i) {
            for (next = std::max(next, columns[i].first); next <= columns[i].last; ++next) {
                tiles.push_back(tile_id(hall_index, next, row));
            }
        }
    }
    return tiles;
}

TileId above(TileId tile) { return tile | kStorey; }

bool is_above_floor(TileId tile) { return (tile & kStorey) != 0; }

geometry::Box tile_box(TileId tile) {
    const auto index = [](TileId bits) {
        return static_cast<double>(static_cast<std::int64_t>(bits & kMask) - kOffset);
    };
    const Point2 min{kTile_m * index(tile), kTile_m * index(tile >> kCoordinateBits)};
    return {min, {min.x_m + kTile_m, min.y_m + kTile_m}};
}

TileSet merge(const TileSet& a, const TileSet& b) {
    TileSet result;
    result.reserve(a.size() + b.size());
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
}

bool overlap(const TileSet& a, const TileSet& b) {
    for (auto x = a.begin(), y = b.begin(); x != a.end() && y != b.end();) {
        if (*x == *y) return true;
        *x < *y ? ++x : ++y;
    }
    return false;
}

}  // namespace pulseline::traffic
