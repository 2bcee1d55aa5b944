#include "core/fleet/floor/standing_loads.hpp"

#include <algorithm>
#include <utility>

#include "core/fleet/tables/overhead.hpp"
#include "core/fleet/tables/plant_tables.hpp"
#include "core/fleet/vehicle/loads.hpp"

namespace pulseline::fleet {

bool update_standing_loads(FleetState& fleet, Time now) {
    if (!std::exchange(fleet.floor.loads_moved, false)) return false;
    auto& standing = fleet.floor.standing_loads;
    auto& traffic = fleet.floor.traffic;
    std::map<plant::StationId, StandingLoad> wanted;
    for (const auto& [id, record] : fleet.loads) {
        const auto* station = plant::find_station(fleet.plant, record.station);
        const auto* load = find_load(fleet, id);
        if (!station || !load) continue;
        wanted[station->id] = {id, room_of_load(fleet.plant, *load, *station), 0};
    }
    bool changed = false;
    std::erase_if(standing, [&](const auto& entry) {
        const auto& [station, known] = entry;
        const auto still = wanted.find(station);
        if (still != wanted.end() && still->second.load == known.load &&
            still->second.room == known.room) {
            wanted.erase(still);
            return false;
        }
        traffic.reopen(known.in_traffic, now);
        changed = true;
        return true;
    });
    for (auto& [station, fresh] : wanted) {
        fresh.in_traffic = traffic.close(fresh.room, now);
        standing.emplace(station, std::move(fresh));
        changed = true;
    }
    return changed;
}

std::vector<planning::ClosedFloor> closed_to_loads(const FleetState& fleet) {
    std::vector<planning::ClosedFloor> floors;
    for (const auto& [id, standing] : fleet.floor.standing_loads) {
        const auto* station = plant::find_station(fleet.plant, id);
        const auto* load = find_load(fleet, standing.load);
        if (!station || !load) continue;
        planning::ClosedFloor floor;
        floor.id = load->id.str();
        floor.name = load->name;
        floor.hall = station->hall;
        floor.pieces = outline_of_load(fleet.plant, *load, *station);
        floor.margin_m = kFloorMargin_m;
        floor.to_loads_only = true;
        floors.push_back(std::move(floor));
    }
    return floors;
}

const StandingLoad* standing_load_at(const FleetState& fleet, traffic::TileId tile) {
    if (!traffic::is_above_floor(tile)) return nullptr;
    for (const auto& [station, standing] : fleet.floor.standing_loads) {
        if (std::ranges::binary_search(standing.room, tile)) return &standing;
    }
    return nullptr;
}

Reason load_in_the_way(const FleetState& fleet, const StandingLoad& standing) {
    const auto* load = find_load(fleet, standing.load);
    const auto* station = plant::find_station(fleet.plant, fleet.loads.at(standing.load).station);
    Reason reason{"load_in_the_way", {{"load", load ? load->name : standing.load.str()}}};
    if (station) reason.params.push_back({"station", std::int64_t{station->number}});
    return reason;
}

Status has_room_at(const FleetState& fleet, const plant::Load& load, const plant::Station& station,
                   const plant::VehicleId& from) {
    for (const auto tile : room_of_load(fleet.plant, load, station)) {
        const auto holder = fleet.floor.traffic.holder(tile);
        if (!holder) continue;
        const std::string& name = fleet.floor.traffic.name(*holder);
        if (name == from.str()) continue;
        return fail(Errc::kConflict, "floor_held",
                    "Vehicle " + name + " carries a load where " + load.name +
                        " would be. Send it away first.",
                    "/station", {{"vehicle", name}});
    }
    return {};
}

}  // namespace pulseline::fleet
