#include "core/fleet/reports/vehicle_report.hpp"

#include <algorithm>
#include <utility>

#include "core/fleet/floor/carrying.hpp"
#include "core/fleet/floor/floor.hpp"
#include "core/fleet/floor/holding.hpp"
#include "core/fleet/legs/step_actions.hpp"
#include "core/fleet/reports/action_states.hpp"
#include "core/fleet/reports/leg_progress.hpp"
#include "core/fleet/reports/pose.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/attention.hpp"
#include "core/fleet/vehicle/lifts.hpp"
#include "core/fleet/vehicle/link.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

constexpr Duration kForeignAfter = std::chrono::seconds(5);  // an own leg just ended is told sooner

/// A state that was overtaken on its way tells of a floor the vehicle has left since. Header ids
/// are 32 bit and begin anew.
bool is_overtaken(const LiveVehicle& live, const vda5050::StateMessage& state) {
    constexpr std::int64_t kHalf = std::int64_t{1} << 31;
    if (state.header_id == 0 || live.newest_header == 0) return false;
    const std::int64_t ahead = state.header_id - live.newest_header;
    return (ahead <= 0 && ahead > -kHalf) || ahead > kHalf;
}

/// Of another master, or given by this server before its database was put back to an older copy:
/// no leg of its own can begin before that is gone, and only a person knows whether it may go.
void watch_foreign_order(FleetState& fleet, LiveVehicle& live, Time now) {
    if (!has_foreign_order(live)) {
        live.foreign_since.reset();
        return;
    }
    if (!live.foreign_since) live.foreign_since = now;
    if (now - *live.foreign_since < kForeignAfter || is_asked(live, vda5050::kCancelOrder)) return;
    if (live.record.integration != Integration::kUtilise) return;
    require_person(fleet, live,
                   {reasons::kForeignOrder,
                    {{"vehicle", live.record.id.str()}, {"order", live.state.order_id}}},
                   now);
}

/// An error is its type and what it refers to; its text may count up or tell the time.
void note_errors(FleetState& fleet, LiveVehicle& live,
                 const std::vector<vda5050::VehicleError>& before, Time now) {
    for (const auto& error : live.state.errors) {
        const bool known = std::any_of(before.begin(), before.end(), [&](const auto& old) {
            return old.type == error.type && old.references == error.references;
        });
        if (known || !may_tell_error(fleet, live, now)) continue;
        add_event(fleet, now, event::kVehicleError, {}, live.record.leg, live.record.id, {},
                  {{"type", error.type}, {"fatal", error.fatal}, {"text", error.description}});
    }
}

/// With a fatal error it has stopped of itself, and only a person knows whether it may go on. Whom
/// a person has let go on meanwhile has not heard of it yet.
void watch_fatal_error(FleetState& fleet, LiveVehicle& live, Time now) {
    const auto* error = fatal_error(live);
    if (!error || is_asked(live, vda5050::kStopPause)) return;
    if (live.record.integration != Integration::kUtilise) return;
    if (!live.record.pose_known) return;  // a person says where it stands, and may let it go then
    require_person(
        fleet, live,
        {reasons::kVehicleError, {{"vehicle", live.record.id.str()}, {"type", error->type}}}, now);
}

/// Somebody has taken the vehicle into their hands, or given it back: from the first on nothing
/// moves it but they, and after the second nothing does until a person says so here.
void watch_mode(FleetState& fleet, LiveVehicle& live, const vda5050::StateMessage& before,
                Time now) {
    const std::string& mode = live.state.operating_mode;
    const auto& person = live.state.in_hand_of;
    if (mode != before.operating_mode || person != before.in_hand_of) {
        Params params{{"from", before.operating_mode}, {"to", mode}};
        if (person) params.push_back({"person", *person});
        add_event(fleet, now, event::kVehicleOperatingMode, {}, live.record.leg, live.record.id, {},
                  std::move(params));
    }
    if (is_automatic(live) || live.record.integration != Integration::kUtilise) return;
    Params because{{"operating_mode", mode}};
    if (person) because.push_back({"person", *person});
    require_person(fleet, live, {reasons::kDrivenByHand, std::move(because)}, now);
}

}  // namespace

void handle_state(FleetState& fleet, LiveVehicle& live, const vda5050::StateMessage& state,
                  Time now) {
    note_heard(fleet, live, now);
    if (is_overtaken(live, state)) return;
    live.newest_header = state.header_id;
    const vda5050::StateMessage before = std::exchange(live.state, state);
    const std::optional<Time> stated_before = std::exchange(live.state_at, now);
    live.reconciled = true;
    fleet.changed_vehicles.insert(live.record.id);
    note_errors(fleet, live, before.errors, now);
    handle_pose(fleet, live, before, now);
    watch_mode(fleet, live, before, now);
    count_done_before_cancel(fleet, live, now);
    handle_action_states(fleet, live, now);
    recall_lift(live, now);
    settle_load(fleet, live, now);
    // What it has passed is where it says to be; on that nothing is freed or measured.
    if (live.has_leg() && !is_in_doubt(live)) handle_leg_progress(fleet, live, now);
    watch_foreign_order(fleet, live, now);
    watch_fatal_error(fleet, live, now);
    if (!state.driving) hold_where_it_stands(fleet, live, now);
    halt_or_resume(fleet, live, now);
    offer_seen_pose(fleet, live, stated_before, now);
}

}  // namespace pulseline::fleet
