#pragma once

#include <cstddef>

#include "core/base/time.hpp"
#include "core/vda5050/messages.hpp"

/// Which of a vehicle's reports the fleet has to see. The others tell nothing it decides by and
/// would only fill the journal; poses and speeds are shown from a table of newest values.
namespace pulseline::fleet {

/// A driving vehicle's base is extended by where it is and not on an old pose
/// (dispatch/extend_bases.cpp), so the fleet sees it this often whatever it says.
constexpr Duration kDrivingEvery = std::chrono::milliseconds(500);
/// What nobody decides by (speeds, temperatures, the age of a report) is never older than this.
constexpr Duration kStandingEvery = std::chrono::seconds(2);

/// How often the fleet sees the reports of a vehicle that says this.
Duration seen_every(const vda5050::StateMessage& state);

/// From `now`, of any clock, to the next beat of one of many that all do something `every` so
/// often: at most `every`. Each has its own moment, by `number`: a thousand vehicles that connected
/// together would otherwise be seen together from then on, and everybody wait for it.
Duration to_next_beat(Duration now, Duration every, std::size_t number);

/// Whether `next` may lead to another decision than `known`, which the fleet saw last.
/// Anything counts but what is left out here by name: time stamps, poses of a driving vehicle,
/// speeds and temperatures, and noise of poses, forces, feet, cameras and battery.
bool may_change_decision(const vda5050::StateMessage& known, const vda5050::StateMessage& next);

}  // namespace pulseline::fleet
