#include "core/fleet/floor/holding.hpp"

#include <algorithm>
#include <unordered_set>

#include "core/fleet/floor/floor.hpp"
#include "core/fleet/floor/watch.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/tables/plant_tables.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"

namespace pulseline::fleet {
namespace {

using traffic::TileSet;

// A standing vehicle that is found this far from where it stood was moved by hand.
constexpr double kMoved_m = 0.02;
constexpr double kMoved_rad = 0.2 * kPi / 180.0;

bool is_away(const Pose2& a, const Pose2& b) {
    return geometry::distance(a.position(), b.position()) > kMoved_m ||
           std::abs(wrap(a.heading_rad - b.heading_rad)) > kMoved_rad;
}

/// One that has never told where it stands is taken to stand at home, until it tells or another one
/// is found there.
std::optional<Pose2> presumed_pose(const FleetState& fleet, const LiveVehicle& live) {
    if (has_stood(live.record) || live.has_leg()) return std::nullopt;
    const auto* home = plant::find_station(fleet.plant, live.vehicle->home);
    return home ? std::optional(home->pose) : std::nullopt;
}

/// What the vehicle's record says of its floor: where it stands and the rest of its base.
traffic::StoredStand stored_floor(const FleetState& fleet, LiveVehicle& live) {
    traffic::StoredStand row;
    row.name = live.record.id.str();
    row.graph = fleet.floor.classes[live.floor.of_class].graph;
    std::optional<Pose2> pose;
    if (live.record.integration < Integration::kRespect) return row;
    if (live.has_leg()) {
        pose = live.leg().nodes[live.leg().passed_nodes - 1].pose;
    } else if (has_stood(live.record)) {
        pose = live.record.pose;
    } else {
        pose = presumed_pose(fleet, live);
    }
    if (!pose) return row;
    row.stand = floor_under(fleet, live, *pose);
    row.place = place_at(fleet, live, *pose);
    if (row.place != traffic::kNoPlace) {
        row.stand =
            traffic::merge(row.stand, fleet.floor.classes[live.floor.of_class].stands[row.place]);
    }
    live.floor.pose = pose;
    if (!live.has_leg()) return row;
    const Leg& leg = live.leg();
    live.floor.moves_before_leg = -static_cast<std::int64_t>(leg.passed_nodes - 1);
    for (std::size_t i = leg.passed_nodes; i < leg.released_nodes; ++i) {
        traffic::MoveRecord move;
        move.swept = floor_of_edge(fleet, live, leg.edges[i - 1]);
        move.stand = floor_at_node(fleet, live, i);
        move.place = place_at(fleet, live, leg.nodes[i].pose);
        if (move.place != traffic::kNoPlace) {
            move.stand = fleet.floor.classes[live.floor.of_class].stands[move.place];
        }
        move.swept = traffic::merge(move.swept, move.stand);
        move.duration_s = leg.edges[i - 1].segment.duration_s;
        move.rank = static_cast<std::int64_t>(i);
        row.moves.push_back(std::move(move));
    }
    row.released = static_cast<traffic::MoveNumber>(row.moves.size());
    return row;
}

TileSet without(const TileSet& set, const std::unordered_set<traffic::TileId>& taken) {
    TileSet left;
    for (const auto tile : set) {
        if (taken.count(tile) == 0) left.push_back(tile);
    }
    return left;
}

/// Rows may contradict each other when a vehicle was moved by hand while the server was down: the
/// first one keeps the floor, the other holds the rest and is not moved until that is cleared up.
/// What is only presumed comes last.
void without_conflicts(FleetState& fleet, std::vector<traffic::StoredStand>& rows) {
    std::unordered_set<traffic::TileId> taken;
    const auto is_presumed = [&](const traffic::StoredStand& row) {
        const LiveVehicle& live = *fleet.find(plant::VehicleId(row.name));
        return presumed_pose(fleet, live).has_value();
    };
    std::vector<traffic::StoredStand*> in_order;
    for (auto& row : rows) in_order.push_back(&row);
    std::stable_partition(in_order.begin(), in_order.end(),
                          [&](const auto* row) { return !is_presumed(*row); });
    for (auto* at : in_order) {
        traffic::StoredStand& row = *at;
        TileSet needed = row.stand;
        for (const auto& move : row.moves) needed = traffic::merge(needed, move.swept);
        const TileSet left = without(needed, taken);
        if (left.size() < needed.size()) {
            LiveVehicle& live = *fleet.find(plant::VehicleId(row.name));
            if (is_presumed(row)) {
                row.stand.clear();
                row.place = traffic::kNoPlace;
                live.floor.pose.reset();
                continue;
            }
            live.floor.conflict = Reason{"floor_conflict", {{"vehicle", row.name}}};
            row.stand = without(row.stand, taken);
            row.place = traffic::kNoPlace;
            for (auto& move : row.moves) {
                move.swept = without(move.swept, taken);
                move.stand = without(move.stand, taken);
                move.place = traffic::kNoPlace;
            }
        }
        taken.insert(left.begin(), left.end());
    }
}

/// Those that were only presumed to stand here do not: they are somewhere else. True when there
/// were any.
bool release_presumed(FleetState& fleet, const LiveVehicle& live, const TileSet& stand, Time now) {
    bool any = false;
    for (const auto tile : stand) {
        const auto holder = fleet.floor.traffic.holder(tile);
        if (!holder || *holder == live.floor.vehicle) continue;
        LiveVehicle* other = fleet.find(plant::VehicleId(fleet.floor.traffic.name(*holder)));
        if (!other || !presumed_pose(fleet, *other)) continue;
        leave_floor(fleet, *other, now);
        any = true;
    }
    return any;
}

/// Others may not be sent to where it stands, although it stands on another's floor, too.
void hold_what_is_free(FleetState& fleet, LiveVehicle& live, const TileSet& stand, Time now) {
    auto& traffic = fleet.floor.traffic;
    TileSet free;
    for (const auto tile : stand) {
        const auto holder = traffic.holder(tile);
        if (!holder || *holder == live.floor.vehicle) free.push_back(tile);
    }
    const auto& plan = traffic.plan(live.floor.vehicle);
    if (plan.last() == plan.passed && traffic.held_tiles(live.floor.vehicle) == free) return;
    static_cast<void>(traffic.found_at(live.floor.vehicle, free, traffic::kNoPlace, now));
}

/// At the end of its base the floor under it can be asked for again, as without a leg.
bool clears_up_on_leg(const LiveVehicle& live) {
    return live.floor.conflict && live.delivery.seen() && !live.state.driving &&
           live.leg().passed_nodes == live.leg().released_nodes;
}

}  // namespace

void find_class(const FleetState& fleet, LiveVehicle& live) {
    const auto& classes = fleet.floor.classes;
    const auto found = std::find_if(classes.begin(), classes.end(), [&](const auto& c) {
        return c.type == live.type && c.loaded == is_loaded(live);
    });
    live.floor.of_class = static_cast<std::size_t>(found - classes.begin());
}

traffic::PlaceIndex place_at(const FleetState& fleet, const LiveVehicle& live, const Pose2& pose) {
    const auto place = fleet.floor.classes[live.floor.of_class].motion.place_at(
        plant::HallId(hall_of(fleet, live)), pose);
    return place ? static_cast<traffic::PlaceIndex>(*place) : traffic::kNoPlace;
}

void rebuild_floor(FleetState& fleet, Time now) {
    Floor& floor = fleet.floor;
    for (auto& [id, live] : fleet.vehicles) find_class(fleet, live);
    traffic::TrafficRecord record;
    for (auto& [id, live] : fleet.vehicles) {
        live.floor.vehicle = static_cast<traffic::VehicleIndex>(record.vehicles.size());
        record.vehicles.push_back(stored_floor(fleet, live));
    }
    without_conflicts(fleet, record.vehicles);
    auto rebuilt = traffic::Traffic::rebuild(record, fleet.tables->empty_floor);
    // Nobody shares floor any more, and bases alone cannot form a circle.
    if (!rebuilt) {
        floor.stopped = rebuilt.error().reason;
        return;
    }
    floor.traffic = std::move(*rebuilt);
    for (const auto& violation : floor.monitor.apply(floor.traffic.all_as_changes())) {
        floor.stopped = Reason{"traffic_violation", {{"violation", to_string(violation)}}};
    }
    for (auto& [id, live] : fleet.vehicles) halt_or_resume(fleet, live, now);
    floor_is_sound(fleet, now);
}

void hold_where_it_stands(FleetState& fleet, LiveVehicle& live, Time now, bool give_up_plan) {
    if (!live.record.pose_known || (live.has_leg() && !clears_up_on_leg(live))) return;
    if (live.record.integration < Integration::kRespect) return;
    auto& traffic = fleet.floor.traffic;
    const auto& plan = traffic.plan(live.floor.vehicle);
    const auto place = place_at(fleet, live, live.record.pose);
    const bool as_planned = live.floor.pose && !live.floor.conflict &&
                            plan.passed == plan.released &&
                            (plan.place == place && place != traffic::kNoPlace);
    if (as_planned && !give_up_plan) {
        live.floor.pose = live.record.pose;
        return;
    }
    const bool stays = live.floor.pose && !live.floor.conflict && !give_up_plan &&
                       plan.passed == plan.released && !is_away(*live.floor.pose, live.record.pose);
    if (stays) return;
    TileSet stand = floor_under(fleet, live, live.record.pose);
    if (place != traffic::kNoPlace) {
        stand = traffic::merge(stand, fleet.floor.classes[live.floor.of_class].stands[place]);
    }
    auto found = traffic.found_at(live.floor.vehicle, stand, place, now);
    if (!found && release_presumed(fleet, live, stand, now)) {
        found = traffic.found_at(live.floor.vehicle, stand, place, now);
    }
    live.floor.leg_planned = false;
    if (!found) hold_what_is_free(fleet, live, stand, now);
    if (found) {
        if (live.floor.conflict) {
            add_event(fleet, now, event::kVehicleFloorCleared, {}, {}, live.record.id, {});
        }
        live.floor.conflict.reset();
        live.floor.pose = live.record.pose;
        fleet.store(live);  // a restart must find it there, too
        if (live.has_leg()) {
            live.floor.moves_before_leg = static_cast<std::int64_t>(plan.passed) -
                                          static_cast<std::int64_t>(live.leg().passed_nodes - 1);
        }
    } else if (!live.floor.conflict) {
        Params who;
        for (const auto& param : found.error().reason.params) {
            if (param.name == "vehicle") who.push_back({"other", param.value});
        }
        who.insert(who.begin(), {"vehicle", live.record.id.str()});
        live.floor.conflict = Reason{"floor_conflict", who};
        add_event(fleet, now, event::kVehicleFloorConflict, {}, {}, live.record.id, {}, who);
    }
    halt_or_resume(fleet, live, now);
}

void hold_both_floors(FleetState& fleet, LiveVehicle& live, Time now) {
    if (live.record.integration < Integration::kRespect) return;
    const Whereabouts& claim = *live.record.claim;
    TileSet claimed;
    if (is_in_hall(fleet, claim)) {
        claimed = tiles_of_body(fleet.tables->overhead, hall_index(fleet, claim.hall),
                                outline_at(live, claim.pose), kFloorMargin_m, is_loaded(live));
    }
    const auto known = stored_floor(fleet, live);
    TileSet both = traffic::merge(known.stand, claimed);
    for (const auto& move : known.moves) both = traffic::merge(both, move.swept);
    hold_what_is_free(fleet, live, both, now);
    live.floor.leg_planned = false;
    halt_or_resume(fleet, live, now);
}

void leave_floor(FleetState& fleet, LiveVehicle& live, Time now) {
    static_cast<void>(fleet.floor.traffic.found_at(live.floor.vehicle, {}, traffic::kNoPlace, now));
    live.floor.pose.reset();
    live.floor.conflict.reset();
    live.floor.leg_planned = false;
}

void hold_for_correction(FleetState& fleet, LiveVehicle& live, const Pose2& target, Time now) {
    const auto& plan = fleet.floor.traffic.plan(live.floor.vehicle);
    if (plan.place != traffic::kNoPlace) return;  // the place's floor covers the correction
    const TileSet both = traffic::merge(floor_under(fleet, live, live.record.pose),
                                        floor_under(fleet, live, target));
    if (fleet.floor.traffic.found_at(live.floor.vehicle, both, traffic::kNoPlace, now)) {
        live.floor.pose = live.record.pose;
    }
    halt_or_resume(fleet, live, now);
}

}  // namespace pulseline::fleet
