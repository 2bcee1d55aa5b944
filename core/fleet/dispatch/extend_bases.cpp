#include "core/fleet/dispatch/extend_bases.hpp"

#include "core/fleet/legs/legs.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/readiness.hpp"

namespace pulseline::fleet {
namespace {

/// A leg that has nothing on the floor yet has not been sent either.
bool is_first_grant(const LiveVehicle& live) {
    return live.leg().released_nodes == 1 && live.leg().nodes.size() > 1 &&
           live.delivery.phase() == LegDelivery::Phase::kPlanned;
}

}  // namespace

bool may_extend_base(const FleetState& fleet, const LiveVehicle& live, Time now) {
    if (!live.has_leg() || live.delivery.unconfirmed()) return false;
    if (!live.delivery.seen() && !is_first_grant(live)) return false;
    return !bars_extension(fleet, live, now);
}

void extend_bases(FleetState& fleet, Time now) {
    for (auto& [id, live] : fleet.vehicles) {
        if (may_extend_base(fleet, live, now)) extend_base(fleet, live, now);
    }
}

}  // namespace pulseline::fleet
