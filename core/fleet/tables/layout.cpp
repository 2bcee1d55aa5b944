#include "core/fleet/tables/layout.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/fleet/tables/code_gaps.hpp"
#include "core/fleet/tables/code_speeds.hpp"
#include "core/fleet/tables/floor_graph.hpp"
#include "core/fleet/tables/light_gaps.hpp"
#include "core/fleet/tables/overhead.hpp"
#include "core/traffic/layout_check.hpp"

namespace pulseline::fleet {
namespace {

bool is_on_free_floor(const plant::Plant& plant, const plant::StationId& id) {
    const auto* station = plant::find_station(plant, id);
    return station != nullptr && station->node.empty();
}

/// No lane leads to stations on free floor: ways of their own have to, from another station and
/// back.
std::vector<Reason> check_free_floor(const plant::Plant& plant, const planning::LegPlanner& planner,
                                     const FloorClass& of_class) {
    std::vector<const plant::Station*> served;
    for (const auto& station : plant.stations) {
        const auto& types = station.vehicle_types;
        const bool serves =
            types.empty() || std::ranges::find(types, of_class.type->id) != types.end();
        if (serves) served.push_back(&station);
    }
    const auto leads = [&](const plant::Station& from, const plant::Station& to) {
        planning::LegRequest request;
        request.type = of_class.type;
        request.loaded = of_class.loaded;
        request.hall = from.hall;
        request.start = from.pose;
        request.from_station = from.id;
        request.target = to.id;
        return planner.plan_leg(request).has_value();
    };
    std::vector<Reason> reasons;
    for (const auto* station : served) {
        if (!station->node.empty()) continue;
        const auto other = std::ranges::find_if(served, [&](const plant::Station* one) {
            return one != station && one->hall == station->hall;
        });
        if (other == served.end() || (leads(**other, *station) && leads(*station, **other))) {
            continue;
        }
        reasons.push_back({"unreachable",
                           {{"class", of_class.type->id.str()},
                            {"from", (*other)->id.str()},
                            {"to", station->id.str()},
                            {"count", std::int64_t{1}}}});
    }
    return reasons;
}

}  // namespace

std::vector<Reason> check_layout(const plant::Plant& plant) {
    const planning::LegPlanner planner(plant);
    const auto overhead = overhead_of(plant);
    std::vector<FloorClass> classes;
    std::vector<std::size_t> vehicles;
    for (const auto& [type, loaded, count] : classes_of(plant)) {
        classes.push_back(floor_class(plant, planner, overhead, *type, loaded));
        vehicles.push_back(count);
    }
    std::vector<traffic::MoveGraph> graphs;
    for (const auto& of_class : classes) graphs.push_back(move_graph(plant, overhead, of_class));
    std::vector<traffic::LayoutClass> layout;
    for (std::size_t c = 0; c < classes.size(); ++c) {
        traffic::LayoutClass entry;
        entry.name = classes[c].type->id.str() + (classes[c].loaded ? " with load" : "");
        entry.graph = &graphs[c];
        entry.vehicles = vehicles[c];
        for (std::size_t p = 0; p < classes[c].motion.places.size(); ++p) {
            const auto& station = classes[c].motion.places[p].station;
            if (!station.empty() && !is_on_free_floor(plant, station))
                entry.goals.push_back(static_cast<traffic::PlaceIndex>(p));
            entry.place_names.push_back(station.str());
        }
        // No goal would mean every place. Who serves free floor only is none of the lanes' matter.
        if (!entry.goals.empty()) layout.push_back(std::move(entry));
    }
    std::vector<Reason> reasons;
    for (auto& violation : traffic::check_layout(layout)) {
        reasons.push_back(std::move(violation.reason));
    }
    for (const auto& of_class : classes) {
        std::ranges::move(check_free_floor(plant, planner, of_class), std::back_inserter(reasons));
    }
    std::ranges::move(check_codes(plant, classes), std::back_inserter(reasons));
    std::ranges::move(check_code_speeds(plant, classes), std::back_inserter(reasons));
    std::ranges::move(check_light(plant, classes), std::back_inserter(reasons));
    return reasons;
}

}  // namespace pulseline::fleet
