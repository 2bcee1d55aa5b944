#include "core/planning/grid/grid_blocking.hpp"

#include <algorithm>
#include <deque>
#include <limits>

namespace pulseline::planning {
namespace {

/// Search over (cell, heading) that counts what it drives through.
class Clearing {
public:
    explicit Clearing(const GridMap& map)
        : layers_(map.layers()),
          known_(static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()) *
                 kDirections) {}

    std::optional<std::vector<BlockingCell>> run(const GridRequest& request) {
        for (int d = 0; d < kDirections; ++d) {
            if (request.start_heading && static_cast<int>(*request.start_heading) != d) continue;
            reach(request.start, d, blocks(request.start, d), kNone);
        }
        while (!open_.empty()) {
            const Entry top = open_.front();
            open_.pop_front();
            if (top.count != known(top.cell, top.heading).count) continue;
            if (top.cell == request.goal) return collect(top);
            expand(top);
        }
        return std::nullopt;
    }

private:
    static constexpr std::uint8_t kNone = kDirections;

    struct Known {
        int count = std::numeric_limits<int>::max();
        std::uint8_t before = kNone;  // heading in the cell before; equal cell: turned here
        bool turned = false;
    };
    struct Entry {
        Cell cell;
        int heading;
        int count;
    };

    Known& known(Cell cell, int heading) {
        return known_[layers_.index(cell) * kDirections + static_cast<std::size_t>(heading)];
    }
    int blocks(Cell cell, int heading) const {
        return layers_.is_blocked(static_cast<Direction>(heading), cell) ? 1 : 0;
    }
    /// A cell that is counted for the heading it was entered with is cleared altogether.
    int turn_blocks(Cell cell, int heading, int next) const {
        if (blocks(cell, heading) != 0) return 0;
        return layers_.no_turn.test(cell) || blocks(cell, next) != 0 ? 1 : 0;
    }

    void reach(Cell cell, int heading, int count, std::uint8_t before, bool turned = false) {
        Known& label = known(cell, heading);
        if (count >= label.count) return;
        const bool first = open_.empty() || count <= open_.front().count;
        label = {count, before, turned};
        if (first) {
            open_.push_front({cell, heading, count});
        } else {
            // Counts in the queue span three values at most: look for the place from the back.
            auto place = open_.end();
            while (place != open_.begin() && std::prev(place)->count > count) --place;
            open_.insert(place, {cell, heading, count});
        }
    }

    void expand(const Entry& at) {
        const auto heading = static_cast<std::uint8_t>(at.heading);
        for (int d = 0; d < kDirections; ++d) {
            if (d == at.heading) continue;
            reach(at.cell, d, at.count + turn_blocks(at.cell, at.heading, d), heading, true);
        }
        const Cell step = kStep[heading];
        const Cell next{at.cell.col + step.col, at.cell.row + step.row};
        const BitGrid& no_exit = layers_.no_exit[heading];
        if (!layers_.inside(next) || (!no_exit.empty() && no_exit.test(at.cell))) return;
        reach(next, at.heading, at.count + blocks(next, at.heading), heading);
    }

    std::vector<BlockingCell> collect(const Entry& goal) {
        std::vector<BlockingCell> cells;
        Cell cell = goal.cell;
        int heading = goal.heading;
        while (true) {
            const Known label = known(cell, heading);
            const auto way = static_cast<Direction>(heading);
            const bool counted = label.turned ? turn_blocks(cell, label.before, heading) != 0
                                              : blocks(cell, heading) != 0;
            if (counted) cells.push_back({cell, way, blocks(cell, heading) == 0});
            if (label.before == kNone) break;
            if (!label.turned) {
                const Cell step = kStep[static_cast<std::size_t>(heading)];
                cell = {cell.col - step.col, cell.row - step.row};
            }
            heading = label.before;
        }
        std::reverse(cells.begin(), cells.end());
        return cells;
    }

    const GridLayers& layers_;
    std::vector<Known> known_;
    std::deque<Entry> open_;
};

}  // namespace

std::optional<std::vector<BlockingCell>> blocking_cells(const GridMap& map,
                                                        const GridRequest& request) {
    return Clearing(map).run(request);
}

}  // namespace pulseline::planning
