#pragma once

#include <string>

#include "core/fleet/state/fleet_state.hpp"

/// Job orders as clients make and change them.
namespace pulseline::fleet {

Result<Created> create_order(FleetState& fleet, const NewOrder& order, Time now);
/// Gives an order that has not started all that `request` may set.
Status update_order(FleetState& fleet, JobOrder& order, const NewOrder& request,
                    const std::string& actor, Time now);

}  // namespace pulseline::fleet
