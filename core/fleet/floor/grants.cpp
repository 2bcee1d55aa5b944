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

bool stands_at_stop(const FleetState& fleet, const VehicleRun& run) {
    if (run.leg().nodes.size() == 1) return true;  // corrects or measures where it stands
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    return run.leg().passed_nodes == run.leg().nodes.size() && plan.passed < plan.last() &&
           plan.at(plan.passed + 1).visit != kNoVisit;
}

bool is_dead_end(const FleetState& fleet, const VehicleRun& run) {
    const Leg& leg = run.leg();
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    if (leg.nodes.size() < 2 || leg.passed_nodes < leg.released_nodes) return false;
    if (plan.place != kNoPlace || plan.last() > plan.passed) return false;
    if (!leg.nodes.back().actions.empty() && leg.nodes.size() == leg.released_nodes) return false;
    const auto end =
        floor_class_of(fleet, run).motion.place_at(plant::HallId(leg.hall), leg.nodes.back().pose);
    return leg.nodes.size() == leg.released_nodes || !end;
}

bool is_stuck(const FleetState& fleet, const VehicleRun& run) {
    if (run.state.driving || run.leg().passed_nodes < run.leg().released_nodes) return false;
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    const auto block = fleet.floor.traffic.blocked_by(run.floor.vehicle);
    if (!block || block->cause != traffic::BlockCause::kVehicle) return false;
    return block->move == traffic::kForever || plan.last() > plan.passed;
}

bool goes_by_places(const FleetState& fleet, const VehicleRun& run) {
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    for (MoveNumber n = plan.passed + 1; n <= plan.last(); ++n) {
        if (plan.at(n).place == kNoPlace) return false;
    }
    return true;
}

std::size_t grant_nodes(FleetState& fleet, VehicleRun& run, std::size_t wanted_node, Time now) {
    auto& traffic = fleet.floor.traffic;
    const Leg& leg = run.leg();
    if (!run.floor.leg_planned || fleet.floor.stopped) return leg.released_nodes;
    const MoveNumber passed = traffic.plan(run.floor.vehicle).passed;
    const MoveNumber wanted = move_of_node(run, wanted_node);
    if (wanted <= passed) return leg.released_nodes;
    const MoveNumber granted = traffic.extend(run.floor.vehicle, wanted - passed, now);
    if (!floor_is_sound(fleet, now)) return leg.released_nodes;
    const auto nodes = static_cast<std::int64_t>(granted) - run.floor.moves_before_leg + 1;
    const auto reached = std::clamp(static_cast<std::size_t>(std::max<std::int64_t>(nodes, 1)),
                                    leg.released_nodes, leg.nodes.size());
    return keeps_to_its_floor(fleet, run, reached, now) ? reached : leg.released_nodes;
}

void pass_nodes(FleetState& fleet, VehicleRun& run, Time now) {
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    const std::size_t reported = run.leg().passed_nodes - 1;
    const MoveNumber move = move_of_node(run, reported);
    if (move <= plan.passed || plan.last() < move) return;
    if (!fleet.floor.traffic.passed(run.floor.vehicle, move, now)) {
        require_person(
            fleet, run,
            {"left_its_base",
             {{"vehicle", run.record.id.str()}, {"node", static_cast<std::int64_t>(reported)}}},
            now);
    }
}

void pass_stop(FleetState& fleet, VehicleRun& run, Time now) {
    auto& traffic = fleet.floor.traffic;
    const auto& plan = traffic.plan(run.floor.vehicle);
    const MoveNumber stop = plan.passed + 1;
    if (is_at_work(fleet, run)) return;  // measured once more
    if (stop > plan.last() || plan.at(stop).visit == kNoVisit) {
        // By plan it gives way first; it has made the stop all the same.
        if (traffic.postponed(run.floor.vehicle)) {
            static_cast<void>(traffic.cancel(run.floor.vehicle, now));
        }
        return;
    }
    if (traffic.extend(run.floor.vehicle, 1, now) < stop) {
        // Halted, for it was silent: the stop is made all the same, and is not to be made again.
        static_cast<void>(traffic.cancel(run.floor.vehicle, now));
        return;
    }
    static_cast<void>(traffic.passed(run.floor.vehicle, stop, now));
}

bool is_at_work(const FleetState& fleet, const VehicleRun& run) {
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    return plan.passed < plan.last() && plan.at(plan.passed + 1).visit == kWork;
}

void end_work(FleetState& fleet, VehicleRun& run, Time now) {
    auto& traffic = fleet.floor.traffic;
    const MoveNumber work = traffic.plan(run.floor.vehicle).passed + 1;
    if (!is_at_work(fleet, run) || traffic.extend(run.floor.vehicle, 1, now) < work) return;
    static_cast<void>(traffic.passed(run.floor.vehicle, work, now));
}

void give_up_task(FleetState& fleet, VehicleRun& run, Time now) {
    if (run.has_leg()) return;
    run.floor.leg_planned = false;
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    if (plan.last() == plan.passed) return;
    static_cast<void>(fleet.floor.traffic.cancel(run.floor.vehicle, now));
}

void halt_those_that_cannot_move(FleetState& fleet, Time now) {
    for (auto& [id, run] : fleet.vehicles) halt_or_resume(fleet, run, now);
}

bool tries_in_vain(const FleetState& fleet, const VehicleRun& run) {
    const JobOrder* order = fleet.orders.of(run.record.id);
    return run.floor.next_try && !run.has_leg() && order && order->state == JobState::kRunning;
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
