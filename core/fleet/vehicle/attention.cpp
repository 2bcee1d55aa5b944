#include "core/fleet/vehicle/attention.hpp"

#include <utility>

#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {
namespace {

constexpr int kErrorsPerMinute = 10;  // of one vehicle that become events

}  // namespace

bool may_tell_error(FleetState& fleet, LiveVehicle& live, Time now) {
    if (now - live.errors_from >= std::chrono::minutes(1)) {
        live.errors_from = now;
        live.errors_told = 0;
    }
    if (live.errors_told > kErrorsPerMinute) return false;
    if (++live.errors_told <= kErrorsPerMinute) return true;
    add_event(fleet, now, event::kVehicleErrorsWithheld, {}, live.record.leg, live.record.id, {},
              {{"errors_per_minute", std::int64_t{kErrorsPerMinute}}});
    return false;
}

void require_person(FleetState& fleet, LiveVehicle& live, Reason reason, Time now) {
    if (!live.record.needs_resume) {
        live.record.needs_resume = true;
        live.record.needs_resume_reason = reason;
        Params params{{"reason", reason.code}};
        for (const auto& param : reason.params) params.push_back(param);
        add_event(fleet, now, event::kVehicleNeedsResume, {}, live.record.leg, live.record.id, {},
                  std::move(params));
        fleet.store(live);
    }
    JobOrder* order = fleet.orders.of(live.record.id);
    if (order && order->state == JobState::kRunning) {
        set_order_state(fleet, *order, JobState::kInterrupted, std::move(reason), {}, now);
    }
}

}  // namespace pulseline::fleet
