#include "core/fleet/orders/checks.hpp"

#include <algorithm>
#include <array>

#include "core/fleet/orders/candidates.hpp"
#include "core/fleet/orders/start_conditions.hpp"
#include "core/fleet/orders/transfer_checks.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/lifts.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

constexpr std::size_t kMaxSteps = 100;
constexpr std::size_t kMaxDependencies = 100;

// The server sends these itself; as a step's action they would defeat its own bookkeeping.
constexpr std::array kOwnActions = {vda5050::kMeasureStop,      vda5050::kAdjustToMarker,
                                    vda5050::kObserveMarkers,   vda5050::kCancelOrder,
                                    vda5050::kStartPause,       vda5050::kStopPause,
                                    vda5050::kInitPosition,     vda5050::kStateRequest,
                                    vda5050::kFactsheetRequest, vda5050::kLogReport};

/// One action of a request and where it stands.
struct PlacedAction {
    const StepAction* action;
    std::string field;
};

std::vector<PlacedAction> actions_of(const NewOrder& order) {
    std::vector<PlacedAction> placed;
    for (std::size_t i = 0; i < order.steps.size(); ++i) {
        const std::string step = "/steps/" + std::to_string(i);
        for (const auto& [name, actions] : {std::pair{"/before/", &order.steps[i].before},
                                            std::pair{"/after/", &order.steps[i].after}}) {
            for (std::size_t k = 0; k < actions->size(); ++k) {
                placed.push_back({&(*actions)[k], step + name + std::to_string(k)});
            }
        }
    }
    return placed;
}

/// Brackets and feet where they are to go: said now, not when it has got there.
Status can_move(const LiveVehicle& live, const std::vector<PlacedAction>& placed) {
    for (const auto& [action, field] : placed) {
        if (Status has = has_lift(live, *action, field + "/parameters"); !has) return has;
    }
    return {};
}

Status check_actions(const FleetState& fleet, const NewOrder& order) {
    const auto placed = actions_of(order);
    if (placed.empty()) return {};
    for (const auto& [action, field] : placed) {
        if (std::find(kOwnActions.begin(), kOwnActions.end(), action->type) != kOwnActions.end()) {
            return fail(Errc::kInvalid, "reserved_action",
                        "The server sends " + action->type +
                            " itself. Leave it out; every stop is measured anyway.",
                        field + "/type", {{"action", action->type}});
        }
    }
    const PlacedAction* missing = nullptr;
    std::optional<Error> cannot;  // of the first that announces all of them
    std::string announced;
    bool any_factsheet = false;
    for (const auto& [id, live] : fleet.vehicles) {
        if (!is_candidate(fleet, order, live) || !live.factsheet) continue;
        any_factsheet = true;
        const auto lacks = std::find_if(
            placed.begin(), placed.end(),
            [&, &vehicle = live](auto& p) { return !announces_at_node(vehicle, *p.action); });
        if (lacks == placed.end()) {
            const Status moves = can_move(live, placed);
            if (moves) return {};
            if (!cannot) cannot = moves.error();
            continue;
        }
        if (missing) continue;
        missing = &*lacks;
        for (const auto& name : live.factsheet->node_actions) {
            const bool own =
                std::find(kOwnActions.begin(), kOwnActions.end(), name) != kOwnActions.end();
            if (!own) announced += (announced.empty() ? "" : ", ") + name;
        }
    }
    if (cannot) return fail(std::move(*cannot));
    if (!any_factsheet) {
        return fail(Errc::kConflict, "no_factsheet",
                    "No vehicle that may take this order has said yet which actions it can do. "
                    "Connect one, then repeat.",
                    placed.front().field + "/type", {{"action", placed.front().action->type}});
    }
    return fail(
        Errc::kUnreachable, "unknown_action",
        "No vehicle that may take this order announces the action " + missing->action->type + ". " +
            (announced.empty() ? "Leave it out." : "Use one of: " + announced + "."),
        missing->field + "/type", {{"action", missing->action->type}, {"announced", announced}});
}

std::optional<JobOrder> named(const FleetState& fleet, const std::string& name) {
    auto id = JobOrderId::parse(name);
    if (!id) id = fleet.orders.with_client_id(name);
    return id ? fleet.orders.look_up(*id) : std::nullopt;
}

}  // namespace

