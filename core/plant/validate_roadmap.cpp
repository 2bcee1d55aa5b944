#include <algorithm>
#include <set>

#include "core/geometry/convex.hpp"
#include "core/plant/validate_parts.hpp"

namespace pulseline::plant::detail {
namespace {

constexpr double kNodeAtStation_m = 0.5;  // further apart, the last edge would not end at the stop

void check_nodes(const Plant& plant, const Index& index, Faults& faults) {
    for (std::size_t i = 0; i < plant.nodes.size(); ++i) {
        const RoadmapNode& node = plant.nodes[i];
        const auto* hall = look_up(index.halls, node.hall);
        if (hall == nullptr) {
            faults.add(at("roadmap/nodes", i, "/hall"), "unknown_hall",
                       "There is no hall " + quoted(node.hall.str()) + ".",
                       "Correct the name or add it to the plant.");
        } else if (!geometry::contains((*hall)->outline, node.position)) {
            faults.add(at("roadmap/nodes", i, "/position"), "outside_hall",
                       "The node lies outside its hall.", "Correct the position or the hall.");
        }
    }
}

/// A vehicle sees walls and obstacles when it leaves its lane, but nobody sees a no-go area.
void check_corridor(const Plant& plant, std::size_t i, const RoadmapNode& from,
                    const RoadmapNode& to, Faults& faults) {
    const auto& corridor = plant.edges[i].corridor;
    if (!corridor || !(corridor->left_m > 0) || !(corridor->right_m > 0)) return;
    const Polygon band = corridor_band(from.position, to.position, *corridor, 0);
    for (const Area& area : plant.areas) {
        if (area.kind != AreaKind::kNoGo || area.hall != from.hall) continue;
        const auto pieces = geometry::convex_pieces(area.outline);
        if (std::none_of(pieces.begin(), pieces.end(),
                         [&](const Polygon& p) { return geometry::intersects(p, band); })) {
            continue;
        }
        faults.add(
            at("roadmap/edges", i, "/corridor"), "corridor_over_no_go",
            "The corridor reaches into area " + quoted(area.id.str()) + ", where nobody may drive.",
            "Make it narrower there, or cut the lane into several.");
    }
}

/// Sound edges as neighbour lists.
std::vector<std::vector<std::size_t>> check_edges(const Plant& plant, const Index& index,
                                                  Faults& faults) {
    std::vector<std::vector<std::size_t>> next(plant.nodes.size());
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (std::size_t i = 0; i < plant.edges.size(); ++i) {
        const RoadmapEdge& edge = plant.edges[i];
        const auto* from = look_up(index.nodes, edge.from);
        const auto* to = look_up(index.nodes, edge.to);
        for (const auto& [node, key, field] :
             {std::tuple(from, &edge.from, "/from"), std::tuple(to, &edge.to, "/to")}) {
            if (node != nullptr) continue;
            faults.add(at("roadmap/edges", i, field), "unknown_node",
                       "There is no node " + quoted(key->str()) + ".",
                       "Correct the name or add it to the plant.");
        }
        for (std::size_t t = 0; t < edge.vehicle_types.size(); ++t) {
            if (index.types.count(edge.vehicle_types[t]) != 0) continue;
            faults.add(at("roadmap/edges", i, "/vehicle_types/" + std::to_string(t)),
                       "unknown_vehicle_type",
                       "There is no vehicle type " + quoted(edge.vehicle_types[t].str()) + ".",
                       "Correct the name or add it to the plant.");
        }
        if (from == nullptr || to == nullptr) continue;
        const HallId& hall = plant.nodes[*from].hall;
        const HallId& other = plant.nodes[*to].hall;
        if (hall != other && index.halls.count(hall) != 0 && index.halls.count(other) != 0) {
            faults.add(at("roadmap/edges", i), "other_hall", "The edge joins nodes of two halls.",
                       "Join nodes of one hall.");
            continue;
        }
        if (geometry::distance(plant.nodes[*from].position, plant.nodes[*to].position) < 1e-6) {
            faults.add(at("roadmap/edges", i), "no_length", "The edge has no length.",
                       "Remove it or move a node.");
        } else {
            check_corridor(plant, i, plant.nodes[*from], plant.nodes[*to], faults);
        }
        if (!seen.emplace(*from, *to).second) {
            faults.add(at("roadmap/edges", i), "duplicate_edge",
                       "There is another edge with the same direction between these nodes.",
                       "Remove one; a two-way lane is one edge each way.");
        }
        next[*from].push_back(*to);
    }
    return next;
}

std::vector<bool> reached_from(const std::vector<std::size_t>& starts,
                               const std::vector<std::vector<std::size_t>>& next) {
    std::vector<bool> reached(next.size(), false);
    std::vector<std::size_t> open = starts;
    for (const std::size_t s : starts) reached[s] = true;
    while (!open.empty()) {
        const std::size_t node = open.back();
        open.pop_back();
        for (const std::size_t n : next[node]) {
            if (reached[n]) continue;
            reached[n] = true;
            open.push_back(n);
        }
    }
    return reached;
}

/// Each station must be reached from, and lead back to, the first home of its hall (or its first
/// station).
void check_reach(const Plant& plant, const Index& index,
                 const std::vector<std::vector<std::size_t>>& next, Faults& faults) {
    std::vector<std::vector<std::size_t>> back(next.size());
    for (std::size_t from = 0; from < next.size(); ++from) {
        for (const std::size_t to : next[from]) back[to].push_back(from);
    }
    for (const Hall& hall : plant.halls) {
        const Station* origin = nullptr;
        const auto consider = [&](const Station& station) {
            if (origin == nullptr && station.hall == hall.id && index.nodes.count(station.node)) {
                origin = &station;
            }
        };
        for (const Vehicle& vehicle : plant.vehicles) {
            const auto* home = look_up(index.stations, vehicle.home);
            if (home != nullptr) consider(plant.stations[*home]);
        }
        for (const Station& station : plant.stations) consider(station);
        if (origin == nullptr) continue;
        const std::size_t start = index.nodes.at(origin->node);
        const auto there = reached_from({start}, next);
        const auto home = reached_from({start}, back);
        for (std::size_t i = 0; i < plant.stations.size(); ++i) {
            const Station& station = plant.stations[i];
            const auto* node = look_up(index.nodes, station.node);
            if (station.hall != hall.id || node == nullptr || (there[*node] && home[*node]))
                continue;
            const std::string from = "station " + std::to_string(origin->number);
            faults.add(at("stations", i, "/node"), "unreachable",
                       "No edges lead " +
                           (there[*node] ? "back from here to " + from : "here from " + from) + ".",
                       "Add the missing edges to the roadmap.");
        }
    }
}

}  // namespace

void check_roadmap(const Plant& plant, const Index& index, Faults& faults) {
    check_nodes(plant, index, faults);
    const auto next = check_edges(plant, index, faults);
    for (std::size_t i = 0; i < plant.stations.size(); ++i) {
        const Station& station = plant.stations[i];
        const auto* node_index = look_up(index.nodes, station.node);
        if (node_index == nullptr) continue;
        const RoadmapNode& node = plant.nodes[*node_index];
        if (node.hall != station.hall) {
            faults.add(at("stations", i, "/node"), "other_hall", "Its node lies in another hall.",
                       "Name a node of hall " + quoted(station.hall.str()) + ".");
        } else if (geometry::distance(node.position, station.pose.position()) > kNodeAtStation_m) {
            faults.add(at("stations", i, "/node"), "node_too_far",
                       "Its node lies more than 0.5 m from the station.",
                       "Move the node to the station's position.");
        }
    }
    check_reach(plant, index, next, faults);
}

}  // namespace pulseline::plant::detail
