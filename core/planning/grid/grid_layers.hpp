#pragma once

#include <array>
#include <vector>

#include "core/planning/grid/bit_grid.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::planning {

/// Where vehicles of one class may be and how they may move: the search's whole view of a hall.
struct GridLayers {
    int width = 0;
    int height = 0;
    std::array<BitGrid, kDirections> blocked;  // 1: not there with that heading
    BitGrid no_turn;                           // 1: no change of heading there
    std::array<BitGrid, kDirections> no_exit;  // 1: not out of the cell that way; empty: no one-way
    std::vector<std::uint8_t> weight;  // by row, times the cost of a step into the cell, >= 1;
                                       // empty: 1 everywhere

    bool inside(Cell cell) const { return blocked[0].inside(cell); }
    std::size_t index(Cell cell) const {
        return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(cell.col);
    }
    bool is_blocked(Direction heading, Cell cell) const {
        return blocked[static_cast<std::size_t>(heading)].test(cell);
    }
    /// Makes a cell one-way: it may be entered from any side and left along `way` only.
    void make_one_way(Cell cell, Direction way);
    std::size_t bytes() const;
};

/// A vehicle of one cell that turns anywhere.
GridLayers point_layers(const plant::OccupancyGrid& grid);

/// Layers of a vehicle with a body, kept up to date with the map.
///
/// A cell is blocked for a heading when the body there, swept half a cell back and ahead and grown
/// by the clearance, touches an occupied cell (outside the grid counts as occupied); turning needs
/// the circle around the body. Conservative by less than a cell.
class FootprintLayers {
public:
    /// `body`: convex pieces, body frame; its centre stands in cell centres.
    FootprintLayers(const plant::OccupancyGrid& grid, const std::vector<geometry::Polygon>& body,
                    double clearance_m);

    const GridLayers& layers() const { return layers_; }

    /// Edits the map and answers which part of the layers may have changed. Work is proportional to
    /// the body's cells. REQUIRES: the cell is inside.
    CellBox set_occupied(Cell cell, bool occupied);

    /// Cells that the shape touches in one row, relative to the body's centre.
    struct Run {
        int row = 0;
        int first = 0;
        int last = -1;
    };

private:
    static constexpr std::size_t kTurnLayer = kDirections;

    BitGrid& layer(std::size_t i) { return i == kTurnLayer ? layers_.no_turn : layers_.blocked[i]; }
    bool touches(const std::vector<Run>& runs, Cell at) const;

    BitGrid occupied_;
    GridLayers layers_;
    std::array<std::vector<Run>, kDirections + 1> runs_;  // by heading, then turning
};

}  // namespace pulseline::planning
