#include "core/fleet/tables/floor_graph.hpp"

#include <algorithm>
#include <cmath>

#include "core/fleet/tables/overhead.hpp"
#include "core/plant/carrying.hpp"

namespace pulseline::fleet {

std::vector<PlantClass> classes_of(const plant::Plant& plant) {
    std::vector<PlantClass> classes;
    const auto note = [&](const plant::VehicleType* type, bool loaded, std::size_t vehicles) {
        const auto known = std::ranges::find_if(classes, [&](const PlantClass& one) {
            return one.type == type && one.loaded == loaded;
        });
        if (known == classes.end()) return classes.push_back({type, loaded, vehicles});
        known->vehicles += vehicles;
    };
    for (const auto& vehicle : plant.vehicles) {
        const auto* type = plant::find_vehicle_type(plant, vehicle.type);
        if (!type) continue;  // validate() refuses such a plant
        const bool loaded = plant::first_load(plant, vehicle.id) != nullptr;
        note(type, loaded, 1);
        // Loads that nobody knows of yet come to whoever has brackets.
        const bool may_carry = !type->brackets.empty() ||
                               std::ranges::any_of(plant.loads, [&](const plant::Load& load) {
                                   return !plant::cannot_carry(*type, load);
                               });
        if (loaded || may_carry) note(type, !loaded, 0);
    }
    return classes;
}

namespace {

constexpr double kSameLine_rad = 0.02;

double travel_rad(const kinematics::Segment& straight) {
    return straight.start.heading_rad + straight.direction_rad;
}

/// Where the body may be beside the line, too, when it stops between two lanes with corridors.
void widen_stands(const plant::Plant& plant, const traffic::TileSet& overhead,
                  const std::vector<geometry::Polygon>& body, FloorClass& of_class) {
    const auto& motion = of_class.motion;
    std::vector<std::vector<std::size_t>> into(motion.places.size());
    for (std::size_t i = 0; i < motion.ways.size(); ++i) {
        if (of_class.corridors[i]) into[motion.ways[i].to].push_back(i);
    }
    for (std::size_t i = 0; i < motion.ways.size(); ++i) {
        if (!of_class.corridors[i]) continue;
        const auto& next = motion.ways[i];
        for (const std::size_t before : into[next.from]) {
            const auto room = room_between(motion.ways[before].segment, of_class.corridors[before],
                                           next.segment, of_class.corridors[i]);
            if (!room) continue;
            auto& stand = of_class.stands[next.from];
            const std::size_t hall = hall_index(plant, motion.places[next.from].hall);
            stand = traffic::merge(
                stand, tiles_of_body(overhead, hall, {room_about(body, next.segment, *room)},
                                     kFloorMargin_m, of_class.loaded));
        }
    }
}

}  // namespace

std::vector<geometry::Polygon> floor_along(const std::vector<geometry::Polygon>& outline,
                                           const kinematics::Segment& way,
                                           const std::optional<plant::Corridor>& corridor,
                                           const kinematics::SweepDetail& detail) {
    auto floor = kinematics::sweep(outline, {way}, detail);
    if (corridor) {
        floor.push_back(plant::corridor_band(way.start.position(), way.end.position(), *corridor,
                                             plant::reach_m(outline)));
    }
    return floor;
}

std::optional<plant::Corridor> room_between(const kinematics::Segment& way,
                                            const std::optional<plant::Corridor>& corridor,
                                            const kinematics::Segment& next,
                                            const std::optional<plant::Corridor>& next_corridor) {
    if (!corridor || !next_corridor ||
        std::abs(wrap(travel_rad(way) - travel_rad(next))) > kSameLine_rad ||
        std::abs(wrap(way.end.heading_rad - next.start.heading_rad)) > kSameLine_rad) {
        return std::nullopt;
    }
    return plant::Corridor{std::max(corridor->left_m, next_corridor->left_m),
                           std::max(corridor->right_m, next_corridor->right_m)};
}

geometry::Polygon room_about(const std::vector<geometry::Polygon>& outline,
                             const kinematics::Segment& next, const plant::Corridor& corridor) {
    const geometry::Point2 at = next.start.position();
    const double travel = travel_rad(next);
    const double reach_m = plant::reach_m(outline);
    const geometry::Point2 ahead{reach_m * std::cos(travel), reach_m * std::sin(travel)};
    return plant::corridor_band(at - ahead, at + ahead, corridor, 0);
}

FloorClass floor_class(const plant::Plant& plant, const planning::LegPlanner& planner,
                       const traffic::TileSet& overhead, const plant::VehicleType& type,
                       bool loaded) {
    FloorClass made;
    made.type = &type;
    made.loaded = loaded;
    made.motion = planner.motion_graph(type, loaded);
    const auto body = plant::outline_with_load(type, loaded);
    for (const auto& place : made.motion.places) {
        std::vector<geometry::Polygon> standing;
        for (const auto& piece : body) {
            standing.push_back(geometry::transformed(place.pose, piece));
        }
        made.stands.push_back(tiles_of_body(overhead, hall_index(plant, place.hall), standing,
                                            kFloorMargin_m, loaded));
    }
    for (std::size_t i = 0; i < made.motion.ways.size(); ++i) {
        made.way_between[{made.motion.ways[i].from, made.motion.ways[i].to}] = i;
    }
    const planning::LaneLines lines(plant);
    for (const auto& way : made.motion.ways) {
        made.corridors.push_back(
            lines.along(made.motion.places[way.from].hall, way.segment).corridor);
    }
    widen_stands(plant, overhead, body, made);
    return made;
}

traffic::MoveGraph move_graph(const plant::Plant& plant, const traffic::TileSet& overhead,
                              const FloorClass& of_class) {
    traffic::MoveGraph graph;
    const auto body = plant::outline_with_load(*of_class.type, of_class.loaded);
    const auto& motion = of_class.motion;
    bool any_resting = false;
    for (std::size_t i = 0; i < motion.places.size(); ++i) {
        const auto* station = plant::find_station(plant, motion.places[i].station);
        const bool resting = station && station->resting_place;
        graph.places.push_back({of_class.stands[i], resting});
        any_resting |= resting;
    }
    for (std::size_t i = 0; !any_resting && i < graph.places.size(); ++i) {
        graph.places[i].resting = !motion.places[i].station.empty();
    }
    for (std::size_t i = 0; i < motion.ways.size(); ++i) {
        const auto& way = motion.ways[i];
        traffic::Move move;
        move.from = static_cast<traffic::PlaceIndex>(way.from);
        move.to = static_cast<traffic::PlaceIndex>(way.to);
        move.duration_s = way.duration_s;
        // Coarse pieces hold all of the sweep, too, and there are many turns.
        move.swept = tiles_of_body(
            overhead, hall_index(plant, motion.places[way.from].hall),
            floor_along(body, way.segment, of_class.corridors[i], kinematics::kOutlineDetail),
            kFloorMargin_m, of_class.loaded);
        graph.moves.push_back(std::move(move));
    }
    return graph;
}

}  // namespace pulseline::fleet
