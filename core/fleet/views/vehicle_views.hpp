#pragma once

#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// Vehicles and stations as the fleet shows them.
namespace pulseline::fleet {

StationView station_view(const FleetState& fleet, const plant::Station& station);
/// All of them, with one look at every vehicle.
std::vector<StationView> station_views(const FleetState& fleet);
VehicleView view_of(const FleetState& fleet, const LiveVehicle& live, Time now,
                    bool with_leg = true);

}  // namespace pulseline::fleet
