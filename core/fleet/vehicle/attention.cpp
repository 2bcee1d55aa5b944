#include "core/fleet/vehicle/attention.hpp"

#include <utility>

#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {
namespace {

constexpr int kErrorsPerMinute = 10;  // of one vehicle that become events

}  // namespace

bool may_tell_error(FleetState& fleet, VehicleRun& run, Time now) {
    if (now - run.errors_from >= std::chrono::minutes(1)) {
        run.errors_from = now;
        run.errors_told = 0;
    }
    if (run.errors_told > kErrorsPerMinute) return false;
    if (++run.errors_told <= kErrorsPerMinute) return true;
    add_event(fleet, now, event::kVehicleErrorsWithheld, {}, run.record.leg, run.record.id, {},
              {{"errors_per_minute", std::int64_t{kErrorsPerMinute}}});
    return false;
}

void require_person(FleetState& fleet, VehicleRun& run, Reason reason, Time now) {
    if (!run.record.needs_resume) {
        run.record.needs_resume = true;
        run.record.needs_resume_reason = reason;
        Params params{{"reason", reason.code}};
        for (const auto& param : reason.params) params.push_back(param);
        add_event(fleet, now, event::kVehicleNeedsResume, {}, run.record.leg, run.record.id, {},
                  std::move(params));
        fleet.store(run);
    }
    JobOrder* order = fleet.orders.of(run.record.id);
    if (order && order->state == JobState::kRunning) {
        set_order_state(fleet, *order, JobState::kInterrupted, std::move(reason), {}, now);
    }
}

}  // namespace pulseline::fleet
