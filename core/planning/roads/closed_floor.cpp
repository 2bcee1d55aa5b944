#include "core/planning/roads/closed_floor.hpp"

#include <algorithm>
#include <iterator>

namespace pulseline::planning {
namespace {

bool near(const geometry::Box& box, const geometry::Box& other, double within_m) {
    const double dx = std::max(box.min.x_m - other.max.x_m, other.min.x_m - box.max.x_m);
    const double dy = std::max(box.min.y_m - other.max.y_m, other.min.y_m - box.max.y_m);
    return std::max(dx, dy) <= within_m;
}

bool meets(const ClosedFloor& closure, const std::vector<geometry::Polygon>& swept) {
    for (const auto& piece : swept) {
        const auto box = geometry::bounding_box(piece);
        for (const auto& closed : closure.pieces) {
            if (!near(box, geometry::bounding_box(closed), closure.margin_m)) continue;
            if (geometry::distance(piece, closed) <= closure.margin_m) return true;
        }
    }
    return false;
}

/// The floor of a lane: what the body sweeps on it, and its corridor.
std::vector<geometry::Polygon> floor_of_arc(const RoadmapIndex& roads, const Passage& passage,
                                            int arc, double reach_m) {
    auto floor = roads.swept(passage.body, arc);
    if (const auto& corridor = roads.edge_of_arc(arc).corridor) {
        const auto& nodes = roads.graph().nodes;
        const RoadArc& lane = roads.graph().arcs[static_cast<std::size_t>(arc)];
        floor.push_back(plant::corridor_band(nodes[static_cast<std::size_t>(lane.from)],
                                             nodes[static_cast<std::size_t>(lane.to)], *corridor,
                                             reach_m));
    }
    return floor;
}

/// Whether a body could touch any of them between two points: spares most lanes their sweep.
bool any_near(const std::vector<ClosedFloor>& closures, const plant::HallId& hall,
              geometry::Point2 from, geometry::Point2 to, double reach_m) {
    const auto way = geometry::bounding_box({from, to});
    return std::any_of(closures.begin(), closures.end(), [&](const ClosedFloor& closure) {
        return closure.hall == hall &&
               std::any_of(closure.pieces.begin(), closure.pieces.end(), [&](const auto& piece) {
                   return near(way, geometry::bounding_box(piece), reach_m + closure.margin_m);
               });
    });
}

}  // namespace

std::vector<ClosedFloor> closed_to(bool loaded, const std::vector<ClosedFloor>& closures) {
    std::vector<ClosedFloor> bars;
    std::ranges::copy_if(closures, std::back_inserter(bars), [&](const ClosedFloor& closed) {
        return loaded || !closed.to_loads_only;
    });
    return bars;
}

std::string key_of(const ClosedFloor& closed) {
    std::string key = closed.id + '/' + closed.hall.str();
    const auto add = [&](double number) {
        key.append(reinterpret_cast<const char*>(&number), sizeof number);
    };
    add(closed.margin_m);
    for (const auto& piece : closed.pieces) {
        add(static_cast<double>(piece.size()));
        for (const auto& point : piece) {
            add(point.x_m);
            add(point.y_m);
        }
    }
    return key;
}

std::vector<std::size_t> driven_over(const std::vector<ClosedFloor>& closures,
                                     const plant::HallId& hall,
                                     const std::vector<geometry::Polygon>& swept) {
    std::vector<std::size_t> over;
    for (std::size_t i = 0; i < closures.size(); ++i) {
        if (closures[i].hall == hall && meets(closures[i], swept)) over.push_back(i);
    }
    return over;
}

std::vector<std::vector<std::size_t>> closures_over_arcs(const RoadmapIndex& roads,
                                                         const Passage& passage,
                                                         const std::vector<ClosedFloor>& closures) {
    const RoadGraph& graph = roads.graph();
    const double reach_m = plant::reach_m(passage.body.pieces);
    std::vector<std::vector<std::size_t>> over(graph.arcs.size());
    for (std::size_t i = 0; i < over.size(); ++i) {
        const int arc = static_cast<int>(i);
        const auto& hall = roads.node(graph.arcs[i].from).hall;
        const auto& from = graph.nodes[static_cast<std::size_t>(graph.arcs[i].from)];
        const auto& to = graph.nodes[static_cast<std::size_t>(graph.arcs[i].to)];
        const auto room = roads.edge_of_arc(arc).corridor.value_or(plant::Corridor{});
        const double within_m = std::max({reach_m, room.left_m, room.right_m});
        if (!roads.usable(passage, arc) || !any_near(closures, hall, from, to, within_m)) continue;
        over[i] = driven_over(closures, hall, floor_of_arc(roads, passage, arc, reach_m));
    }
    return over;
}

}  // namespace pulseline::planning
