#include "core/fleet/fleet.hpp"
#include "core/fleet/views/vehicle_views.hpp"

namespace pulseline::fleet {

std::optional<JobOrder> Fleet::order(JobOrderId id) const { return state_->orders.look_up(id); }

std::vector<JobOrder> Fleet::orders() const {
    constexpr std::size_t kRecent = 100;  // the store has the rest
    return state_->orders.newest_first(kRecent);
}

std::optional<VehicleView> Fleet::vehicle(const plant::VehicleId& id, Time now,
                                          bool with_leg) const {
    const LiveVehicle* live = state_->find(id);
    if (!live) return std::nullopt;
    return view_of(*state_, *live, now, with_leg);
}

std::vector<VehicleView> Fleet::vehicles(Time now) const {
    std::vector<VehicleView> views;
    for (const auto& [id, live] : state_->vehicles) views.push_back(view_of(*state_, live, now));
    return views;
}

std::vector<KnownLoad> Fleet::loads() const {
    std::vector<KnownLoad> loads;
    for (const auto& [id, place] : state_->loads) {
        loads.push_back({state_->load_sheets.at(id), place});
    }
    return loads;
}

std::optional<KnownLoad> Fleet::load(const plant::LoadId& id) const {
    const auto place = state_->loads.find(id);
    if (place == state_->loads.end()) return std::nullopt;
    return KnownLoad{state_->load_sheets.at(id), place->second};
}

std::vector<StationView> Fleet::stations() const { return station_views(*state_); }

std::optional<StationView> Fleet::station(int number) const {
    const auto* station = plant::find_station(state_->plant, number);
    return station ? std::optional(station_view(*state_, *station)) : std::nullopt;
}

std::int64_t Fleet::last_event_seq() const { return state_->event_seq; }

FleetView Fleet::view(Time) const {
    FleetView view;
    view.store_fault = state_->store_fault;
    view.clock_difference = state_->clock_difference;
    // While nothing can be stored, events still wait; a reader must not go on behind them.
    view.last_event_seq = state_->store_fault ? state_->stored_seq : state_->event_seq;
    view.started = state_->started;
    view.paused = !state_->vehicles.empty();
    for (const auto& [id, live] : state_->vehicles) {
        ++view.vehicles_total;
        if (live.link == Link::kLive) ++view.vehicles_live;
        if (live.record.needs_resume) view.needs_resume.push_back(id);
        const auto& pause = live.record.paused;
        if (!pause) view.paused = false;
        if (pause && pause->with_fleet && (!view.pause || view.pause->at < pause->at)) {
            view.pause = pause;
        }
    }
    return view;
}

}  // namespace pulseline::fleet