Status check_vehicle_fields(const FleetState& fleet, const NewOrder& order) {
    const LiveVehicle* live = order.vehicle.empty() ? nullptr : fleet.find(order.vehicle);
    if (!order.vehicle.empty() && !live) {
        return fail(Errc::kUnreachable, "unknown_vehicle",
                    "There is no vehicle " + order.vehicle.str() +
                        ". GET /api/v1/vehicles lists the vehicles.",
                    "/vehicle", {{"vehicle", order.vehicle.str()}});
    }
    const std::string type = order.vehicle_type.str();
    if (!type.empty() && !plant::find_vehicle_type(fleet.plant, order.vehicle_type)) {
        return fail(Errc::kUnreachable, "unknown_vehicle_type",
                    "There is no vehicle type " + type + ". GET /api/v1/plant lists the types.",
                    "/vehicle_type", {{"vehicle_type", type}});
    }
    if (live && !type.empty() && live->type->id != order.vehicle_type) {
        return fail(Errc::kUnreachable, "vehicle_not_of_type",
                    "Vehicle " + order.vehicle.str() + " is of type " + live->type->id.str() +
                        ". Name only one of vehicle and vehicle_type, or two that fit.",
                    "/vehicle_type",
                    {{"vehicle", order.vehicle.str()}, {"vehicle_type", live->type->id.str()}});
    }
    const auto bound = fleet.orders.vehicle_of_sequence(order.sequence);
    const LiveVehicle* has = bound.empty() ? nullptr : fleet.find(bound);
    if (has && !is_candidate(fleet, order, *has)) {
        return fail(Errc::kConflict, "sequence_on_other_vehicle",
                    "Sequence " + order.sequence + " already has vehicle " + bound.str() +
                        ". Leave the vehicle out or use another sequence.",
                    order.vehicle.empty() ? "/vehicle_type" : "/vehicle",
                    {{"sequence", order.sequence}, {"vehicle", bound.str()}});
    }
    return {};
}

Result<Stations> stations_of(const FleetState& fleet, const NewOrder& order) {
    if (order.steps.empty() || order.steps.size() > kMaxSteps) {
        return fail(Errc::kInvalid, "bad_step_count", "An order has 1 to 100 steps.", "/steps",
                    {{"steps", static_cast<std::int64_t>(order.steps.size())}});
    }
    Stations stations;
    for (std::size_t i = 0; i < order.steps.size(); ++i) {
        stations.push_back(plant::find_station(fleet.plant, order.steps[i].station_number));
        if (!stations.back()) {
            return fail(Errc::kUnreachable, "unknown_station",
                        "There is no station " + std::to_string(order.steps[i].station_number) +
                            ". GET /api/v1/stations lists the stations.",
                        "/steps/" + std::to_string(i) + "/station",
                        {{"station", std::int64_t{order.steps[i].station_number}}});
        }
    }
    return stations;
}

Result<CheckedOrder> check_order(const FleetState& fleet, const NewOrder& order, JobOrderId self) {
    if (order.earliest_start && order.due && *order.due <= *order.earliest_start) {
        return fail(Errc::kInvalid, "due_before_start",
                    "The order would be due before it may start. Set due after earliest_start.",
                    "/due");
    }
    if (auto vehicles = check_vehicle_fields(fleet, order); !vehicles) {
        return fail(vehicles.error());
    }
    for (const JobOrderId& id : fleet.orders.sequence(order.sequence)) {
        const JobOrder& member = *fleet.find(id);
        if (id == self || order.vehicle.empty() || member.wanted_vehicle.empty() ||
            member.wanted_vehicle == order.vehicle) {
            continue;
        }
        return fail(Errc::kConflict, "sequence_on_other_vehicle",
                    "Sequence " + order.sequence + " wants vehicle " + member.wanted_vehicle.str() +
                        ". Leave the vehicle out or use another sequence.",
                    "/vehicle",
                    {{"sequence", order.sequence}, {"vehicle", member.wanted_vehicle.str()}});
    }
    if (order.after.size() > kMaxDependencies) {
        return fail(Errc::kInvalid, "too_many_dependencies",
                    "An order waits for at most 100 others. Name fewer.", "/after",
                    {{"orders", static_cast<std::int64_t>(order.after.size())}});
    }
    std::vector<Dependency> after;
    for (std::size_t i = 0; i < order.after.size(); ++i) {
        const std::string field = "/after/" + std::to_string(i);
        const auto other = named(fleet, order.after[i]);
        if (!other) {
            return fail(Errc::kUnreachable, "unknown_job_order",
                        "There is no job order " + order.after[i] +
                            ". GET /api/v1/job-orders lists them; those that ended more than 7 "
                            "days ago cannot be named any more.",
                        field, {{"order", order.after[i]}});
        }
        if (other->state == JobState::kAborted) {
            return fail(Errc::kConflict, "dependency_aborted",
                        "JO-" + std::to_string(other->number) +
                            " was aborted, so this order would wait for ever. Leave it out.",
                        field, {{"order", "JO-" + std::to_string(other->number)}});
        }
        const bool twice = std::any_of(after.begin(), after.end(), [&](const Dependency& known) {
            return known.order == other->id;
        });
        if (twice) continue;
        after.push_back({other->id, other->number,
                         is_final(other->state) ? std::optional(other->state) : std::nullopt});
    }
    if (auto actions = check_actions(fleet, order); !actions) return fail(actions.error());
    auto stations = stations_of(fleet, order);
    if (!stations) return fail(stations.error());
    if (auto loads = check_transfers(fleet, order, *stations); !loads) return fail(loads.error());
    return CheckedOrder{std::move(*stations), std::move(after)};
}

}  // namespace pulseline::fleet
