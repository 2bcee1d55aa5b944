#include "core/traffic/layout_check.hpp"

#include <algorithm>
#include <deque>
#include <limits>
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
            if (classes[c].vehicles == 0) continue;  // nobody rests there
            const auto& places = classes[c].graph->places;
            for (PlaceIndex p = 0; p < places.size(); ++p) {
                if (!places[p].resting) continue;
                for (const TileId tile : places[p].stand) at_[tile].push_back(rests_.size());
                rests_.push_back({c, p});
            }
        }
    }

    const std::vector<Rest>& rests() const { return rests_; }

    /// Resting places whose floor the tiles touch and where another than the moving vehicle of
    /// class `c` can rest, each once.
    std::vector<std::size_t> touched(const TileSet& tiles, std::size_t c) const {
        std::set<std::size_t> found;
        for (const TileId tile : tiles) {
            const auto it = at_.find(tile);
            if (it == at_.end()) continue;
            for (const std::size_t rest : it->second) {
                const std::size_t resting = rests_[rest].of_class;
                if (resting != c || classes_[c].vehicles > 1) found.insert(rest);
            }
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

ClassMoves moves_of(const LayoutClass& of_class, std::size_t c, const Crossings& crossings) {
    const MoveGraph& graph = *of_class.graph;
    ClassMoves result;
    result.from.resize(graph.places.size());
    for (const Place& place : graph.places) {
        result.own.push_back(crossings.touched(place.stand, c));
    }
    for (std::size_t m = 0; m < graph.moves.size(); ++m) {
        const Move& move = graph.moves[m];
        result.from[move.from].push_back(m);
        TileSet tiles = merge(move.swept, graph.places[move.from].stand);
        tiles = merge(tiles, graph.places[move.to].stand);
        result.crossed.push_back(crossings.touched(tiles, c));
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

/// The way to a place with the fewest moves that cross a third resting place.
struct Way {
    std::size_t crossings = std::numeric_limits<std::size_t>::max();  // none leads there
    std::size_t first_crossed = 0;  // the resting place, when there are crossings

    /// The same way with one more move, which crosses `rest` or nothing.
    Way onward(const std::optional<std::size_t>& rest) const {
        Way way = *this;
        if (rest && way.crossings++ == 0) way.first_crossed = *rest;
        return way;
    }
};

/// Resting places on the floor where a way begins or ends.
const std::vector<std::size_t>& rests_at(const MoveGraph& graph, const ClassMoves& moves,
                                         PlaceIndex place) {
    static const std::vector<std::size_t> kNone;
    return graph.places[place].resting ? moves.own[place] : kNone;
}

/// Places with a way from `start` that crosses nothing but the resting places of its first and last
/// moves' ends.
std::vector<bool> free_from(const MoveGraph& graph, PlaceIndex start, const ClassMoves& moves) {
    static const std::vector<std::size_t> kNone;
    const auto& own = rests_at(graph, moves, start);
    std::vector<bool> passed(graph.places.size(), false);
    std::vector<bool> arrived(graph.places.size(), false);
    std::vector<PlaceIndex> open{start};
    passed[start] = true;
    while (!open.empty()) {
        const PlaceIndex place = open.back();
        open.pop_back();
        for (const std::size_t m : moves.from[place]) {
            const PlaceIndex to = graph.moves[m].to;
            const auto& end = rests_at(graph, moves, to);
            if (!arrived[to]) arrived[to] = !third(moves.crossed[m], own, end);
            if (passed[to] || third(moves.crossed[m], own, kNone)) continue;
            passed[to] = true;
            open.push_back(to);
        }
    }
    return arrived;
}

/// The ways from `start`, up to `target` if there is one. The search goes on through resting places
/// in the way (0-1 breadth-first), so it knows which one to name. Those at the target are the
/// vehicle's own on all of the way: it may arrive there and turn. Counts the moves it looks at.
std::vector<Way> ways_from(const MoveGraph& graph, PlaceIndex start,
                           std::optional<PlaceIndex> target, const ClassMoves& moves,
                           std::size_t& looked_at) {
    static const std::vector<std::size_t> kNone;
    const auto& own = rests_at(graph, moves, start);
    const auto& end = target ? rests_at(graph, moves, *target) : kNone;
    std::vector<Way> ways(graph.places.size());
    std::deque<std::pair<PlaceIndex, std::size_t>> open{{start, 0}};
    ways[start].crossings = 0;
    while (!open.empty()) {
        const auto [place, crossings] = open.front();
        open.pop_front();
        if (place == target) break;
        const Way here = ways[place];
        if (crossings > here.crossings) continue;
        looked_at += moves.from[place].size();
        for (const std::size_t m : moves.from[place]) {
            const PlaceIndex to = graph.moves[m].to;
            const Way onward = here.onward(third(moves.crossed[m], own, end));
            if (onward.crossings >= ways[to].crossings) continue;
            ways[to] = onward;
            if (onward.crossings == here.crossings) {
                open.emplace_front(to, onward.crossings);
            } else {
                open.emplace_back(to, onward.crossings);
            }
        }
    }
    return ways;
}

// Moves looked at for pairs of places one by one: about a second.
constexpr std::size_t kLooksInFull = 20'000'000;

/// What one class cannot do for one reason, told once with the first pair of places as an example.
struct Unreachable {
    PlaceIndex from = kNoPlace;
    PlaceIndex to = kNoPlace;
    std::int64_t count = 0;
};

void check_ways(const std::vector<LayoutClass>& classes, std::size_t c, const Crossings& crossings,
                std::vector<LayoutViolation>& found) {
    const LayoutClass& of_class = classes[c];
    const MoveGraph& graph = *of_class.graph;
    const ClassMoves moves = moves_of(of_class, c, crossings);
    std::set<PlaceIndex> targets(of_class.goals.begin(), of_class.goals.end());
    for (PlaceIndex p = 0; p < graph.places.size(); ++p) {
        if (graph.places[p].resting) targets.insert(p);
    }
    std::map<std::string, Unreachable> by_crossing;  // by its name, empty: no way at all
    const auto crossing_of = [&](const Way& way) {
        if (way.crossings == Way{}.crossings) return std::string();
        const Rest& rest = crossings.rests()[way.first_crossed];
        return place_name(classes[rest.of_class], rest.place);
    };
    std::size_t looked_at = 0;
    for (const PlaceIndex start : targets) {
        const auto free = free_from(graph, start, moves);
        std::optional<std::vector<Way>> to_all;
        for (const PlaceIndex target : targets) {
            if (target == start || free[target]) continue;
            if (looked_at > kLooksInFull) {
                // Where thousands of pairs are barred, one more with the same thing in its way is
                // only counted.
                if (!to_all) to_all = ways_from(graph, start, std::nullopt, moves, looked_at);
                const auto known = by_crossing.find(crossing_of((*to_all)[target]));
                if (known != by_crossing.end()) {
                    ++known->second.count;
                    continue;
                }
            }
            const Way way = ways_from(graph, start, target, moves, looked_at)[target];
            if (way.crossings == 0) continue;
            const std::string crossing = crossing_of(way);
            Unreachable& group = by_crossing[crossing];
            if (group.count++ == 0) {
                group.from = start;
                group.to = target;
            }
        }
    }
    for (const auto& [crossing, group] : by_crossing) {
        Reason reason{kLayoutUnreachable,
                      {{"class", of_class.name},
                       {"from", place_name(of_class, group.from)},
                       {"to", place_name(of_class, group.to)},
                       {"count", group.count}}};
        if (!crossing.empty()) reason.params.push_back({"crossing", crossing});
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
        if (classes[c].vehicles > 0) check_ways(classes, c, crossings, found);
    }
    return found;
}

}  // namespace pulseline::traffic
