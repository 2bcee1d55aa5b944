#include "core/fleet/vehicle/loads.hpp"

#include <cstdint>
#include <utility>

#include "core/base/params.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/plant/carrying.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

constexpr const char* kLoadId = "loadId";  // VDA 5050, pick

/// Says `<prefix>vehicle` or `<prefix>station`, its number; neither: it is not in the plant.
void tell_place(const FleetState& fleet, const LoadRecord& record, const std::string& prefix,
                Params& params) {
    if (!record.vehicle.empty()) params.push_back({prefix + "vehicle", record.vehicle.str()});
    const auto* station = plant::find_station(fleet.plant, record.station);
    if (station) params.push_back({prefix + "station", std::int64_t{station->number}});
}

Status may_pick(const FleetState& fleet, const LiveVehicle& live, const plant::Station& station,
                const StepAction& wanted) {
    const std::string& id = live.record.id.str();
    const plant::LoadId named = load_named(wanted);
    const auto* load = find_load(fleet, named);
    if (!load) {
        return fail(Errc::kUnreachable, "unknown_load", "There is no load \"" + named.str() + "\".",
                    "/load", {{"load", named.str()}});
    }
    if (const auto* on = load_on(fleet, live.record.id)) {
        return fail(Errc::kConflict, "vehicle_loaded",
                    "Vehicle " + id + " carries " + on->name + ". Set that down first.", {},
                    {{"vehicle", id}, {"load", on->name}});
    }
    if (load_at(fleet, station.id) != load) {
        Params params{{"load", load->name}};
        tell_place(fleet, fleet.loads.at(named), {}, params);
        return fail(Errc::kConflict, "load_elsewhere",
                    load->name + " is not here. Drive to where it is, or say that it is here.",
                    "/load", std::move(params));
    }
    if (auto why_not = plant::cannot_carry(*live.type, *load)) {
        return fail(Errc::kConflict, why_not->code.c_str(),
                    "Vehicles like " + id + " may not carry " + load->name + ".", "/load",
                    std::move(why_not->params));
    }
    return {};
}

Status may_drop(const FleetState& fleet, const LiveVehicle& live, const plant::Station& station) {
    const std::string& id = live.record.id.str();
    if (!load_on(fleet, live.record.id)) {
        return fail(Errc::kConflict, "vehicle_empty", "Vehicle " + id + " carries nothing.", {},
                    {{"vehicle", id}});
    }
    if (const auto* there = load_at(fleet, station.id)) {
        return fail(Errc::kConflict, "support_taken",
                    there->name + " is on the support of this station already.", {},
                    {{"load", there->name}});
    }
    for (const auto& bracket : live.state.brackets) {
        const double height_m = bracket.height_m.value_or(station.support->height_m);
        if (height_m >= station.support->height_m) continue;
        return fail(Errc::kConflict, "brackets_too_low",
                    "The brackets of " + id +
                        " are lower than what the load is set down on. Raise them first.",
                    {}, {{"height_m", height_m}, {"least_m", station.support->height_m}});
    }
    return {};
}

/// The plant may be another one than when that was stored.
bool may_still_be_there(const FleetState& fleet, const plant::Load& load,
                        const LoadRecord& record) {
    if (!record.vehicle.empty()) {
        const LiveVehicle* live = fleet.find(record.vehicle);
        return live && !plant::cannot_carry(*live->type, load);
    }
    if (record.station.empty()) return true;
    const auto* station = plant::find_station(fleet.plant, record.station);
    return station && station->support;
}

/// What it is about to take over, outside an order or in one; empty: nothing.
plant::LoadId taken_over_by(const LiveVehicle& live) {
    if (is_transferring(live)) return load_named(live.lift->what);
    if (!live.has_leg() || !live.leg().actions_only) return {};
    const auto& actions = live.leg().nodes.front().actions;
    if (actions.empty() || actions.front().type != vda5050::kPick) return {};
    const auto* id = text_param(actions.front().params, kLoadId);
    return id == nullptr ? plant::LoadId() : plant::LoadId(*id);
}

/// Where the plant's file has it at first, unless another one has got there, or its vehicle may not
/// carry it any more.
LoadPlace first_place(const FleetState& fleet, const plant::LoadId& id) {
    const auto* first = plant::find_load(fleet.plant, id);
    if (!first || load_on(fleet, first->vehicle) || load_at(fleet, first->station)) return {};
    const LoadRecord there{id, first->vehicle, first->station, {}, {}};
    if (!may_still_be_there(fleet, *find_load(fleet, id), there)) return {};
    return {first->vehicle, first->station};
}

}  // namespace

