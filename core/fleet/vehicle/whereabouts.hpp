#pragma once

#include <string>
#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// Where a vehicle stands: its hall, its station, its place among the others.
namespace pulseline::fleet {

/// Somebody has told where it stands, or has known; else it is only presumed to stand at home.
bool has_stood(const VehicleRecord& record);
std::string hall_of(const FleetState& fleet, const LiveVehicle& live);
std::size_t hall_index(const FleetState& fleet, const std::string& hall);
/// Station whose theoretical pose the vehicle stands on (within 0.25 m and 3 deg); empty: none.
plant::StationId station_at(const FleetState& fleet, const LiveVehicle& live, const Pose2& pose);
std::vector<planning::StandingBody> standing_bodies(const FleetState& fleet,
                                                    const plant::HallId& hall,
                                                    const plant::VehicleId& except);
bool is_in_doubt(const LiveVehicle& live);
/// Halls can be told apart by name only.
bool is_in_hall(const FleetState& fleet, const Whereabouts& where);

}  // namespace pulseline::fleet
