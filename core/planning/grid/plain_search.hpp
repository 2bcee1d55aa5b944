#pragma once

#include "core/planning/grid/grid_search.hpp"

namespace pulseline::planning {

/// Plain A* over (cell, direction): binary heap, 64-bit costs. Simple on purpose: it takes every
/// map and every cost, and is what the faster searches are measured and checked against. Without
/// its bound it is Dijkstra's search.
class PlainSearch {
public:
    SearchEnd run(const GridMap& map, const GridRequest& request, bool use_bound, GridRoute& route);
    void prepare(const GridMap& map);
    std::size_t bytes() const;

private:
    static constexpr std::uint8_t kFirstStep = 4;  // out of the start, heading free
    static constexpr std::uint8_t kStart = 5;      // stands there with its heading

    struct Label {
        std::int64_t cost = 0;
        std::uint32_t stamp = 0;
        std::uint8_t by = 0;  // direction before the step
    };
    struct Open {
        std::int64_t estimate;
        std::int64_t cost;
        std::uint32_t state;
        Cell cell;
        /// For the heap: least estimate on top, of equals the farthest on.
        bool operator<(const Open& other) const {
            return estimate != other.estimate ? estimate > other.estimate : cost < other.cost;
        }
    };

    void reach(const GridMap& map, Cell cell, int heading, std::int64_t cost, std::uint8_t by);
    void trace(const GridMap& map, const GridRequest& request, const Open& goal,
               GridRoute& route) const;

    std::vector<Label> labels_;
    std::vector<Open> open_;
    std::uint32_t stamp_ = 0;
    bool use_bound_ = true;
    std::optional<FloorBound<std::int64_t>> bound_;
};

}  // namespace pulseline::planning
