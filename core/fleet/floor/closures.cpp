#include "core/fleet/floor/closures.hpp"

#include <algorithm>

#include "core/fleet/floor/standing_loads.hpp"
#include "core/fleet/floor/watch.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/geometry/convex.hpp"

namespace pulseline::fleet {
namespace {

constexpr std::size_t kMostClosures = 200;
constexpr std::size_t kMostCorners = 64;
// An outline may reach any distance; its tiles beyond the hall and who stands half outside would
// only take memory.
constexpr double kBeyondHall_m = 20.0;
constexpr double kLaneHalfWidth_m = 0.1;  // the line vehicles' centres follow
// The ends of a lane stay open: who stands at its nodes is not on it. Nobody drives it without
// crossing its middle.
constexpr double kLaneEnd_m = 6.0;
constexpr double kLaneEndShare = 0.4;

tl::unexpected<Error> bad(std::string code, std::string what, std::string field,
                          Params params = {}) {
    return fail(Errc::kUnreachable, std::move(code), std::move(what), std::move(field),
                std::move(params));
}

const plant::RoadmapEdge* find_edge(const plant::Plant& plant, const plant::EdgeId& id) {
    for (const auto& edge : plant.edges) {
        if (edge.id == id) return &edge;
    }
    return nullptr;
}

/// A thin strip along the lane.
geometry::Polygon strip(geometry::Point2 from, geometry::Point2 to) {
    const geometry::Point2 way = to - from;
    const double length = norm(way);
    const double cut = std::min(kLaneEnd_m, kLaneEndShare * length) / length;
    const geometry::Point2 a = from + cut * way;
    const geometry::Point2 b = to - cut * way;
    const geometry::Point2 side{-way.y_m / length * kLaneHalfWidth_m,
                                way.x_m / length * kLaneHalfWidth_m};
    return {a - side, b - side, b + side, a + side};
}

/// Ends of a closed lane; nothing for one that the plant does not have any more.
std::optional<std::pair<const plant::RoadmapNode*, const plant::RoadmapNode*>> ends_of(
    const plant::Plant& plant, const plant::EdgeId& id) {
    const auto* edge = find_edge(plant, id);
    const auto* from = edge ? plant::find_node(plant, edge->from) : nullptr;
    const auto* to = edge ? plant::find_node(plant, edge->to) : nullptr;
    if (!from || !to) return std::nullopt;
    return std::pair(from, to);
}

traffic::TileSet tiles_of(const FleetState& fleet, const Closure& closure) {
    traffic::TileSet tiles;
    if (const auto* hall = plant::find_hall(fleet.plant, closure.hall);
        hall && !closure.outline.empty()) {
        auto pieces = geometry::convex_pieces(closure.outline);
        geometry::Box box = geometry::bounding_box(hall->outline);
        box.min = {box.min.x_m - kBeyondHall_m, box.min.y_m - kBeyondHall_m};
        box.max = {box.max.x_m + kBeyondHall_m, box.max.y_m + kBeyondHall_m};
        for (auto& piece : pieces) piece = geometry::clipped(piece, box);
        tiles = traffic::tiles_under(hall_index(fleet.plant, closure.hall), pieces, 0);
    }
    for (const auto& id : closure.edges) {
        const auto ends = ends_of(fleet.plant, id);
        if (!ends) continue;
        const auto& [from, to] = *ends;
        tiles =
            traffic::merge(tiles, traffic::tiles_under(hall_index(fleet.plant, from->hall),
                                                       {strip(from->position, to->position)}, 0));
    }
    return tiles;
}

/// Legs planned before do not count any more.
void tell_planner(FleetState& fleet) {
    close_to_planner(fleet);
    for (auto& [id, live] : fleet.vehicles) {
        live.newest_plan.reset();
        live.awaited_plan.reset();
    }
}

Status check(const FleetState& fleet, const NewClosure& wanted) {
    if (fleet.closures.size() >= kMostClosures) {
        return bad("too_many_closures", "There are 200 closures already. Reopen some first.", "",
                   {{"max", static_cast<std::int64_t>(kMostClosures)}});
    }
    if (wanted.outline.empty() && wanted.edges.empty()) {
        return bad("nothing_to_close", "Give an outline of the closed area or the lanes to close.",
                   "/outline");
    }
    if (!wanted.outline.empty()) {
        if (!plant::find_hall(fleet.plant, wanted.hall)) {
            return bad("unknown_hall",
                       "There is no hall " + wanted.hall.str() + ". GET /api/v1/plant lists them.",
                       "/hall", {{"hall", wanted.hall.str()}});
        }
        if (wanted.outline.size() < 3 || wanted.outline.size() > kMostCorners ||
            std::abs(geometry::area_m2(wanted.outline)) < 1e-4) {
            return bad("bad_outline", "An outline is an area of 3 to 64 corners.", "/outline");
        }
    }
    for (std::size_t i = 0; i < wanted.edges.size(); ++i) {
        if (find_edge(fleet.plant, wanted.edges[i])) continue;
        return bad("unknown_edge", "There is no lane " + wanted.edges[i].str() + " in the roadmap.",
                   "/edges/" + std::to_string(i), {{"edge", wanted.edges[i].str()}});
    }
    return {};
}

void put_on_floor(FleetState& fleet, Closure closure, Time now) {
    FleetState::ClosedFloor closed;
    closed.tiles = tiles_of(fleet, closure);
    closed.in_traffic = fleet.floor.traffic.close(closed.tiles, now);
    closed.closure = std::move(closure);
    fleet.closures.push_back(std::move(closed));
}

}  // namespace

Result<Closure> close_floor(FleetState& fleet, const NewClosure& wanted, const std::string& actor,
                            Time now) {
    if (auto ok = check(fleet, wanted); !ok) return fail(ok.error());
    Closure closure{ClosureId(fleet.ids.next(now)),
                    wanted.name,
                    wanted.hall,
                    wanted.outline,
                    wanted.edges,
                    actor,
                    now};
    put_on_floor(fleet, closure, now);
    tell_planner(fleet);
    fleet.out.records.closures.push_back(closure);
    fleet.out.fleet_changed = true;
    add_event(fleet, now, event::kFloorClosed, {}, {}, {}, actor,
              {{"closure", closure.id.str()}, {"name", closure.name}});
    // Who is on the way there looks for another way at once.
    fleet.floor.improved.reset();
    return closure;
}

Status reopen_floor(FleetState& fleet, ClosureId id, const std::string& actor, Time now) {
    const auto found = std::find_if(fleet.closures.begin(), fleet.closures.end(),
                                    [&](const auto& c) { return c.closure.id == id; });
    if (found == fleet.closures.end()) {
        return fail(Errc::kNotFound, "unknown_closure",
                    "There is no closure " + id.str() + "; perhaps it was reopened.", {},
                    {{"closure", id.str()}});
    }
    fleet.floor.traffic.reopen(found->in_traffic, now);
    fleet.out.records.reopened.push_back(id);
    fleet.out.fleet_changed = true;
    add_event(fleet, now, event::kFloorReopened, {}, {}, {}, actor,
              {{"closure", id.str()}, {"name", found->closure.name}});
    fleet.closures.erase(found);
    tell_planner(fleet);
    fleet.floor.improved.reset();
    return {};
}

void restore_closures(FleetState& fleet, std::vector<Closure> closures, Time now) {
    for (auto& closure : closures) put_on_floor(fleet, std::move(closure), now);
    tell_planner(fleet);
    floor_is_sound(fleet, now);
}

void close_below_loads(FleetState& fleet, Time now) {
    if (!update_standing_loads(fleet, now)) return;
    tell_planner(fleet);
    fleet.out.fleet_changed = true;
    fleet.floor.improved.reset();
}

std::vector<planning::ClosedFloor> closed_floors(const FleetState& fleet) {
    std::vector<planning::ClosedFloor> floors = closed_to_loads(fleet);
    const auto add = [&](const Closure& closure, const plant::HallId& hall,
                         std::vector<geometry::Polygon> pieces) {
        floors.push_back({closure.id.str(), closure.name, hall, std::move(pieces), kFloorMargin_m});
    };
    for (const auto& [closure, tiles, in_traffic] : fleet.closures) {
        std::map<plant::HallId, std::vector<geometry::Polygon>> pieces;
        if (!closure.outline.empty()) {
            pieces[closure.hall] = geometry::convex_pieces(closure.outline);
        }
        for (const auto& id : closure.edges) {
            if (const auto ends = ends_of(fleet.plant, id)) {
                const auto& [from, to] = *ends;
                pieces[from->hall].push_back(strip(from->position, to->position));
            }
        }
        for (auto& [hall, in_hall] : pieces) add(closure, hall, std::move(in_hall));
    }
    return floors;
}

void close_to_planner(FleetState& fleet) { fleet.planner.set_closures(closed_floors(fleet)); }

void name_closures(const FleetState& fleet, const std::vector<std::string>& ids, Reason& reason) {
    std::string names;
    std::string listed;
    for (const auto& closed : fleet.closures) {
        const std::string id = closed.closure.id.str();
        if (std::find(ids.begin(), ids.end(), id) == ids.end()) continue;
        names += (names.empty() ? "" : ", ") + closed.closure.name;
        listed += (listed.empty() ? "" : ",") + id;
    }
    if (listed.empty()) return;
    std::erase_if(reason.params, [](const Param& param) {
        return param.name == "closure" || param.name == "closure_id";
    });
    reason.params.push_back({"closure", names});
    reason.params.push_back({"closure_id", listed});
}

const Closure* closure_at(const FleetState& fleet, traffic::TileId tile) {
    for (const auto& closed : fleet.closures) {
        if (std::binary_search(closed.tiles.begin(), closed.tiles.end(), tile)) {
            return &closed.closure;
        }
    }
    return nullptr;
}

}  // namespace pulseline::fleet
