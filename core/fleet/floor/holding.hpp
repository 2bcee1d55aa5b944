#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// Which floor a vehicle holds that does not drive.
namespace pulseline::fleet {

/// Says of which class of the plant's tables a vehicle is, with what it carries.
void find_class(const FleetState& fleet, LiveVehicle& live);
/// The place of its class where it stands; kNoPlace: it stands at none.
traffic::PlaceIndex place_at(const FleetState& fleet, const LiveVehicle& live, const Pose2& pose);
/// Puts every vehicle on the floor its record says, base included.
void rebuild_floor(FleetState& fleet, Time now);

/// A vehicle without a leg stands where its record says. It keeps its plan when that is where the
/// plan has it, unless `give_up_plan`.
void hold_where_it_stands(FleetState& fleet, LiveVehicle& live, Time now,
                          bool give_up_plan = false);
/// Nobody knows where it stands: it keeps all its floor, and of that where it says that it stands
/// what is free.
void hold_both_floors(FleetState& fleet, LiveVehicle& live, Time now);
/// The vehicle is out of the hall: it holds no floor.
void leave_floor(FleetState& fleet, LiveVehicle& live, Time now);
/// The last approach was not successful enough to move on: floor for a correction in place.
void hold_for_correction(FleetState& fleet, LiveVehicle& live, const Pose2& target, Time now);

}  // namespace pulseline::fleet
