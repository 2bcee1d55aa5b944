#include "core/fleet/vehicle/beacons.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/fleet/vehicle/sending.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

/// Instead of one of its kind that waits.
void tell(FleetState& fleet, LiveVehicle& live, vda5050::Action action, Time now) {
    const auto& known = live.factsheet->actions;
    if (std::ranges::find(known, action.type) == known.end()) return;
    std::erase_if(live.actions,
                  [&](const PendingAction& pending) { return pending.action.type == action.type; });
    action.blocking = vda5050::BlockingType::kNone;
    send_action(fleet, live, std::move(action), now);
}

}  // namespace

void tell_beacons(FleetState& fleet, LiveVehicle& live, Time now) {
    const std::string hall = hall_of(fleet, live);
    const auto in_hall = [&](const auto& beacon) { return beacon.hall.str() == hall; };
    vda5050::Action transmitters;
    transmitters.type = vda5050::kSetTransmitters;
    std::ranges::copy_if(fleet.plant.transmitters, std::back_inserter(transmitters.transmitters),
                         in_hall);
    tell(fleet, live, std::move(transmitters), now);
    vda5050::Action reflectors;
    reflectors.type = vda5050::kSetReflectors;
    std::ranges::copy_if(fleet.plant.reflectors, std::back_inserter(reflectors.reflectors),
                         in_hall);
    tell(fleet, live, std::move(reflectors), now);
}

}  // namespace pulseline::fleet
