#pragma once

#include <string>
#include <vector>

#include "core/traffic/monitor.hpp"
#include "core/traffic/traffic.hpp"

/// A small floor drawn as text, for tests of traffic. Every character but a blank is a place of one
/// tile; neighbours are linked both ways. 'r' is a resting place. Tile of column c, row r: 100 r +
/// c.
namespace pulseline::traffic {

constexpr double kMove_s = 5;

inline Time at(double t_s) { return time_from_ns(static_cast<std::int64_t>(t_s * 1e9)); }

class Floor {
public:
    explicit Floor(const std::vector<std::string>& rows);

    MoveGraph graph;
    PlaceIndex place(int column, int row) const;
    static TileId tile(int column, int row) { return static_cast<TileId>(100 * row + column); }

private:
    std::vector<std::vector<PlaceIndex>> places_;
};

/// A class of long vehicles on the same drawing: it covers `length` tiles to the right of its place
/// and moves along x by one column.
MoveGraph long_graph(const Floor& floor, const std::vector<std::string>& rows, int length);

/// Traffic on a floor with a monitor that must never complain.
class Hall {
public:
    explicit Hall(const std::vector<std::string>& rows);

    VehicleIndex add(const std::string& name, int column, int row);
    /// Visits in order, each (column, row) for dwell_s.
    Result<Admission> send(VehicleIndex vehicle, const std::vector<std::pair<int, int>>& visits,
                           double dwell_s = 10);
    /// Grants and drives one move of everybody in turn until nobody can go on; true when all plans
    /// have ended. `order` says who comes first.
    bool drive_all(std::vector<VehicleIndex> order = {});
    void watch();
    PlaceIndex place_of(VehicleIndex vehicle) const { return traffic.plan(vehicle).place; }

    Floor floor;
    Traffic traffic;
    Monitor monitor;
    double now_s = 0;
};

}  // namespace pulseline::traffic
