#pragma once

#include "core/base/time.hpp"
#include "core/fleet/vehicle_messages.hpp"

/// Which of a vehicle's reports the fleet has to see. The others tell nothing it decides by and
/// would only fill the journal; poses and speeds are shown from a table of newest values.
namespace pulseline::fleet {

/// A driving vehicle's base is extended by where it is and not on an old pose (extend_bases.cpp),
/// so the fleet sees it this often whatever it says.
constexpr Duration kDrivingEvery = std::chrono::milliseconds(500);
/// What nobody decides by (speeds, temperatures, the age of a report) is never older than this.
constexpr Duration kStandingEvery = std::chrono::seconds(2);

/// Whether `next` may lead to another decision than `known`, which the fleet saw `since` ago.
/// Anything counts but what is left out here by name: time stamps, poses of a driving vehicle,
/// speeds and temperatures, and noise of poses, forces, feet, cameras and battery.
bool may_change_decision(const StateMessage& known, const StateMessage& next, Duration since);

}  // namespace pulseline::fleet
