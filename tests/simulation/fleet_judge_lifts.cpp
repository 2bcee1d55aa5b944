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

/// A load is on one vehicle or at one station, in the store as in the hall.
void World::check_place_of_load() {
    for (const auto& [id, record] : store_.loads) {
        if (id != plant_.loads.front().id) continue;  // the others are papers only
        if (record.vehicle.empty() == record.station.empty())
            violate("load " + id.str() + " is in no one place");
    }
}

/// Nothing drives with a load that the store does not have on it, without one that it has, or with
/// a part of it.
void World::check_load(const plant::VehicleId& id, const Vehicle& vehicle) {
    const auto& load = plant_.loads.front();
    const auto stored = store_.loads.find(load.id);
    const bool has = stored != store_.loads.end() && stored->second.vehicle == id;
    const double kg = vehicle.load_kg();
    if (has != (kg > 0)) {
        violate(id.str() + " drives with " + std::to_string(kg) + " kg, the store has " +
                (has ? "the load on it" : "none on it"));
    } else if (has && kg < 0.9 * load.mass_kg) {
        violate(id.str() + " drives with a part of its load");
    }
}

bool World::load_is_known() const {
    const bool on = vehicles_.at(plant_.vehicles.back().id).load_kg() > 0;
    return on != fleet_->load(plant_.loads.front().id)->place.vehicle.empty();
}

}  // namespace pulseline::fleet_judge
