#include "tests/simulation/judge_plant.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pulseline::judge {
namespace {

constexpr double kColumn_m =
    7.5;  // a platform of 10.5 m reaches into the next column, not through it
constexpr double kRow_m = 5.0;

int pick(std::mt19937_64& random, int low, int high) {
    return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1));
}

struct Lanes {
    int columns = 0;
    int rows = 0;
    std::vector<std::pair<int, int>> links;  // between nodes row * columns + column

    Point point(int node) const {
        return {kColumn_m * (node % columns), kRow_m * (node / columns)};
    }
};

/// A grid of lanes with a part of its links missing; what is left hangs together.
Lanes random_lanes(std::mt19937_64& random) {
    Lanes lanes;
    lanes.rows = pick(random, 1, 4);
    lanes.columns = lanes.rows == 1 ? pick(random, 6, 9) : pick(random, 4, 7);
    std::vector<std::pair<int, int>> all;
    for (int r = 0; r < lanes.rows; ++r) {
        for (int c = 0; c < lanes.columns; ++c) {
            const int node = r * lanes.columns + c;
            if (c + 1 < lanes.columns) all.emplace_back(node, node + 1);
            if (r + 1 < lanes.rows) all.emplace_back(node, node + lanes.columns);
        }
    }
    for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[random() % i]);
    std::vector<int> root(static_cast<std::size_t>(lanes.rows * lanes.columns));
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int node) {
        while (root[node] != node) node = root[node];
        return node;
    };
    const int keep_percent = pick(random, 30, 100);
    for (const auto& [a, b] : all) {
        const bool joins = find(a) != find(b);
        if (joins) root[find(a)] = find(b);
        if (joins || pick(random, 0, 99) < keep_percent) lanes.links.emplace_back(a, b);
    }
    return lanes;
}

PlaceIndex add_place(VehicleClass& of_class, Point at, bool resting) {
    of_class.graph.places.push_back({floor_at(of_class, at, kMargin_m), resting});
    of_class.points.push_back(at);
    const auto place = static_cast<PlaceIndex>(of_class.points.size() - 1);
    if (resting) of_class.resting.push_back(place);
    return place;
}

void add_way(VehicleClass& of_class, PlaceIndex a, PlaceIndex b) {
    const TileSet swept =
        floor_between(of_class, of_class.points[a], of_class.points[b], kMargin_m);
    const double time_s = drive_time_s(of_class, of_class.points[a], of_class.points[b]);
    of_class.graph.moves.push_back({a, b, swept, time_s});
    of_class.graph.moves.push_back({b, a, swept, time_s});
}

void add_lanes(VehicleClass& of_class, const Lanes& lanes) {
    for (int n = 0; n < lanes.rows * lanes.columns; ++n) {
        of_class.stations.push_back(add_place(of_class, lanes.point(n), false));
    }
    for (const auto& [a, b] : lanes.links) {
        add_way(of_class, static_cast<PlaceIndex>(a), static_cast<PlaceIndex>(b));
    }
}

/// Two bays above and below each column.
void add_small_bays(VehicleClass& of_class, const Lanes& lanes) {
    for (const bool top : {false, true}) {
        for (int c = 0; c < lanes.columns; ++c) {
            const int node = top ? (lanes.rows - 1) * lanes.columns + c : c;
            const Point at = lanes.point(node);
            const double side = top ? 1 : -1;
            for (const double dx : {-1.5, 1.5}) {
                const auto bay = add_place(of_class, {at.x_m + dx, at.y_m + side * 2.8}, true);
                add_way(of_class, static_cast<PlaceIndex>(node), bay);
            }
        }
    }
}

/// A bay at both ends of every row, a stub station (dead end) beside one of them.
void add_platform_bays(VehicleClass& of_class, const Lanes& lanes) {
    for (int r = 0; r < lanes.rows; ++r) {
        const int left = r * lanes.columns;
        const int right = left + lanes.columns - 1;
        const double reach = 13;
        const Point a = lanes.point(left);
        const Point b = lanes.point(right);
        add_way(of_class, static_cast<PlaceIndex>(left),
                add_place(of_class, {a.x_m - reach, a.y_m}, true));
        add_way(of_class, static_cast<PlaceIndex>(right),
                add_place(of_class, {b.x_m + reach, b.y_m}, true));
    }
}

bool well_formed(const Plant& plant) {
    std::vector<traffic::LayoutClass> classes;
    for (const VehicleClass& c : plant.classes) {
        classes.push_back(
            {c.length_m > 5 ? "platform" : "small", &c.graph, c.stations, c.vehicles, {}});
    }
    return traffic::check_layout(classes).empty();
}

}  // namespace

TileSet floor_at(const VehicleClass& of_class, Point at, double margin_m) {
    return floor_between(of_class, at, at, margin_m);
}

TileSet floor_between(const VehicleClass& of_class, Point from, Point to, double margin_m) {
    std::vector<geometry::Point2> corners;
    for (const Point& p : {from, to}) {
        for (const double dx : {-0.5, 0.5}) {
            for (const double dy : {-0.5, 0.5}) {
                corners.push_back({p.x_m + dx * of_class.length_m, p.y_m + dy * of_class.width_m});
            }
        }
    }
    return traffic::tiles_under(0, {geometry::convex_hull(std::move(corners))}, margin_m);
}

double drive_time_s(const VehicleClass& of_class, Point from, Point to) {
    const double speed_mps = of_class.length_m > 5 ? 0.8 : 1.2;
    return std::hypot(to.x_m - from.x_m, to.y_m - from.y_m) / speed_mps + 1;
}

Plant random_plant(std::mt19937_64& random) {
    for (;;) {
        Plant plant;
        plant.classes.resize(2);
        VehicleClass& small = plant.classes[0];
        VehicleClass& platform = plant.classes[1];
        small.length_m = 1.2;
        small.width_m = 0.8;
        platform.length_m = 10.5;
        platform.width_m = 2.5;
        const Lanes lanes = random_lanes(random);
        add_lanes(small, lanes);
        add_small_bays(small, lanes);
        add_lanes(platform, lanes);
        add_platform_bays(platform, lanes);
        const auto most = static_cast<int>(std::min<std::size_t>(small.resting.size(), 27));
        small.vehicles = static_cast<std::size_t>(pick(random, 5, most));
        platform.vehicles = static_cast<std::size_t>(pick(random, 1, std::min(3, 2 * lanes.rows)));
        if (well_formed(plant)) return plant;
    }
}

}  // namespace pulseline::judge
