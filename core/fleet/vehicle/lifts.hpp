#pragma once

#include <string>

#include "core/base/result.hpp"
#include "core/fleet/state/fleet_state.hpp"

/// Brackets and parking feet that a person moves outside an order (Tang 2020, section 2: workflow
/// of the parked platform).
namespace pulseline::fleet {

/// Whether its type has the bracket or foot, and can move it so: unknown_bracket, unknown_foot,
/// out_of_stroke {height_m, stroke_m}, out_of_speed {speed_mps, most_mps}, each at its parameter
/// below `field`. What neither moves brackets nor feet is no matter of this.
Status has_lift(const LiveVehicle& live, const StepAction& wanted, const std::string& field);

/// Whether a person may have them moved so now. Errors, each with its remedy: unknown_lift,
/// unknown_bracket and out_of_stroke of what the vehicle does not have; needs_person,
/// vehicle_paused, vehicle_busy and lifts_moving; and what is wrong with a load that all brackets
/// would raise or lower (codes of plant::load_fault): one alone may be moved, to put that right.
/// What only differs from what is known may be, by brackets: a load that was half set down is
/// raised again so. By feet it may not, nor what hangs above (brackets_too_high {height_m,
/// most_m}). Of a load to be taken over or set down: those of may_transfer (loads.hpp).
Status may_move_lifts(const FleetState& fleet, const LiveVehicle& live, const StepAction& wanted);
/// The vehicle has answered what was asked for: a load that it has taken over or set down is where
/// that has put it.
void note_lift_ended(FleetState& fleet, LiveVehicle& live, const vda5050::ActionState& answer,
                     Time now);
/// What the vehicle says of a movement that it broke off when the line was cut, and that a server
/// that starts anew knows nothing of.
void recall_lift(LiveVehicle& live, Time now);
/// The line is cut: what has not ended is not asked for again, since nobody looks at it any more.
void give_up_lift(FleetState& fleet, LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
