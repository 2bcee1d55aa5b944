#include "core/fleet/floor/grants.hpp"

#include <algorithm>

#include "core/fleet/floor/admission.hpp"
#include "core/fleet/floor/floor.hpp"
#include "core/fleet/floor/watch.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/attention.hpp"

namespace pulseline::fleet {
namespace {

using traffic::kNoPlace;

using traffic::kNoVisit;

using traffic::MoveNumber;

constexpr traffic::VisitIndex kWork = 1;  // the visit behind the stop
constexpr Duration kImproveEvery = std::chrono::seconds(1);
constexpr int kImproveSteps = 4;

}  // namespace

bool stands_at_stop(const FleetState& fleet, const LiveVehicle& live) {
    if (live.leg().nodes.size() == 1) return true;  // corrects or measures where it stands
    const auto& plan = fleet.floor.traffic.plan(live.floor.vehicle);
    return live.leg().passed_nodes == live.leg().nodes.size() && plan.passed < plan.last() &&
           plan.at(plan.passed + 1).visit != kNoVisit;
}

bool is_dead_end(const FleetState& fleet, const LiveVehicle& live) {
    const Leg& leg = live.leg();
    const auto& plan = fleet.floor.traffic.plan(live.floor.vehicle);
    if (leg.nodes.size() < 2 || leg.passed_nodes < leg.released_nodes) return false;
    if (plan.place != kNoPlace || plan.last() > plan.passed) return false;
    if (!leg.nodes.back().actions.empty() && leg.nodes.size() == leg.released_nodes) return false;
    const auto end =
        floor_class_of(fleet, live).motion.place_at(plant::HallId(leg.hall), leg.nodes.back().pose);
    return leg.nodes.size() == leg.released_nodes || !end;
}

bool is_stuck(const FleetState& fleet, const LiveVehicle& live) {
    if (live.state.driving || live.leg().passed_nodes < live.leg().released_nodes) return false;
    const auto& plan = fleet.floor.traffic.plan(live.floor.vehicle);
    const auto block = fleet.floor.traffic.blocked_by(live.floor.vehicle);
    if (!block || block->cause != traffic::BlockCause::kVehicle) return false;
    return block->move == traffic::kForever || plan.last() > plan.passed;
}

bool goes_by_places(const FleetState& fleet, const LiveVehicle& live) {
    const auto& plan = fleet.floor.traffic.plan(live.floor.vehicle);
    for (MoveNumber n = plan.passed + 1; n <= plan.last(); ++n) {
        if (plan.at(n).place == kNoPlace) return false;
    }
    return true;
}

std::size_t grant_nodes(FleetState& fleet, LiveVehicle& live, std::size_t wanted_node, Time now) {
    auto& traffic = fleet.floor.traffic;
    const Leg& leg = live.leg();
    if (!live.floor.leg_planned || fleet.floor.stopped) return leg.released_nodes;
    const MoveNumber passed = traffic.plan(live.floor.vehicle).passed;
    const MoveNumber wanted = move_of_node(live, wanted_node);
    if (wanted <= passed) return leg.released_nodes;
    const MoveNumber granted = traffic.extend(live.floor.vehicle, wanted - passed, now);
    if (!floor_is_sound(fleet, now)) return leg.released_nodes;
    const auto nodes = static_cast<std::int64_t>(granted) - live.floor.moves_before_leg + 1;
    const auto reached = std::clamp(static_cast<std::size_t>(std::max<std::int64_t>(nodes, 1)),
                                    leg.released_nodes, leg.nodes.size());
    return keeps_to_its_floor(fleet, live, reached, now) ? reached : leg.released_nodes;
}

void pass_nodes(FleetState& fleet, LiveVehicle& live, Time now) {
    const auto& plan = fleet.floor.traffic.plan(live.floor.vehicle);
    const std::size_t reported = live.leg().passed_nodes - 1;
    const MoveNumber move = move_of_node(live, reported);
    if (move <= plan.passed || plan.last() < move) return;
    if (!fleet.floor.traffic.passed(live.floor.vehicle, move, now)) {
        require_person(
            fleet, live,
            {"left_its_base",
             {{"vehicle", live.record.id.str()}, {"node", static_cast<std::int64_t>(reported)}}},
            now);
    }
}

void pass_stop(FleetState& fleet, LiveVehicle& live, Time now) {
    auto& traffic = fleet.floor.traffic;
    const auto& plan = traffic.plan(live.floor.vehicle);
    const MoveNumber stop = plan.passed + 1;
    if (is_at_work(fleet, live)) return;  // measured once more
    if (stop > plan.last() || plan.at(stop).visit == kNoVisit) {
        // By plan it gives way first; it has made the stop all the same.
        if (traffic.postponed(live.floor.vehicle)) {
            static_cast<void>(traffic.cancel(live.floor.vehicle, now));
        }
        return;
    }
    if (traffic.extend(live.floor.vehicle, 1, now) < stop) {
        // Halted, for it was silent: the stop is made all the same, and is not to be made again.
        static_cast<void>(traffic.cancel(live.floor.vehicle, now));
        return;
    }
    static_cast<void>(traffic.passed(live.floor.vehicle, stop, now));
}

bool is_at_work(const FleetState& fleet, const LiveVehicle& live) {
    const auto& plan = fleet.floor.traffic.plan(live.floor.vehicle);
    return plan.passed < plan.last() && plan.at(plan.passed + 1).visit == kWork;
}

void end_work(FleetState& fleet, LiveVehicle& live, Time now) {
    auto& traffic = fleet.floor.traffic;
    const MoveNumber work = traffic.plan(live.floor.vehicle).passed + 1;
    if (!is_at_work(fleet, live) || traffic.extend(live.floor.vehicle, 1, now) < work) return;
    static_cast<void>(traffic.passed(live.floor.vehicle, work, now));
}

void give_up_task(FleetState& fleet, LiveVehicle& live, Time now) {
    if (live.has_leg()) return;
    live.floor.leg_planned = false;
    const auto& plan = fleet.floor.traffic.plan(live.floor.vehicle);
    if (plan.last() == plan.passed) return;
    static_cast<void>(fleet.floor.traffic.cancel(live.floor.vehicle, now));
}

void halt_those_that_cannot_move(FleetState& fleet, Time now) {
    for (auto& [id, live] : fleet.vehicles) halt_or_resume(fleet, live, now);
}

bool tries_in_vain(const FleetState& fleet, const LiveVehicle& live) {
    const JobOrder* order = fleet.orders.of(live.record.id);
    return live.floor.next_try && !live.has_leg() && order && order->state == JobState::kRunning;
}

void improve_floor(FleetState& fleet, Time now) {
    Floor& floor = fleet.floor;
    if (floor.stopped) return;
    if (!floor.improved || now - *floor.improved >= kImproveEvery) {
        floor.improved = now;
        floor.traffic.improve(now, kImproveSteps);
    }
    follow_replans(fleet, now);
}

}  // namespace pulseline::fleet
