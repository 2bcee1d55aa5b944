#include "tests/core/traffic/traffic_floor.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace pulseline::traffic {

Floor::Floor(const std::vector<std::string>& rows) {
    for (std::size_t r = 0; r < rows.size(); ++r) {
        places_.emplace_back(rows[r].size(), kNoPlace);
        for (std::size_t c = 0; c < rows[r].size(); ++c) {
            if (rows[r][c] == ' ') continue;
            places_[r][c] = static_cast<PlaceIndex>(graph.places.size());
            graph.places.push_back(
                {{tile(static_cast<int>(c), static_cast<int>(r))}, rows[r][c] == 'r'});
        }
    }
    const auto link = [&](PlaceIndex a, PlaceIndex b) {
        const TileSet swept = merge(graph.places[a].stand, graph.places[b].stand);
        graph.moves.push_back({a, b, swept, kMove_s});
        graph.moves.push_back({b, a, swept, kMove_s});
    };
    for (int r = 0; r < static_cast<int>(rows.size()); ++r) {
        for (int c = 0; c < static_cast<int>(rows[r].size()); ++c) {
            if (place(c, r) == kNoPlace) continue;
            if (place(c + 1, r) != kNoPlace) link(place(c, r), place(c + 1, r));
            if (place(c, r + 1) != kNoPlace) link(place(c, r), place(c, r + 1));
        }
    }
}

PlaceIndex Floor::place(int column, int row) const {
    if (row < 0 || row >= static_cast<int>(places_.size())) return kNoPlace;
    if (column < 0 || column >= static_cast<int>(places_[row].size())) return kNoPlace;
    return places_[row][column];
}

MoveGraph long_graph(const Floor& floor, const std::vector<std::string>& rows, int length) {
    MoveGraph graph;
    const auto tiles = [&](int column, int row, int count) {
        TileSet set;
        for (int i = 0; i < count; ++i) set.push_back(Floor::tile(column + i, row));
        return set;
    };
    for (int r = 0; r < static_cast<int>(rows.size()); ++r) {
        PlaceIndex before = kNoPlace;
        for (int c = 0; c + length <= static_cast<int>(rows[r].size()); ++c) {
            bool fits = true;
            for (int i = 0; i < length; ++i) fits &= floor.place(c + i, r) != kNoPlace;
            if (!fits) {
                before = kNoPlace;
                continue;
            }
            const auto here = static_cast<PlaceIndex>(graph.places.size());
            graph.places.push_back({tiles(c, r, length), false});
            if (before != kNoPlace) {
                const TileSet swept = tiles(c - 1, r, length + 1);
                graph.moves.push_back({before, here, swept, 3 * kMove_s});
                graph.moves.push_back({here, before, swept, 3 * kMove_s});
            }
            before = here;
        }
    }
    return graph;
}

Hall::Hall(const std::vector<std::string>& rows) : floor(rows), traffic(true) {
    traffic.add_graph(floor.graph);
}

VehicleIndex Hall::add(const std::string& name, int column, int row) {
    const auto vehicle = traffic.add_vehicle({name, 0, floor.place(column, row), {}}, at(now_s));
    EXPECT_TRUE(vehicle);
    watch();
    return *vehicle;
}

Result<Admission> Hall::send(VehicleIndex vehicle, const std::vector<std::pair<int, int>>& visits,
                             double dwell_s) {
    Task task;
    for (const auto& [column, row] : visits) {
        task.visits.push_back({floor.place(column, row), dwell_s});
    }
    auto admission = traffic.admit(vehicle, task, at(now_s));
    watch();
    return admission;
}

void Hall::watch() {
    for (const auto& violation : monitor.apply(traffic.take_changes())) {
        ADD_FAILURE() << to_string(violation);
    }
    for (const auto& violation : monitor.check_all()) ADD_FAILURE() << to_string(violation);
}

bool Hall::drive_all(std::vector<VehicleIndex> order) {
    if (order.empty()) {
        order.resize(traffic.vehicle_count());
        std::iota(order.begin(), order.end(), VehicleIndex{0});
    }
    for (bool moved = true; moved;) {
        moved = false;
        for (const VehicleIndex v : order) {
            now_s += 1;
            const MoveNumber granted = traffic.extend(v, 1, at(now_s));
            watch();
            if (granted == traffic.plan(v).passed) continue;
            EXPECT_TRUE(traffic.passed(v, granted, at(now_s)));
            watch();
            moved = true;
        }
    }
    for (const VehicleIndex v : order) {
        if (traffic.plan(v).passed != traffic.plan(v).last()) return false;
    }
    return true;
}

}  // namespace pulseline::traffic
