#include <algorithm>

#include "core/fleet/fleet.hpp"
#include "core/fleet/floor/closures.hpp"
#include "core/fleet/floor/floor.hpp"
#include "core/fleet/floor/grants.hpp"
#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {
namespace {

TrafficView::Wait shown(const FleetState& fleet, const plant::VehicleId& vehicle,
                        const traffic::Block& block) {
    TrafficView::Wait wait;
    wait.vehicle = vehicle;
    if (block.cause == traffic::BlockCause::kVehicle) {
        wait.waits_for = plant::VehicleId(fleet.floor.traffic.name(block.vehicle));
    }
    wait.reason = floor_reason(fleet, block);
    return wait;
}

}  // namespace

std::vector<planning::ClosedFloor> Fleet::closed_floors() const {
    return fleet::closed_floors(*state_);
}

TrafficView Fleet::traffic(Time now) const {
    const Floor& floor = state_->floor;
    TrafficView view;
    view.stopped = floor.stopped;
    for (const auto& wait : floor.traffic.waits()) {
        const plant::VehicleId vehicle(floor.traffic.name(wait.vehicle));
        // Who has nothing to do may have a way to rest planned, and waits for nobody.
        const LiveVehicle* live = state_->find(vehicle);
        if (!live || !live->has_leg()) continue;
        view.waits.push_back(shown(*state_, vehicle, wait.block));
        if (wait.until_s < traffic::kBlocked_s / 2 + seconds(state_->started.time_since_epoch())) {
            view.waits.back().until = std::max(now, Time{} + from_seconds(wait.until_s));
        }
    }
    // Who has an order but found no plan for it waits, too.
    for (const auto& [id, live] : state_->vehicles) {
        const auto block = floor.traffic.blocked_by(live.floor.vehicle);
        if (tries_in_vain(*state_, live) && block) {
            view.waits.push_back(shown(*state_, id, *block));
        }
    }
    for (const auto& closed : state_->closures) view.closures.push_back(closed.closure);
    return view;
}

}  // namespace pulseline::fleet
