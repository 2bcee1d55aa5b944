#include "core/fleet/dispatch/dispatch.hpp"
#include "core/fleet/fleet.hpp"
#include "core/fleet/floor/closures.hpp"
#include "core/fleet/journal/recorder.hpp"
#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {

Result<Closure> Fleet::close_floor(const NewClosure& wanted, const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::close_floor>(now, wanted, actor);
    auto closed = fleet::close_floor(fleet, wanted, actor, now);
    if (closed) dispatch(fleet, now);
    return closed;
}

Status Fleet::reopen_floor(ClosureId id, const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::reopen_floor>(now, id, actor);
    auto opened = fleet::reopen_floor(fleet, id, actor, now);
    if (opened) dispatch(fleet, now);
    return opened;
}

}  // namespace pulseline::fleet
