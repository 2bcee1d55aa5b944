#include "core/traffic/layout_check.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace pulseline::traffic {
namespace {

/// A resting place of some class.
struct Rest {
    std::size_t of_class;
    PlaceIndex place;
};

std::string place_name(const LayoutClass& of_class, PlaceIndex place) {
    return place < of_class.place_names.size() ? of_class.place_names[place]
                                               : std::to_string(place);
}

/// Which resting places have which floor, and what the moves of each class cross.
class Crossings {
public:
    explicit Crossings(const std::vector<LayoutClass>& classes) : classes_(classes) {
        for (std::size_t c = 0; c < classes.size(); ++c) {
            const auto& places = classes[c].graph->places;
            for (PlaceIndex p = 0; p < places.size(); ++p) {
                if (!places[p].resting) continue;
                for (const TileId tile : places[p].stand) at_[tile].push_back(rests_.size());
                rests_.push_back({c, p});
            }
        }
    }

    const std::vector<Rest>& rests() const { return rests_; }

    /// Resting places whose floor the tiles touch, each once.
    std::vector<std::size_t> touched(const TileSet& tiles) const {
        std::set<std::size_t> found;
        for (const TileId tile : tiles) {
            const auto it = at_.find(tile);
            if (it != at_.end()) found.insert(it->second.begin(), it->second.end());
        }
        return {found.begin(), found.end()};
    }

    /// Groups of resting places that share floor: one vehicle each.
    std::vector<std::size_t> groups() const {
        std::vector<std::size_t> parent(rests_.size());
        std::iota(parent.begin(), parent.end(), std::size_t{0});
        const auto root = [&](std::size_t i) {
            while (parent[i] != i) i = parent[i] = parent[parent[i]];
            return i;
        };
        for (const auto& [tile, here] : at_) {
            for (const std::size_t rest : here) parent[root(rest)] = root(here.front());
        }
        for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
        return parent;
    }

private:
    const std::vector<LayoutClass>& classes_;
    std::vector<Rest> rests_;
    std::map<TileId, std::vector<std::size_t>> at_;
};

/// Moves of one class with the resting places that they cross.
struct ClassMoves {
    std::vector<std::vector<std::size_t>> crossed;  // by move
    std::vector<std::vector<std::size_t>> from;     // moves by place
    std::vector<std::vector<std::size_t>> own;      // by place: resting places sharing its floor
};

ClassMoves moves_of(const LayoutClass& of_class, const Crossings& crossings) {
    const MoveGraph& graph = *of_class.graph;
    ClassMoves result;
    result.from.resize(graph.places.size());
    for (const Place& place : graph.places) result.own.push_back(crossings.touched(place.stand));
    for (std::size_t m = 0; m < graph.moves.size(); ++m) {
        const Move& move = graph.moves[m];
        result.from[move.from].push_back(m);
        TileSet tiles = merge(move.swept, graph.places[move.from].stand);
        result.crossed.push_back(crossings.touched(merge(tiles, graph.places[move.to].stand)));
    }
    return result;
}

bool has(const std::vector<std::size_t>& sorted, std::size_t value) {
    return std::binary_search(sorted.begin(), sorted.end(), value);
}

/// The first resting place that a move crosses and that belongs to neither end of the way.
std::optional<std::size_t> third(const std::vector<std::size_t>& crossed,
                                 const std::vector<std::size_t>& start,
                                 const std::vector<std::size_t>& end) {
    for (const std::size_t rest : crossed) {
        if (!has(start, rest) && !has(end, rest)) return rest;
    }
    return std::nullopt;
}

void check_from(const std::vector<LayoutClass>& classes, std::size_t c, PlaceIndex start,
                const ClassMoves& moves, const Crossings& crossings,
                const std::set<PlaceIndex>& targets, std::vector<LayoutViolation>& found) {
    const MoveGraph& graph = *classes[c].graph;
    static const std::vector<std::size_t> kNone;
    const bool from_goal = !graph.places[start].resting;
    const auto& own = from_goal ? kNone : moves.own[start];
    std::vector<bool> reached(graph.places.size(), false);
    std::vector<bool> arrived(graph.places.size(), false);  // as the end of the way
    std::map<PlaceIndex, std::size_t> crossing;             // what kept it from a target
    std::vector<PlaceIndex> open{start};
    reached[start] = true;
    while (!open.empty()) {
        const PlaceIndex place = open.back();
        open.pop_back();
        for (const std::size_t m : moves.from[place]) {
            const PlaceIndex to = graph.moves[m].to;
            if (targets.count(to) != 0 && !arrived[to]) {
                const auto& end = graph.places[to].resting ? moves.own[to] : kNone;
                if (const auto rest = third(moves.crossed[m], own, end)) {
                    crossing.emplace(to, *rest);
                } else {
                    arrived[to] = true;
                }
            }
            if (reached[to] || third(moves.crossed[m], own, kNone)) continue;
            reached[to] = true;
            open.push_back(to);
        }
    }
    for (const PlaceIndex target : targets) {
        if (target == start || arrived[target]) continue;
        Reason reason{"unreachable",
                      {{"class", classes[c].name},
                       {"from", place_name(classes[c], start)},
                       {"to", place_name(classes[c], target)}}};
        if (const auto it = crossing.find(target); it != crossing.end()) {
            const Rest& rest = crossings.rests()[it->second];
            reason.params.push_back({"crossing", place_name(classes[rest.of_class], rest.place)});
        }
        found.push_back({std::move(reason)});
    }
}

void check_counts(const std::vector<LayoutClass>& classes, const Crossings& crossings,
                  std::vector<LayoutViolation>& found) {
    const auto groups = crossings.groups();
    const auto complain = [&](const std::string& name, std::size_t places, std::size_t vehicles) {
        found.push_back({{"too_few_resting_places",
                          {{"class", name},
                           {"resting_places", static_cast<std::int64_t>(places)},
                           {"vehicles", static_cast<std::int64_t>(vehicles)}}}});
    };
    std::size_t vehicles = 0;
    for (std::size_t c = 0; c < classes.size(); ++c) {
        std::set<std::size_t> own;
        for (std::size_t i = 0; i < groups.size(); ++i) {
            if (crossings.rests()[i].of_class == c) own.insert(groups[i]);
        }
        vehicles += classes[c].vehicles;
        if (own.size() < classes[c].vehicles) {
            complain(classes[c].name, own.size(), classes[c].vehicles);
        }
    }
    const std::size_t all = std::set<std::size_t>(groups.begin(), groups.end()).size();
    if (all < vehicles) complain("", all, vehicles);
}

}  // namespace

std::vector<LayoutViolation> check_layout(const std::vector<LayoutClass>& classes) {
    std::vector<LayoutViolation> found;
    const Crossings crossings(classes);
    check_counts(classes, crossings, found);
    for (std::size_t c = 0; c < classes.size(); ++c) {
        if (classes[c].vehicles == 0) continue;
        const ClassMoves moves = moves_of(classes[c], crossings);
        std::set<PlaceIndex> targets(classes[c].goals.begin(), classes[c].goals.end());
        for (PlaceIndex p = 0; p < classes[c].graph->places.size(); ++p) {
            if (classes[c].graph->places[p].resting) targets.insert(p);
        }
        for (const PlaceIndex start : targets) {
            check_from(classes, c, start, moves, crossings, targets, found);
        }
    }
    return found;
}

}  // namespace pulseline::traffic
