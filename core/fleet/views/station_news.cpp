#include "core/fleet/views/station_news.hpp"

#include <utility>

#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {

StationNews::Meaning StationNews::meaning_of(const LiveVehicle& live) {
    const VehicleRecord& record = live.record;
    return {record.at_station,       live.has_leg() ? live.leg().station : plant::StationId{},
            record.last_stop,        record.last_stop_station,
            record.last_stop_inside, live.has_leg()};
}

void StationNews::begin(const FleetState& fleet) {
    for (const auto& [id, live] : fleet.vehicles) told_[id] = meaning_of(live);
}

std::set<plant::StationId> StationNews::of(const FleetState& fleet,
                                           const std::set<plant::VehicleId>& changed) {
    std::set<plant::StationId> news;
    for (const auto& id : changed) {
        const LiveVehicle* live = fleet.find(id);
        if (!live) continue;
        const Meaning now = meaning_of(*live);
        const Meaning before = std::exchange(told_[id], now);
        if (now == before) continue;
        news.insert({before.stands_at, before.goes_to, now.stands_at, now.goes_to});
    }
    news.erase(plant::StationId{});
    return news;
}

}  // namespace pulseline::fleet
