#include <algorithm>
#include <string>
#include <vector>

#include "tests/simulation/fleet_judge_plant.hpp"
#include "tests/simulation/fleet_judge_world.hpp"

// People register loads, have them weighed and let them leave for ever, while the platform works
// with the one of the plant.
namespace pulseline::fleet_judge {

void World::keep_papers() {
    if (!disturbed_ || now_s_ < next_papers_s_) return;
    next_papers_s_ = now_s_ + fleet_judge::pick(papers_random_, 20, 300);
    switch (fleet_judge::pick(papers_random_, 0, 3)) {
        case 0:
            return register_load();
        case 1:
            return retire_load();
        default:
            return weigh_load();
    }
}

void World::register_load() {
    plant::Load load = plant_.loads.front();
    load.id = plant::LoadId("N-" + std::to_string(++registered_loads_));
    load.name = load.id.str();
    const std::uint64_t servers = servers_;
    if (!fleet_->put_load(load, "planner", now())) {
        return violate("load " + load.id.str() + " was not registered");
    }
    settle();
    if (servers != servers_ || unstored_) return;  // it died over it
    ++outcome_.faults["person: registers a load"];
    if (!store_.load_sheets.contains(load.id)) {
        violate("load " + load.id.str() + " was acknowledged and not stored");
    }
}

/// By so much as scales differ, so that it weighs on the platform as it is known to.
void World::weigh_load() {
    plant::Load load = fleet_->load(plant_.loads.front().id)->sheet.load;
    load.mass_kg =
        plant_.loads.front().mass_kg * (1 + 0.001 * fleet_judge::pick(papers_random_, -20, 20));
    const std::uint64_t servers = servers_;
    if (!fleet_->put_load(load, "planner", now())) return;  // its platform is at work
    settle();
    if (servers != servers_ || unstored_) return;
    ++outcome_.faults["person: has a load weighed"];
    const auto kept = store_.load_sheets.find(load.id);
    const bool is = kept != store_.load_sheets.end() && kept->second.load.mass_kg == load.mass_kg;
    if (!is && load.mass_kg != plant_.loads.front().mass_kg) {
        violate("what load " + load.id.str() + " weighs was acknowledged and not stored");
    }
}

void World::retire_load() {
    const auto& first = plant_.loads.front().id;
    const auto place = fleet_->load(first)->place;
    const bool is_away = place.vehicle.empty() && place.station.empty();
    if (!is_away && fleet_->retire_load(first, "planner", now())) {
        return violate("the load that is at work was retired");
    }
    std::vector<plant::LoadId> others;
    for (const auto& known : fleet_->loads()) {
        if (plant::find_load(plant_, known.sheet.load.id)) continue;  // at work
        others.push_back(known.sheet.load.id);
    }
    if (others.empty()) return;
    const int which = fleet_judge::pick(papers_random_, 0, static_cast<int>(others.size()) - 1);
    const auto& id = others[static_cast<std::size_t>(which)];
    const std::uint64_t servers = servers_;
    if (!fleet_->retire_load(id, "planner", now())) {
        return violate("load " + id.str() + ", which is nowhere, was not retired");
    }
    settle();
    if (servers != servers_ || unstored_) return;
    ++outcome_.faults["person: retires a load"];
    if (!store_.load_sheets.at(id).retired) {
        violate("load " + id.str() + " was retired, acknowledged and not stored");
    }
}

/// What has been said of a load is known by every server that comes, and what was retired stays so.
void World::check_papers() {
    if (unstored_ || now_s_ < stalled_until_s_) return;
    for (const auto& [id, kept] : store_.load_sheets) {
        const auto known = fleet_->load(id);
        if (known.has_value() == kept.retired) {
            violate("load " + id.str() + (kept.retired ? " is back" : " is forgotten"));
        } else if (known && known->sheet.load.mass_kg != kept.load.mass_kg) {
            violate("what is known of load " + id.str() + " is not what was stored");
        }
    }
}

}  // namespace pulseline::fleet_judge
