#include "core/fleet/vehicle/transmitters.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/fleet/vehicle/sending.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {

void tell_transmitters(FleetState& fleet, LiveVehicle& live, Time now) {
    const auto& known = live.factsheet->actions;
    if (std::ranges::find(known, vda5050::kSetTransmitters) == known.end()) return;
    std::erase_if(live.actions, [](const PendingAction& pending) {
        return pending.action.type == vda5050::kSetTransmitters;
    });
    vda5050::Action action;
    action.type = vda5050::kSetTransmitters;
    action.blocking = vda5050::BlockingType::kNone;
    const std::string hall = hall_of(fleet, live);
    std::ranges::copy_if(fleet.plant.transmitters, std::back_inserter(action.transmitters),
                         [&](const auto& transmitter) { return transmitter.hall.str() == hall; });
    send_action(fleet, live, std::move(action), now);
}

}  // namespace pulseline::fleet
