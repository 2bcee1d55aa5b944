#pragma once

#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "core/kinematics/motion.hpp"
#include "core/mapping/map_builder.hpp"
#include "core/simulation/world/world.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::agent {

/// Along every lane of the hall that can be reached from here, there and back, turning on the spot;
/// at stations of `turns_as` also as a vehicle of that type stands there, with all its cameras over
/// codes, which tells best how it is turned. Error: no_lanes {hall}.
Result<std::vector<kinematics::Segment>> way_over_lanes(
    const plant::Plant& plant, const plant::HallId& hall, const geometry::Pose2& from,
    const plant::VehicleType* turns_as = nullptr);

/// Edges of an order over these segments, with the codes that come below the cameras on each.
std::deque<vda5050::OrderEdge> edges_over(const plant::Plant& plant, const plant::HallId& hall,
                                          std::span<const plant::Camera> cameras,
                                          std::span<const kinematics::Segment> way);

/// A vehicle that stands where `way` begins drives along it, correcting where it believes to be by
/// the codes that it passes, and builds the map of the hall from what its scanners see.
/// `progress`: the share driven, now and then; `within_m`: as mapping::MapBuilder says;
/// where that is more than usual, it draws only while its heading is known well. Errors:
/// mapping_stopped {cause, driven_m}.
Result<mapping::OccupancyMap> map_hall(const simulation::World& world,
                                       const plant::Vehicle& vehicle, const plant::HallId& hall,
                                       const std::vector<kinematics::Segment>& way,
                                       std::uint64_t seed,
                                       const std::function<void(double)>& progress,
                                       double within_m = mapping::MapBuilder::kWithin_m);

}  // namespace pulseline::agent
