#include "core/fleet/views/station_news.hpp"

#include <utility>

#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {

StationNews::Meaning StationNews::meaning_of(const VehicleRun& run) {
    const VehicleRecord& record = run.record;
    return {record.at_station,       run.has_leg() ? run.leg().station : plant::StationId{},
            record.last_stop,        record.last_stop_station,
            record.last_stop_inside, run.has_leg()};
}

void StationNews::begin(const FleetState& fleet) {
    for (const auto& [id, run] : fleet.vehicles) told_[id] = meaning_of(run);
}

std::set<plant::StationId> StationNews::of(const FleetState& fleet,
                                           const std::set<plant::VehicleId>& changed) {
    std::set<plant::StationId> news;
    for (const auto& id : changed) {
        const VehicleRun* run = fleet.find(id);
        if (!run) continue;
        const Meaning now = meaning_of(*run);
        const Meaning before = std::exchange(told_[id], now);
        if (now == before) continue;
        news.insert({before.stands_at, before.goes_to, now.stands_at, now.goes_to});
    }
    news.erase(plant::StationId{});
    return news;
}

}  // namespace pulseline::fleet
