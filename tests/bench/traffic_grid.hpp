#pragma once

#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "core/traffic/move_graph.hpp"

namespace pulseline::bench {

/// Neighbours and distances in moves for the baselines.
class Grid {
public:
    explicit Grid(const traffic::MoveGraph& graph)
        : graph_(graph), next_(graph.places.size()), before_(graph.places.size()) {
        for (const auto& move : graph.moves) {
            next_[move.from].push_back(move.to);
            before_[move.to].push_back(move.from);  // roads may lead one way only
        }
    }
    const std::vector<traffic::PlaceIndex>& next(traffic::PlaceIndex place) const {
        return next_[place];
    }

    /// Moves from every place to the goal; `rests` that are crossed count as walls but for `own`.
    std::vector<std::uint16_t> distances(traffic::PlaceIndex goal, bool cross_rests,
                                         traffic::PlaceIndex own) const {
        std::vector<std::uint16_t> distance(next_.size(),
                                            std::numeric_limits<std::uint16_t>::max());
        std::vector<traffic::PlaceIndex> open{goal};
        distance[goal] = 0;
        for (std::size_t i = 0; i < open.size(); ++i) {
            const traffic::PlaceIndex place = open[i];
            if (!cross_rests && place != goal && graph_.places[place].resting) continue;
            for (const traffic::PlaceIndex other : before_[place]) {
                if (distance[other] != std::numeric_limits<std::uint16_t>::max()) continue;
                const bool wall = !cross_rests && graph_.places[other].resting && other != own;
                if (wall) continue;
                distance[other] = static_cast<std::uint16_t>(distance[place] + 1);
                open.push_back(other);
            }
        }
        return distance;
    }

    const std::vector<std::uint16_t>& to(traffic::PlaceIndex goal) {
        auto& table = tables_[goal];
        if (table.empty()) table = distances(goal, true, traffic::kNoPlace);
        return table;
    }

private:
    const traffic::MoveGraph& graph_;
    std::vector<std::vector<traffic::PlaceIndex>> next_;
    std::vector<std::vector<traffic::PlaceIndex>> before_;
    std::unordered_map<traffic::PlaceIndex, std::vector<std::uint16_t>> tables_;
};

}  // namespace pulseline::bench
