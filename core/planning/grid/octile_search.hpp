#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "core/planning/grid/grid_search.hpp"

namespace pulseline::planning {

/// 8-connected search with a turn cost by angle: a change of direction by a quarter turn costs
/// `cost.turn`, by 45 degrees half of it, by 135 degrees one and a half, back two. A diagonal step
/// is sqrt(2) steps long and needs both cells beside it free (no cutting of corners). For vehicles
/// of one cell on the blocked cells of a map; a cell counts as free when no heading is blocked
/// there. Plain A* with the octile distance as bound; exact.
struct OctileRequest {
    Cell start;
    Cell goal;
    std::optional<int> start_heading = std::nullopt;  // in 45 degrees from east; none: free
    GridCost cost = {};                               // REQUIRES: step >= 0, turn >= 0
    const std::atomic<bool>* cancel = nullptr;
};

struct OctileRoute {
    std::int64_t cost = 0;  // thousandths of k
    double length = 0;      // in cells
    int turn_eighths = 0;   // sum of all changes of direction, in 45 degrees
    std::int64_t expanded = 0;
    std::vector<Cell> cells;
};

/// One thread's search; memory is kept from query to query.
class OctileSearch {
public:
    /// REQUIRES: start and goal inside the map.
    SearchEnd run(const GridMap& map, const OctileRequest& request, OctileRoute& route);

    static constexpr int kHeadings = 8;
    /// By heading in 45 degrees from east towards greater rows.
    static constexpr Cell kOctileStep[kHeadings] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                                    {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    /// Cost of a step; the diagonal's is rounded to a thousandth of k.
    static std::int64_t step_cost(const GridCost& cost, int heading);
    /// Between two headings, 0 to 4.
    static int eighths(int heading, int next);
    static bool may_step(const GridMap& map, Cell from, int heading);

private:
    struct Label {
        std::int64_t cost = 0;
        std::uint32_t stamp = 0;
        std::uint8_t by = 0;
    };
    struct Open {
        std::int64_t estimate;
        std::int64_t cost;
        Cell cell;
        int heading;
        bool operator<(const Open& other) const {
            return estimate != other.estimate ? estimate > other.estimate : cost < other.cost;
        }
    };

    void reach(const GridMap& map, const OctileRequest& request, Cell cell, int heading,
               std::int64_t cost, std::uint8_t by);
    void trace(const GridMap& map, const OctileRequest& request, const Open& goal,
               OctileRoute& route) const;

    std::vector<Label> labels_;
    std::vector<Open> open_;
    std::uint32_t stamp_ = 0;
};

}  // namespace pulseline::planning
