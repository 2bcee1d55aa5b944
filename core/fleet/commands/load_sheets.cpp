#include <algorithm>
#include <utility>

#include "core/base/params.hpp"
#include "core/fleet/dispatch/dispatch.hpp"
#include "core/fleet/fleet.hpp"
#include "core/fleet/floor/closures.hpp"
#include "core/fleet/journal/recorder.hpp"
#include "core/fleet/orders/order_loads.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/plant/carrying.hpp"
#include "core/plant/validate.hpp"

// What people know of loads. Nothing moves by it, and no floor is held otherwise: whatever a type
// carries stays within the outline that it is planned with.
namespace pulseline::fleet {
namespace {

/// Of those that have not left for ever. A line builds some dozens at a time.
constexpr std::size_t kMostLoads = 1000;

/// Of the sheet, for which a reason stands.
std::string field_of(const Reason& reason) {
    if (reason.code == "load_too_heavy") return "/mass_kg";
    if (reason.code == "load_too_large") return "/outline";
    if (reason.code == "load_not_for_type") return "/vehicle_types";
    return "/centre";
}

tl::unexpected<Error> not_carried(Reason reason, const std::string& who, const plant::Load& load) {
    std::string field = field_of(reason);
    return fail(Errc::kUnreachable, reason.code.c_str(),
                who + " may not carry " + load.name + " as it is described. Correct what is wrong.",
                std::move(field), std::move(reason.params));
}

/// Thousands of corners or types of many loads would fill every list of them.
constexpr std::size_t kMostCorners = 64;

Status is_sound(const FleetState& fleet, const plant::Load& known) {
    const bool corners = known.outline.size() > kMostCorners;
    const std::size_t types = fleet.plant.vehicle_types.size();
    if (corners || known.vehicle_types.size() > types) {
        const std::size_t most = corners ? kMostCorners : types;
        return fail(Errc::kInvalid, "too_many",
                    "At most " + std::to_string(most) + " of them. Leave out what is not needed.",
                    corners ? "/outline" : "/vehicle_types",
                    {{"most", static_cast<std::int64_t>(most)}});
    }
    if (const auto faults = plant::validate_load(fleet.plant, known); !faults.empty()) {
        const auto& fault = faults.front();
        const bool unknown = fault.code == "unknown_vehicle_type";
        return fail(unknown ? Errc::kUnreachable : Errc::kInvalid, fault.code.c_str(),
                    fault.what + " " + fault.remedy, fault.element);
    }
    if (auto why_not = plant::nobody_can_carry(fleet.plant, known)) {
        return not_carried(std::move(*why_not), "Vehicles of this plant", known);
    }
    return {};
}

/// People tell loads by their names.
Status is_alone(const FleetState& fleet, const plant::Load& known) {
    const auto same = std::ranges::find_if(fleet.loads, [&](const auto& entry) {
        return entry.first != known.id && find_load(fleet, entry.first)->name == known.name;
    });
    if (same == fleet.loads.end()) return {};
    return fail(Errc::kConflict, "load_name_taken",
                "Load " + same->first.str() + " is called " + known.name +
                    " already. Choose a name by which people can tell them apart.",
                "/name", {{"name", known.name}, {"load", same->first.str()}});
}

/// With the vehicle that has it, or is about to, nothing is under way.
Status may_be_known_anew(const FleetState& fleet, const plant::Load& before,
                         const plant::Load& known) {
    if (Status free = is_not_taken_over(fleet, before); !free) return free;
    const LiveVehicle* live = fleet.find(fleet.loads.at(before.id).vehicle);
    if (!live) return {};
    const std::string& id = live->record.id.str();
    if (live->has_leg() || live->state.driving || lifts_move(*live)) {
        return fail(Errc::kConflict, "vehicle_busy",
                    "Vehicle " + id + " is on its way with " + before.name +
                        ", or moves its brackets. Say it when that has ended.",
                    {}, {{"vehicle", id}});
    }
    if (auto why_not = plant::cannot_carry(*live->type, known)) {
        return not_carried(std::move(*why_not), "Vehicle " + id, known);
    }
    return {};
}

bool same(const plant::Load& a, const plant::Load& b) {
    return a.name == b.name && a.names == b.names && a.kind == b.kind && a.model == b.model &&
           a.mass_kg == b.mass_kg && a.centre == b.centre && a.outline == b.outline &&
           a.vehicle_types == b.vehicle_types;
}

}  // namespace

Result<KnownLoad> Fleet::put_load(const plant::Load& known, const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::put_load>(now, known, actor);
    const auto sheet = fleet.load_sheets.find(known.id);
    const bool is_new = sheet == fleet.load_sheets.end();
    if (!is_new && sheet->second.retired) {
        return fail(Errc::kConflict, "load_retired",
                    known.id.str() +
                        " has left for ever, and its history belongs to that id. "
                        "Choose another one.",
                    {}, {{"load", known.id.str()}});
    }
    if (!is_new && same(sheet->second.load, known)) return *load(known.id);
    Status may = is_sound(fleet, known);
    if (may) may = is_alone(fleet, known);
    if (may && !is_new) may = may_be_known_anew(fleet, sheet->second.load, known);
    if (!may) return fail(std::move(may).error());
    if (is_new && fleet.loads.size() >= kMostLoads) {
        return fail(Errc::kConflict, "too_many_loads",
                    "There are " + std::to_string(kMostLoads) +
                        " loads already. Retire those that have left for ever.",
                    {}, {{"most", static_cast<std::int64_t>(kMostLoads)}});
    }
    Params params{{"load", known.name}, {"load_kg", known.mass_kg}};
    if (!is_new) params.push_back({"from_load_kg", sheet->second.load.mass_kg});
    // A sheet keeps its place in memory: vehicles know their load by it.
    LoadSheet& kept = fleet.load_sheets[known.id];
    kept = {known, now, actor, false};
    kept.load.vehicle = {};
    kept.load.station = {};
    fleet.stored_load_sheets.insert(known.id);
    if (is_new) {
        fleet.loads.emplace(known.id, LoadRecord{known.id, {}, {}, now, actor});
        fleet.stored_loads.insert(known.id);
    }
    fleet.floor.loads_moved = true;  // its outline may be another one
    close_below_loads(fleet, now);
    const auto& at = fleet.loads.at(known.id);
    if (!at.vehicle.empty()) fleet.changed_vehicles.insert(at.vehicle);
    add_event(fleet, now, is_new ? event::kLoadRegistered : event::kLoadChanged, {}, {}, at.vehicle,
              actor, std::move(params));
    dispatch(fleet, now);
    return *load(known.id);
}

Status Fleet::retire_load(const plant::LoadId& id, const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::retire_load>(now, id, actor);
    const auto at = fleet.loads.find(id);
    if (at == fleet.loads.end()) {
        return fail(Errc::kNotFound, "unknown_load", "There is no load " + id.str() + ".", {},
                    {{"load", id.str()}});
    }
    LoadSheet& sheet = fleet.load_sheets.at(id);
    const std::string name = sheet.load.name;
    if (!at->second.vehicle.empty() || !at->second.station.empty()) {
        return fail(Errc::kConflict, "load_in_plant",
                    name + " is still in the plant. Say first that it has left.", {},
                    {{"load", name}});
    }
    if (const JobOrder* order = order_of_load(fleet, id)) {
        const std::string number = "JO-" + std::to_string(order->number);
        return fail(Errc::kConflict, "load_in_order",
                    number + " will take " + name + " over. Cancel it first.", {},
                    {{"load", name}, {"order", number}});
    }
    sheet.retired = true;
    sheet.at = now;
    sheet.actor = actor;
    fleet.loads.erase(at);
    fleet.stored_loads.erase(id);
    fleet.stored_load_sheets.insert(id);
    add_event(fleet, now, event::kLoadRetired, {}, {}, {}, actor, {{"load", name}});
    dispatch(fleet, now);
    return {};
}

}  // namespace pulseline::fleet
