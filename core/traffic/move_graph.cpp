#include "core/traffic/move_graph.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <queue>

namespace pulseline::traffic {

TileIndex TileTable::index_of(TileId tile) {
    const auto [it, is_new] = indexes_.try_emplace(tile, static_cast<TileIndex>(ids_.size()));
    if (is_new) ids_.push_back(tile);
    return it->second;
}

TileIndexes TileTable::indexes_of(const TileSet& tiles) {
    TileIndexes result;
    result.reserve(tiles.size());
    for (const TileId tile : tiles) result.push_back(index_of(tile));
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

std::optional<TileIndex> TileTable::find(TileId tile) const {
    const auto it = indexes_.find(tile);
    return it == indexes_.end() ? std::nullopt : std::optional(it->second);
}

TileSet TileTable::ids_of(const TileIndexes& tiles) const {
    TileSet result;
    result.reserve(tiles.size());
    for (const TileIndex tile : tiles) result.push_back(ids_[tile]);
    std::sort(result.begin(), result.end());
    return result;
}

TileIndexes merge(const TileIndexes& a, const TileIndexes& b) {
    TileIndexes result;
    result.reserve(a.size() + b.size());
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    result.shrink_to_fit();  // most is in both, and there is one for each move of a plant
    return result;
}

TileIndexes without(const TileIndexes& a, const TileIndexes& b) {
    TileIndexes result;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
}

bool meet(const TileIndexes& a, const TileIndexes& b) {
    for (auto i = a.begin(), k = b.begin(); i != a.end() && k != b.end();) {
        if (*i == *k) return true;
        *i < *k ? ++i : ++k;
    }
    return false;
}

ShapePtr make_shape(TileIndexes swept, const TileIndexes& stand_before, TileIndexes stand_after) {
    auto shape = std::make_shared<Shape>();
    shape->swept = merge(merge(swept, stand_before), stand_after);
    shape->stand = std::move(stand_after);
    return shape;
}

CompiledGraph compile(const MoveGraph& graph, TileTable& tiles) {
    CompiledGraph result;
    result.places.reserve(graph.places.size());
    for (const Place& place : graph.places) {
        if (place.resting) result.resting.push_back(static_cast<PlaceIndex>(result.places.size()));
        result.places.push_back({tiles.indexes_of(place.stand), place.resting});
    }
    const std::size_t count = graph.places.size();
    result.first_arc.assign(count + 1, 0);
    result.first_back.assign(count + 1, 0);
    for (const Move& move : graph.moves) {
        ++result.first_arc[move.from + 1];
        ++result.first_back[move.to + 1];
    }
    for (std::size_t i = 0; i < count; ++i) {
        result.first_arc[i + 1] += result.first_arc[i];
        result.first_back[i + 1] += result.first_back[i];
    }
    result.arcs.resize(graph.moves.size());
    result.back.resize(graph.moves.size());
    auto next_arc = result.first_arc;
    auto next_back = result.first_back;
    std::map<TileIndexes, std::uint32_t> floors;  // there and back mostly sweep the same
    for (const Move& move : graph.moves) {
        const auto duration = static_cast<float>(move.duration_s);
        auto shape = make_shape(tiles.indexes_of(move.swept), result.places[move.from].stand,
                                result.places[move.to].stand);
        const auto floor =
            floors.emplace(shape->swept, static_cast<std::uint32_t>(floors.size())).first->second;
        result.arcs[next_arc[move.from]++] = {move.to, duration, floor, std::move(shape)};
        result.back[next_back[move.to]++] = {move.from, duration};
    }
    result.floors = static_cast<std::uint32_t>(floors.size());
    return result;
}

std::vector<float> times_to(const CompiledGraph& graph, const std::vector<PlaceIndex>& goals) {
    using Entry = std::pair<float, PlaceIndex>;
    std::vector<float> time(graph.places.size(), std::numeric_limits<float>::infinity());
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (const PlaceIndex goal : goals) {
        time[goal] = 0;
        open.emplace(0.0F, goal);
    }
    while (!open.empty()) {
        const auto [t, place] = open.top();
        open.pop();
        if (t > time[place]) continue;
        for (auto i = graph.first_back[place]; i < graph.first_back[place + 1]; ++i) {
            const auto& [from, duration] = graph.back[i];
            if (t + duration < time[from]) {
                time[from] = t + duration;
                open.emplace(time[from], from);
            }
        }
    }
    return time;
}

}  // namespace pulseline::traffic
