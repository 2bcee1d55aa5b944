#include <utility>

#include "core/fleet/commands/reachable.hpp"
#include "core/fleet/dispatch/dispatch.hpp"
#include "core/fleet/fleet.hpp"
#include "core/fleet/floor/carrying.hpp"
#include "core/fleet/floor/closures.hpp"
#include "core/fleet/floor/standing_loads.hpp"
#include "core/fleet/journal/recorder.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/plant/carrying.hpp"

// What people say of loads.
namespace pulseline::fleet {
namespace {

/// A drive under way was planned, and its floor is held, with what it carries.
Status may_change(const LiveVehicle& live, const std::string& field) {
    const std::string& id = live.record.id.str();
    if (!live.has_leg() && !live.state.driving && !lifts_move(live)) return {};
    return fail(Errc::kConflict, "vehicle_busy",
                "Vehicle " + id +
                    " is on its way or moves its brackets. Say what it carries when that has "
                    "ended.",
                field, {{"vehicle", id}});
}

Status may_be_on(const FleetState& fleet, const plant::Load& load, const plant::VehicleId& id) {
    const LiveVehicle* live = fleet.find(id);
    if (!live) {
        return fail(Errc::kUnreachable, "unknown_vehicle", "There is no vehicle " + id.str() + ".",
                    "/vehicle", {{"vehicle", id.str()}});
    }
    if (const auto* on = load_on(fleet, id); on && on != &load) {
        return fail(
            Errc::kConflict, "vehicle_loaded",
            "Vehicle " + id.str() + " carries " + on->name + ". Say first where that has gone.",
            "/vehicle", {{"vehicle", id.str()}, {"load", on->name}});
    }
    if (auto why_not = plant::cannot_carry(*live->type, load)) {
        return fail(Errc::kConflict, why_not->code.c_str(),
                    "Vehicles like " + id.str() + " may not carry " + load.name + ".", "/vehicle",
                    std::move(why_not->params));
    }
    return may_change(*live, "/vehicle");
}

Status may_be_at(const FleetState& fleet, const plant::Load& load, const plant::StationId& id,
                 const plant::VehicleId& from) {
    const auto* station = plant::find_station(fleet.plant, id);
    if (!station) {
        return fail(Errc::kUnreachable, "unknown_station", "There is no station " + id.str() + ".",
                    "/station", {{"station", id.str()}});
    }
    if (!station->support) {
        return fail(Errc::kConflict, "no_support",
                    "Nothing holds a load at station " + std::to_string(station->number) + ".",
                    "/station", {{"station", std::int64_t{station->number}}});
    }
    if (const auto* there = load_at(fleet, id); there && there != &load) {
        return fail(Errc::kConflict, "support_taken",
                    there->name + " is there already. Say first where that has gone.", "/station",
                    {{"load", there->name}});
    }
    return has_room_at(fleet, load, *station, from);
}

}  // namespace

Result<KnownLoad> Fleet::place_load(const plant::LoadId& id, const LoadPlace& where,
                                    const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::place_load>(now, id, where, actor);
    const auto* load = find_load(fleet, id);
    if (!load) {
        return fail(Errc::kNotFound, "unknown_load", "There is no load " + id.str() + ".", {},
                    {{"load", id.str()}});
    }
    const LoadRecord before = fleet.loads.at(id);
    if (before.vehicle == where.vehicle && before.station == where.station) return *this->load(id);
    LiveVehicle* from = fleet.find(before.vehicle);
    Status may = is_not_taken_over(fleet, *load);
    if (may && from) may = may_change(*from, {});
    if (may && !where.vehicle.empty()) may = may_be_on(fleet, *load, where.vehicle);
    if (may && !where.station.empty()) may = may_be_at(fleet, *load, where.station, before.vehicle);
    if (!may) return fail(std::move(may).error());
    if (LiveVehicle* to = fleet.find(where.vehicle)) {
        if (Status held = hold_floor_with(fleet, *to, load, now); !held) {
            return fail(std::move(held).error());
        }
    }
    move_load(fleet, id, where, {actor}, now);
    close_below_loads(fleet, now);
    if (from) settle_load(fleet, *from, now);
    dispatch(fleet, now);
    return *this->load(id);
}

}  // namespace pulseline::fleet
