#include <set>
#include <tuple>

#include "tests/simulation/fleet_judge_world.hpp"

// Laws of what a platform lifts and carries.
namespace pulseline::fleet_judge {

/// Brackets and feet move outside orders when a person has said so, and once for each word.
void World::check_lifts(const plant::VehicleId& id, const Vehicle& vehicle) {
    const auto& begun = vehicle.lifts_begun();
    for (auto& told = watch_[id].lifts_seen; told < begun.size(); ++told) {
        if (lifts_asked_.erase(begun[told]) == 0)
            violate(id.str() + " moves its brackets or feet without a person's word");
    }
}

/// A load is in one place, in the store as in the hall, and alone there. With one platform it is
/// always somewhere; with several the crane may have taken it away.
void World::check_place_of_load() {
    std::set<std::pair<plant::VehicleId, plant::StationId>> taken;
    for (const auto& load : plant_.loads) {
        const auto stored = store_.loads.find(load.id);
        if (stored == store_.loads.end()) continue;
        const auto& [vehicle, station] = std::tie(stored->second.vehicle, stored->second.station);
        const bool nowhere = vehicle.empty() && station.empty();
        if ((nowhere && platforms_.size() == 1) || (!vehicle.empty() && !station.empty()))
            violate("load " + load.id.str() + " is in no one place");
        if (!nowhere && !taken.emplace(vehicle, station).second)
            violate("load " + load.id.str() + " is where another one is");
    }
}

const plant::Load* World::stored_load_on(const plant::VehicleId& id) const {
    for (const auto& load : plant_.loads) {
        const auto stored = store_.loads.find(load.id);
        if (stored != store_.loads.end() && stored->second.vehicle == id) return &load;
    }
    return nullptr;
}

/// Nothing drives with a load that the store does not have on it, without one that it has, or with
/// a part of it, be it ever so much.
void World::check_load(const plant::VehicleId& id, const Vehicle& vehicle) {
    const auto* stored = stored_load_on(id);
    const auto carried = vehicle.load();
    const double kg = vehicle.load_kg();
    if (stored ? carried != stored->id : carried.has_value()) {
        violate(id.str() + " drives with " + std::to_string(kg) + " kg of " +
                (carried ? carried->str() : "nothing") + ", the store has " +
                (stored ? stored->id.str() : "nothing") + " on it");
    }
    for (const auto& station : plant_.stations) {
        const auto* place = supports_->above(station.hall, station.pose);
        if (carried && place && place->load && place->load->id == *carried)
            violate(id.str() + " drives with a part of its load");
    }
    if (carried) check_loads_apart(id, vehicle);
    if (carried || vehicle.type().brackets.empty()) return;
    const auto body = geometry::transformed(vehicle.pose(), vehicle.type().footprint);
    for (const auto& station : plant_.stations) {
        const auto* place = supports_->above(station.hall, station.pose);
        if (!place || !place->load || vehicle.bracket_height_m() < place->height_m) continue;
        if (geometry::intersects(body,
                                 geometry::transformed(station.pose, vehicle.type().footprint)))
            violate(id.str() + " drives its brackets into " + place->load->id.str());
    }
}

/// What it carries meets nothing that stands or hangs, or that another one carries.
void World::check_loads_apart(const plant::VehicleId& id, const Vehicle& vehicle) {
    const auto& outline = vehicle.type().load_footprint;
    const auto own = geometry::transformed(vehicle.pose(), outline);
    for (const auto& station : plant_.stations) {
        const auto* place = supports_->above(station.hall, station.pose);
        if (!place || !place->load) continue;
        if (geometry::intersects(own, geometry::transformed(station.pose, outline)))
            violate(id.str() + " drives its load into " + place->load->id.str());
    }
    for (const auto& other : platforms_) {
        if (other == id) continue;
        const auto& body = vehicles_.at(other);
        const auto& about = body.load() ? outline : body.type().footprint;
        if (geometry::intersects(own, geometry::transformed(body.pose(), about)))
            violate(id.str() + " drives its load into " + other.str());
    }
}

/// What is elsewhere than the server has it.
std::optional<std::string> World::unknown_load() const {
    for (const auto& id : platforms_) {
        std::optional<plant::LoadId> known;
        for (const auto& load : plant_.loads) {
            if (fleet_->load(load.id)->place.vehicle == id) known = load.id;
        }
        if (vehicles_.at(id).load() != known) return id.str();
    }
    for (const auto& load : plant_.loads) {
        const auto* at = plant::find_station(plant_, fleet_->load(load.id)->place.station);
        if (!at) continue;
        const auto* place = supports_->above(at->hall, at->pose);
        if (!place->load || place->load->id != load.id) return load.id.str();
    }
    return std::nullopt;
}

}  // namespace pulseline::fleet_judge
