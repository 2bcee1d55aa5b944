#pragma once

#include <map>
#include <utility>
#include <vector>

#include "core/fleet/tables/hall_index.hpp"
#include "core/planning/legs/leg_planner.hpp"
#include "core/planning/roads/lane_lines.hpp"
#include "core/traffic/move_graph.hpp"

/// The floor of a plant as each class of its vehicles can use it.
namespace pulseline::fleet {

// Position error of a moving vehicle plus rounding; the planner's clearance is far larger.
constexpr double kFloorMargin_m = 0.10;

/// Vehicles of one type with the same outline: what they can do on the floor.
struct FloorClass {
    const plant::VehicleType* type = nullptr;
    bool loaded = false;
    traffic::GraphIndex graph = traffic::kNoGraph;
    planning::MotionGraph motion;                           // its places are those of the graph
    std::vector<std::optional<plant::Corridor>> corridors;  // of motion.ways
    std::vector<traffic::TileSet> stands;                   // of motion.places
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> way_between;  // of motion.ways
};

/// Every class that vehicles of the plant are of, or may come to be of as they take loads over and
/// set them down; `vehicles`: how many are so at first.
struct PlantClass {
    const plant::VehicleType* type = nullptr;
    bool loaded = false;
    std::size_t vehicles = 0;
};
std::vector<PlantClass> classes_of(const plant::Plant& plant);

/// `overhead`: overhead_of the plant.
FloorClass floor_class(const plant::Plant& plant, const planning::LegPlanner& planner,
                       const traffic::TileSet& overhead, const plant::VehicleType& type,
                       bool loaded);
/// Floor of a move along `way`: what the outline sweeps, and all of its corridor, in which the
/// vehicle may be anywhere meanwhile.
std::vector<geometry::Polygon> floor_along(const std::vector<geometry::Polygon>& outline,
                                           const kinematics::Segment& way,
                                           const std::optional<plant::Corridor>& corridor,
                                           const kinematics::SweepDetail& detail = {});
/// Straight on from one way to the next, both with a corridor: what goes round something there need
/// not be back on the line between them. The room at that place is the wider one of both.
std::optional<plant::Corridor> room_between(const kinematics::Segment& way,
                                            const std::optional<plant::Corridor>& corridor,
                                            const kinematics::Segment& next,
                                            const std::optional<plant::Corridor>& next_corridor);
/// Floor in which a vehicle may stand that stops at such a place.
geometry::Polygon room_about(const std::vector<geometry::Polygon>& outline,
                             const kinematics::Segment& next, const plant::Corridor& corridor);
/// The class's motions with the tiles that they sweep. Vehicles rest at stations that are resting
/// places; a plant that names none for a type lets it rest where it works.
traffic::MoveGraph move_graph(const plant::Plant& plant, const traffic::TileSet& overhead,
                              const FloorClass& of_class);

}  // namespace pulseline::fleet
