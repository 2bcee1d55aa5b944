#include "core/fleet/state.hpp"

namespace pulseline::fleet {

TrafficView Fleet::traffic(Time) const {
    const Floor& floor = state_->floor;
    TrafficView view;
    view.stopped = floor.stopped;
    for (const auto& wait : floor.traffic.waits()) {
        TrafficView::Wait shown;
        shown.vehicle = plant::VehicleId(floor.traffic.name(wait.vehicle));
        if (wait.block.cause == traffic::BlockCause::kVehicle) {
            shown.waits_for = plant::VehicleId(floor.traffic.name(wait.block.vehicle));
        }
        shown.reason = floor_reason(*state_, wait.block);
        if (wait.until_s < traffic::kBlocked_s / 2 + seconds(state_->started.time_since_epoch())) {
            shown.until = Time{} + from_seconds(wait.until_s);
        }
        view.waits.push_back(std::move(shown));
    }
    for (const auto& closed : state_->closures) view.closures.push_back(closed.closure);
    return view;
}

Result<Closure> Fleet::close_floor(const NewClosure& wanted, const std::string& actor, Time now) {
    auto closed = fleet::close_floor(*state_, wanted, actor, now);
    if (closed) dispatch(*state_, now);
    return closed;
}

Status Fleet::reopen_floor(ClosureId id, const std::string& actor, Time now) {
    auto opened = fleet::reopen_floor(*state_, id, actor, now);
    if (opened) dispatch(*state_, now);
    return opened;
}

}  // namespace pulseline::fleet
