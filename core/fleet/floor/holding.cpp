#include "core/fleet/floor/holding.hpp"

#include <algorithm>
#include <unordered_set>

#include "core/fleet/floor/floor.hpp"
#include "core/fleet/floor/watch.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"

namespace pulseline::fleet {
namespace {

using traffic::TileSet;

// A standing vehicle that is found this far from where it stood was moved by hand.
constexpr double kMoved_m = 0.02;
constexpr double kMoved_rad = 0.2 * kPi / 180.0;

std::size_t class_of(const FleetState& fleet, const VehicleRun& run) {
    const auto& classes = fleet.floor.classes;
    const auto found = std::find_if(classes.begin(), classes.end(), [&](const auto& c) {
        return c.type == run.type && c.loaded == is_loaded(run);
    });
    return static_cast<std::size_t>(found - classes.begin());
}

traffic::PlaceIndex place_at(const FleetState& fleet, const VehicleRun& run, const Pose2& pose) {
    const auto place = fleet.floor.classes[run.floor.of_class].motion.place_at(
        plant::HallId(hall_of(fleet, run)), pose);
    return place ? static_cast<traffic::PlaceIndex>(*place) : traffic::kNoPlace;
}

bool is_away(const Pose2& a, const Pose2& b) {
    return geometry::distance(a.position(), b.position()) > kMoved_m ||
           std::abs(wrap(a.heading_rad - b.heading_rad)) > kMoved_rad;
}

/// One that has never told where it stands is taken to stand at home, until it tells or another one
/// is found there.
std::optional<Pose2> presumed_pose(const FleetState& fleet, const VehicleRun& run) {
    if (has_stood(run.record) || run.has_leg()) return std::nullopt;
    const auto* home = plant::find_station(fleet.plant, run.vehicle->home);
    return home ? std::optional(home->pose) : std::nullopt;
}

/// What the vehicle's record says of its floor: where it stands and the rest of its base.
traffic::VehicleRecord stored_floor(const FleetState& fleet, VehicleRun& run) {
    traffic::VehicleRecord row;
    row.name = run.record.id.str();
    row.graph = fleet.floor.classes[run.floor.of_class].graph;
    std::optional<Pose2> pose;
    if (run.record.integration < Integration::kRespect) return row;
    if (run.has_leg()) {
        pose = run.leg().nodes[run.leg().passed_nodes - 1].pose;
    } else if (has_stood(run.record)) {
        pose = run.record.pose;
    } else {
        pose = presumed_pose(fleet, run);
    }
    if (!pose) return row;
    row.stand = floor_under(fleet, run, *pose);
    row.place = place_at(fleet, run, *pose);
    if (row.place != traffic::kNoPlace) {
        row.stand =
            traffic::merge(row.stand, fleet.floor.classes[run.floor.of_class].stands[row.place]);
    }
    run.floor.pose = pose;
    if (!run.has_leg()) return row;
    const Leg& leg = run.leg();
    run.floor.moves_before_leg = -static_cast<std::int64_t>(leg.passed_nodes - 1);
    for (std::size_t i = leg.passed_nodes; i < leg.released_nodes; ++i) {
        traffic::MoveRecord move;
        move.swept = floor_of_edge(fleet, run, leg.edges[i - 1]);
        move.stand = floor_at_node(fleet, run, i);
        move.place = place_at(fleet, run, leg.nodes[i].pose);
        if (move.place != traffic::kNoPlace) {
            move.stand = fleet.floor.classes[run.floor.of_class].stands[move.place];
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
void without_conflicts(FleetState& fleet, std::vector<traffic::VehicleRecord>& rows) {
    std::unordered_set<traffic::TileId> taken;
    const auto is_presumed = [&](const traffic::VehicleRecord& row) {
        const VehicleRun& run = *fleet.find(plant::VehicleId(row.name));
        return presumed_pose(fleet, run).has_value();
    };
    std::vector<traffic::VehicleRecord*> in_order;
    for (auto& row : rows) in_order.push_back(&row);
    std::stable_partition(in_order.begin(), in_order.end(),
                          [&](const auto* row) { return !is_presumed(*row); });
    for (auto* at : in_order) {
        traffic::VehicleRecord& row = *at;
        TileSet needed = row.stand;
        for (const auto& move : row.moves) needed = traffic::merge(needed, move.swept);
        const TileSet left = without(needed, taken);
        if (left.size() < needed.size()) {
            VehicleRun& run = *fleet.find(plant::VehicleId(row.name));
            if (is_presumed(row)) {
                row.stand.clear();
                row.place = traffic::kNoPlace;
                run.floor.pose.reset();
                continue;
            }
            run.floor.conflict = Reason{"floor_conflict", {{"vehicle", row.name}}};
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
bool release_presumed(FleetState& fleet, const VehicleRun& run, const TileSet& stand, Time now) {
    bool any = false;
    for (const auto tile : stand) {
        const auto holder = fleet.floor.traffic.holder(tile);
        if (!holder || *holder == run.floor.vehicle) continue;
        VehicleRun* other = fleet.find(plant::VehicleId(fleet.floor.traffic.name(*holder)));
        if (!other || !presumed_pose(fleet, *other)) continue;
        leave_floor(fleet, *other, now);
        any = true;
    }
    return any;
}

/// Others may not be sent to where it stands, although it stands on another's floor, too.
void hold_what_is_free(FleetState& fleet, VehicleRun& run, const TileSet& stand, Time now) {
    auto& traffic = fleet.floor.traffic;
    TileSet free;
    for (const auto tile : stand) {
        const auto holder = traffic.holder(tile);
        if (!holder || *holder == run.floor.vehicle) free.push_back(tile);
    }
    const auto& plan = traffic.plan(run.floor.vehicle);
    if (plan.last() == plan.passed && traffic.held_tiles(run.floor.vehicle) == free) return;
    static_cast<void>(traffic.found_at(run.floor.vehicle, free, traffic::kNoPlace, now));
}

/// At the end of its base the floor under it can be asked for again, as without a leg.
bool clears_up_on_leg(const VehicleRun& run) {
    return run.floor.conflict && run.delivery.seen() && !run.state.driving &&
           run.leg().passed_nodes == run.leg().released_nodes;
}

}  // namespace

void find_classes(FleetState& fleet) {
    for (auto& [id, run] : fleet.vehicles) run.floor.of_class = class_of(fleet, run);
}

void open_floor(FleetState& fleet, Time now) {
    Floor& floor = fleet.floor;
    find_classes(fleet);
    traffic::TrafficRecord record;
    for (auto& [id, run] : fleet.vehicles) {
        run.floor.vehicle = static_cast<traffic::VehicleIndex>(record.vehicles.size());
        record.vehicles.push_back(stored_floor(fleet, run));
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
    for (auto& [id, run] : fleet.vehicles) halt_or_resume(fleet, run, now);
    floor_is_sound(fleet, now);
}

void settle(FleetState& fleet, VehicleRun& run, Time now, bool give_up_plan) {
    if (!run.record.pose_known || (run.has_leg() && !clears_up_on_leg(run))) return;
    if (run.record.integration < Integration::kRespect) return;
    auto& traffic = fleet.floor.traffic;
    const auto& plan = traffic.plan(run.floor.vehicle);
    const auto place = place_at(fleet, run, run.record.pose);
    const bool as_planned = run.floor.pose && !run.floor.conflict && plan.passed == plan.released &&
                            (plan.place == place && place != traffic::kNoPlace);
    if (as_planned && !give_up_plan) {
        run.floor.pose = run.record.pose;
        return;
    }
    const bool stays = run.floor.pose && !run.floor.conflict && !give_up_plan &&
                       plan.passed == plan.released && !is_away(*run.floor.pose, run.record.pose);
    if (stays) return;
    TileSet stand = floor_under(fleet, run, run.record.pose);
    if (place != traffic::kNoPlace) {
        stand = traffic::merge(stand, fleet.floor.classes[run.floor.of_class].stands[place]);
    }
    auto found = traffic.found_at(run.floor.vehicle, stand, place, now);
    if (!found && release_presumed(fleet, run, stand, now)) {
        found = traffic.found_at(run.floor.vehicle, stand, place, now);
    }
    run.floor.leg_planned = false;
    if (!found) hold_what_is_free(fleet, run, stand, now);
    if (found) {
        if (run.floor.conflict) {
            add_event(fleet, now, event::kVehicleFloorCleared, {}, {}, run.record.id, {});
        }
        run.floor.conflict.reset();
        run.floor.pose = run.record.pose;
        fleet.store(run);  // a restart must find it there, too
        if (run.has_leg()) {
            run.floor.moves_before_leg = static_cast<std::int64_t>(plan.passed) -
                                         static_cast<std::int64_t>(run.leg().passed_nodes - 1);
        }
    } else if (!run.floor.conflict) {
        Params who;
        for (const auto& param : found.error().reason.params) {
            if (param.name == "vehicle") who.push_back({"other", param.value});
        }
        who.insert(who.begin(), {"vehicle", run.record.id.str()});
        run.floor.conflict = Reason{"floor_conflict", who};
        add_event(fleet, now, event::kVehicleFloorConflict, {}, {}, run.record.id, {}, who);
    }
    halt_or_resume(fleet, run, now);
}

void hold_both_floors(FleetState& fleet, VehicleRun& run, Time now) {
    if (run.record.integration < Integration::kRespect) return;
    const Whereabouts& claim = *run.record.claim;
    TileSet claimed;
    if (is_in_hall(fleet, claim)) {
        claimed = traffic::tiles_under(hall_index(fleet, claim.hall), outline_at(run, claim.pose),
                                       kFloorMargin_m);
    }
    const auto known = stored_floor(fleet, run);
    TileSet both = traffic::merge(known.stand, claimed);
    for (const auto& move : known.moves) both = traffic::merge(both, move.swept);
    hold_what_is_free(fleet, run, both, now);
    run.floor.leg_planned = false;
    halt_or_resume(fleet, run, now);
}

void leave_floor(FleetState& fleet, VehicleRun& run, Time now) {
    static_cast<void>(fleet.floor.traffic.found_at(run.floor.vehicle, {}, traffic::kNoPlace, now));
    run.floor.pose.reset();
    run.floor.conflict.reset();
    run.floor.leg_planned = false;
}

void hold_for_correction(FleetState& fleet, VehicleRun& run, const Pose2& target, Time now) {
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    if (plan.place != traffic::kNoPlace) return;  // the place's floor covers the correction
    const TileSet both =
        traffic::merge(floor_under(fleet, run, run.record.pose), floor_under(fleet, run, target));
    if (fleet.floor.traffic.found_at(run.floor.vehicle, both, traffic::kNoPlace, now)) {
        run.floor.pose = run.record.pose;
    }
    halt_or_resume(fleet, run, now);
}

}  // namespace pulseline::fleet
