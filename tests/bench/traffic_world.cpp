#include "tests/bench/traffic_world.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/traffic/layout_check.hpp"

namespace pulseline::bench {
namespace {

constexpr double kMargin_m = 0.1;
constexpr double kPitch_m = 2.0;  // between places of a hall's lanes

void link(traffic::MoveGraph& graph, PlaceIndex a, PlaceIndex b, traffic::TileSet swept,
          double step_s) {
    graph.moves.push_back({a, b, swept, step_s});
    graph.moves.push_back({b, a, std::move(swept), step_s});
}

bool is_well_formed(const World& world) {
    std::vector<traffic::LayoutClass> classes;
    for (GraphIndex g = 0; g < world.graphs.size(); ++g) {
        traffic::LayoutClass of_graph{"class " + std::to_string(g), &world.graphs[g], {}, 0, {}};
        std::set<PlaceIndex> goals;
        for (const auto& vehicle : world.vehicles) {
            if (vehicle.graph != g) continue;
            ++of_graph.vehicles;
            goals.insert(world.goals[vehicle.zone].begin(), world.goals[vehicle.zone].end());
        }
        of_graph.goals.assign(goals.begin(), goals.end());
        classes.push_back(std::move(of_graph));
    }
    return traffic::check_layout(classes).empty();
}

traffic::TileSet body_between(std::size_t hall, geometry::Point2 a, geometry::Point2 b) {
    std::vector<geometry::Point2> corners;
    for (const auto& p : {a, b}) {
        for (const double dx : {-0.6, 0.6}) {
            for (const double dy : {-0.4, 0.4}) corners.push_back({p.x_m + dx, p.y_m + dy});
        }
    }
    return traffic::tiles_under(hall, {geometry::convex_hull(std::move(corners))}, kMargin_m);
}

/// One hall: lanes along x, joined at both ends and in the middle by lanes along y; bays to rest in
/// on both sides of each lane, stations in the bays between them.
void add_hall(World& world, std::size_t hall) {
    constexpr int kLanes = 10;
    constexpr int kColumns = 26;
    traffic::MoveGraph& graph = world.graphs[0];
    constexpr double kLane_m = 3 * kPitch_m;  // bays of neighbouring lanes lie back to back
    std::vector<std::vector<PlaceIndex>> lane(kLanes, std::vector<PlaceIndex>(kColumns));
    std::vector<geometry::Point2> points;
    const auto first = static_cast<PlaceIndex>(graph.places.size());
    const auto add = [&](double x_m, double y_m, bool resting) {
        const geometry::Point2 p{x_m, y_m};
        graph.places.push_back({body_between(hall, p, p), resting});
        points.push_back(p);
        return static_cast<PlaceIndex>(graph.places.size() - 1);
    };
    const auto join = [&](PlaceIndex a, PlaceIndex b) {
        link(graph, a, b, body_between(hall, points[a - first], points[b - first]), world.step_s);
    };
    for (int l = 0; l < kLanes; ++l) {
        for (int c = 0; c < kColumns; ++c) {
            lane[l][c] = add(kPitch_m * c, kLane_m * l, false);
            if (c > 0) join(lane[l][c - 1], lane[l][c]);
        }
    }
    for (const int c : {0, 1, kColumns / 2 - 1, kColumns / 2, kColumns - 2, kColumns - 1}) {
        for (int l = 0; l + 1 < kLanes; ++l) {
            const double y = kLane_m * l;
            const PlaceIndex a = add(kPitch_m * c, y + kLane_m / 3, false);
            const PlaceIndex b = add(kPitch_m * c, y + 2 * kLane_m / 3, false);
            join(lane[l][c], a);
            join(a, b);
            join(b, lane[l + 1][c]);
        }
    }
    int stations = 0;
    int rests = 0;
    for (int l = 0; l < kLanes; ++l) {
        for (const double side : {-1.0, 1.0}) {
            for (int c = 2; c < kColumns - 2; ++c) {
                if (c == kColumns / 2 - 1 || c == kColumns / 2) continue;
                const bool station = c % 10 == 6;
                if (station ? stations >= 40 : rests >= 200) continue;
                if (!station && c % 2 != 0 && c != 3 && c != 19) continue;  // ten a side
                const PlaceIndex bay = add(kPitch_m * c, kLane_m * l + side * kPitch_m, !station);
                join(lane[l][c], bay);
                if (station) {
                    ++stations;
                    world.goals[hall].push_back(bay);
                } else {
                    ++rests;
                    world.vehicles.push_back({0, bay, hall, false});
                }
            }
        }
    }
}

}  // namespace

int World::steps_of(double duration_s) const {
    return std::max(1, static_cast<int>(std::lround(duration_s / step_s)));
}

double quantile(std::vector<double>& values, double share) {
    if (values.empty()) return 0;
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

World halls_world() {
    World world;
    world.name = "halls";
    world.graphs.resize(1);
    world.goals.resize(5);
    add_hall(world, 0);
    world.well_formed = is_well_formed(world);  // the halls are alike and not connected
    for (std::size_t hall = 1; hall < 5; ++hall) add_hall(world, hall);
    return world;
}

World warehouse_world() {
    World world;
    world.name = "warehouse";
    traffic::MoveGraph& graph = world.graphs.emplace_back();
    world.goals.resize(1);
    // Shelf blocks of 10 x 2 cells between aisles of two cells; the cells of a block that face an
    // aisle are bays, every second one to rest in, the others to pick from.
    constexpr int kBlocksX = 10;
    constexpr int kBlocksY = 20;
    constexpr int kWidth = 2 + kBlocksX * 12;
    constexpr int kHeight = 2 + kBlocksY * 4;
    std::vector<PlaceIndex> cell(kWidth * kHeight, traffic::kNoPlace);
    const auto is_shelf = [](int x, int y) { return x % 12 >= 2 && y % 4 >= 2; };
    std::size_t rests = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const bool rest = is_shelf(x, y) && x % 2 == 0 && rests < 1000;
            if (is_shelf(x, y) && x % 2 == 0 && !rest) continue;
            rests += rest ? 1 : 0;
            const auto place = static_cast<PlaceIndex>(graph.places.size());
            cell[y * kWidth + x] = place;
            const auto tile = static_cast<traffic::TileId>(y * kWidth + x);
            graph.places.push_back({{tile}, rest});
            if (rest) {
                world.vehicles.push_back({0, place, 0});
            } else if (is_shelf(x, y)) {
                world.goals[0].push_back(place);
            }
        }
    }
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const auto join = [&](int bx, int by) {
                if (bx >= kWidth || by >= kHeight) return;
                const PlaceIndex a = cell[y * kWidth + x];
                const PlaceIndex b = cell[by * kWidth + bx];
                if (a == traffic::kNoPlace || b == traffic::kNoPlace) return;
                // A bay opens to the aisle above or below it only.
                if ((is_shelf(x, y) || is_shelf(bx, by)) && by == y) return;
                if (is_shelf(x, y) && is_shelf(bx, by)) return;
                link(graph, a, b, traffic::merge(graph.places[a].stand, graph.places[b].stand),
                     world.step_s);
            };
            join(x + 1, y);
            join(x, y + 1);
        }
    }
    world.well_formed = is_well_formed(world);
    return world;
}

}  // namespace pulseline::bench
