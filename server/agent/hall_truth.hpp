#pragma once

#include <optional>
#include <vector>

#include "core/simulation/world/floor_camera.hpp"
#include "core/simulation/world/world.hpp"

/// What a simulated machine meets of its simulated hall.
namespace pulseline::agent {

/// The codes that its cameras may come to see from a true pose, where they truly lie. `drawn`: only
/// those that images can be made of.
std::vector<simulation::FloorCode> codes_around(const simulation::World& world,
                                                const plant::HallId& hall,
                                                const geometry::Pose2& true_pose, bool drawn);
/// What lies on a vehicle when the world begins; nothing: it is empty.
double first_load_kg(const plant::Plant& plant, const plant::Vehicle& vehicle);
std::optional<simulation::TrueLoad> carried_at_first(const plant::Plant& plant,
                                                     const plant::Vehicle& vehicle);
/// The contacts stand where the drawing says; the vehicle's stop is what is measured against them.
std::vector<geometry::Pose2> charger_contacts(const plant::Plant& plant);

/// Somebody left a box standing there, hall frame.
geometry::Polygon thing_at(geometry::Point2 place);

}  // namespace pulseline::agent
