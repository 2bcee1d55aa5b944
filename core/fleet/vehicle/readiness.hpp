#pragma once

#include <optional>

#include "core/fleet/state/fleet_state.hpp"

/// Whether a vehicle may begin something, or go on.
namespace pulseline::fleet {

Duration silence(const FleetState& fleet, const LiveVehicle& live, Time now);
/// Until a person lets it go on, no order and no update of one goes to it, new or again.
bool waits_for_person(const LiveVehicle& live);
/// The vehicle has not shown its leg and may have the message or still get it: the leg must not be
/// forgotten.
bool is_on_its_way(const LiveVehicle& live);
/// By its own word it knows too little where it is to drive a way that is held.
bool is_vague(const vda5050::StateMessage& state);
/// False while a person drives it at the vehicle itself (VDA 5050 operatingMode).
bool is_automatic(const LiveVehicle& live);
/// It has stopped of itself and needs a person (VDA 5050 errorLevel FATAL); nullptr: it has not.
const vda5050::VehicleError* fatal_error(const LiveVehicle& live);
/// It has given up its order, or done all of it.
bool has_nothing_left(const vda5050::StateMessage& state);
/// It carries out an order that this server has not given, or has forgotten.
bool has_foreign_order(const LiveVehicle& live);
/// An instant action of the type has been sent, or waits to be, and the vehicle has not ended it.
bool is_asked(const LiveVehicle& live, const char* action_type);

/// Brackets or feet move outside an order, or are about to: as a person of this server wanted, or
/// by the vehicle's own word.
bool lifts_move(const LiveVehicle& live);

/// What may bar a vehicle; readiness.cpp has the table of which bars what, in the order in which
/// people are told.
enum class Bar {
    kNotIntegrated,
    kLost,    // for so long that others are planned around it
    kSilent,  // late, or without a line
    kNotReported,
    kNeedsPerson,
    kPaused,
    kOrderPaused,
    kPoseUnknown,
    kPoseVague,  // a person has pointed to where it stands, and it has not found itself yet
    kPoseOld,
    kNotAutomatic,
    kSafetyStop,
    kFieldViolation,
    kFatalError,
    kPausesItself,
    kForeignOrder,
    kBusy,
    kLiftsMoving,  // outside an order
    kFeetDown,
    kLoad,
    kBracketsRaised,
    kWheelFault,
    kCodesNotSeen,
};
struct Barred {
    Bar by = Bar::kNotIntegrated;
    Reason reason;
};
/// Why this vehicle may not start a move now; nullopt: it may.
std::optional<Barred> not_ready(const FleetState& fleet, const LiveVehicle& live, Time now);
/// It would not obey a release of floor, whatever its order; others are planned around it.
bool cannot_move(const FleetState& fleet, const LiveVehicle& live);
/// It gets no longer base now, whatever of its leg it has.
bool bars_extension(const FleetState& fleet, const LiveVehicle& live, Time now);

/// Whether it stays on its charger, whoever waits.
bool charges_on(const LiveVehicle& live);
/// Why its battery bars it from new orders; none: it does not.
std::optional<Reason> battery_bar(const LiveVehicle& live);

}  // namespace pulseline::fleet