void restore_loads(FleetState& fleet, std::vector<LoadSheet> sheets, std::vector<LoadRecord> places,
                   Time now) {
    for (auto& sheet : sheets) {
        const auto id = sheet.load.id;
        fleet.load_sheets.emplace(id, std::move(sheet));
    }
    for (const auto& load : fleet.plant.loads) {
        fleet.load_sheets.emplace(load.id, LoadSheet{load, {}, {}, false});
    }
    std::vector<LoadRecord> displaced;
    for (auto& record : places) {
        const auto* load = find_load(fleet, record.id);
        if (!load) continue;
        if (!may_still_be_there(fleet, *load, record)) {
            displaced.push_back(std::move(record));
            continue;
        }
        const auto id = record.id;
        fleet.loads.emplace(id, std::move(record));
    }
    for (auto& record : displaced) {
        const auto id = record.id;
        const LoadPlace to = first_place(fleet, id);
        fleet.loads.emplace(id, std::move(record));
        move_load(fleet, id, to, {}, now);
    }
    for (const auto& [id, sheet] : fleet.load_sheets) {
        if (sheet.retired || fleet.loads.contains(id)) continue;
        const LoadPlace at = first_place(fleet, id);
        fleet.loads.emplace(id, LoadRecord{id, at.vehicle, at.station, now, {}});
    }
    find_loads(fleet);
}

const plant::Load* find_load(const FleetState& fleet, const plant::LoadId& id) {
    const auto sheet = fleet.load_sheets.find(id);
    return sheet == fleet.load_sheets.end() || sheet->second.retired ? nullptr
                                                                     : &sheet->second.load;
}

void find_loads(FleetState& fleet) {
    for (auto& [id, live] : fleet.vehicles) {
        live.load = load_on(fleet, id);
        if (!live.load) live.load = find_load(fleet, taken_over_by(live));
    }
}

plant::LoadId load_named(const StepAction& wanted) {
    const auto* name = text_param(wanted.params, "load");
    return name == nullptr ? plant::LoadId() : plant::LoadId(*name);
}

const plant::Load* load_on(const FleetState& fleet, const plant::VehicleId& vehicle) {
    if (vehicle.empty()) return nullptr;
    for (const auto& [id, record] : fleet.loads) {
        if (record.vehicle == vehicle) return find_load(fleet, id);
    }
    return nullptr;
}

const plant::Load* load_at(const FleetState& fleet, const plant::StationId& station) {
    if (station.empty()) return nullptr;
    for (const auto& [id, record] : fleet.loads) {
        if (record.station == station) return find_load(fleet, id);
    }
    return nullptr;
}

bool is_transferring(const LiveVehicle& live) {
    return live.lift && live.lift->state == LiftMove::State::kUnderWay &&
           vda5050::is_transfer(live.lift->what.type);
}

Status may_transfer(const FleetState& fleet, const LiveVehicle& live, const StepAction& wanted) {
    const auto* station = plant::find_station(fleet.plant, live.record.at_station);
    if (!station || !station->support) {
        return fail(Errc::kConflict, "no_support_here",
                    "Vehicle " + live.record.id.str() +
                        " does not stand where a load can hang or stand. Drive to a station with "
                        "a hoist or stands.",
                    {}, {{"vehicle", live.record.id.str()}});
    }
    if (wanted.type == vda5050::kPick) return may_pick(fleet, live, *station, wanted);
    return may_drop(fleet, live, *station);
}

vda5050::Action transfer_action(const FleetState& fleet, const LiveVehicle& live,
                                const StepAction& wanted) {
    const bool picks = wanted.type == vda5050::kPick;
    const auto* load =
        picks ? find_load(fleet, load_named(wanted)) : load_on(fleet, live.record.id);
    vda5050::Action action;
    action.type = wanted.type;
    action.params = {{kLoadId, load->id.str()}, {"weight", load->mass_kg}};
    return action;
}

void note_transferred(FleetState& fleet, LiveVehicle& live, const StepAction& done,
                      const MovedBy& by, Time now) {
    if (done.type == vda5050::kPick) {
        // The plant's file may have lost it since: then nobody here knows of it any more.
        if (!fleet.loads.contains(load_named(done))) return;
        move_load(fleet, load_named(done), {live.record.id, {}}, by, now);
    } else if (const auto* load = load_on(fleet, live.record.id)) {
        move_load(fleet, load->id, {{}, live.record.at_station}, by, now);
    }
}

Status is_not_taken_over(const FleetState& fleet, const plant::Load& load) {
    for (const auto& [id, live] : fleet.vehicles) {
        if (live.load != &load || fleet.loads.at(load.id).vehicle == id) continue;
        return fail(Errc::kConflict, "load_in_transfer",
                    "Vehicle " + id.str() + " is just taking " + load.name +
                        " over. Say it when that has ended.",
                    {}, {{"load", load.name}, {"vehicle", id.str()}});
    }
    return {};
}

void move_load(FleetState& fleet, const plant::LoadId& id, const LoadPlace& to, const MovedBy& by,
               Time now) {
    LoadRecord& record = fleet.loads.at(id);
    Params params{{"load", find_load(fleet, id)->name}};
    tell_place(fleet, record, "from_", params);
    const LoadRecord before =
        std::exchange(record, LoadRecord{id, to.vehicle, to.station, now, by.actor});
    tell_place(fleet, record, "to_", params);
    add_event(fleet, now, event::kLoadMoved, by.order, by.leg,
              to.vehicle.empty() ? before.vehicle : to.vehicle, by.actor, std::move(params));
    fleet.stored_loads.insert(id);
    fleet.floor.loads_moved = true;
    for (const auto* at : {&before, &std::as_const(record)}) {
        if (!at->vehicle.empty()) fleet.changed_vehicles.insert(at->vehicle);
        if (!at->station.empty()) fleet.changed_stations.insert(at->station);
    }
}

}  // namespace pulseline::fleet
