#include "core/fleet/dispatch/extend_bases.hpp"

#include "core/fleet/legs/legs.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/readiness.hpp"

namespace pulseline::fleet {
namespace {

/// A leg that has nothing on the floor yet has not been sent either.
bool is_first_grant(const VehicleRun& run) {
    return run.leg().released_nodes == 1 && run.leg().nodes.size() > 1 &&
           run.delivery.phase() == LegDelivery::Phase::kPlanned;
}

}  // namespace

bool may_extend_base(const FleetState& fleet, const VehicleRun& run, Time now) {
    if (!run.has_leg() || run.delivery.unconfirmed()) return false;
    if (!run.delivery.seen() && !is_first_grant(run)) return false;
    return !bars_extension(fleet, run, now);
}

void extend_bases(FleetState& fleet, Time now) {
    for (auto& [id, run] : fleet.vehicles) {
        if (may_extend_base(fleet, run, now)) extend_base(fleet, run, now);
    }
}

}  // namespace pulseline::fleet
