#include "core/fleet/commands/schedules.hpp"

#include <algorithm>
#include <utility>

#include "core/fleet/fleet.hpp"
#include "core/fleet/journal/recorder.hpp"
#include "core/fleet/orders/checks.hpp"
#include "core/fleet/orders/orders.hpp"
#include "core/fleet/orders/planning.hpp"
#include "core/fleet/orders/recurrence.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/attention.hpp"

// Orders made by time. The core has no clock: a schedule's time has come when a tick says so.
namespace pulseline::fleet {
namespace {

constexpr std::size_t kMaxSchedules = 1000;
constexpr std::size_t kAtATick = 4;

void note(FleetState& fleet, Time now, const char* type, const Schedule& schedule,
          const std::string& actor, Params more = {}) {
    Params params{{"schedule", schedule.name}, {"schedule_id", schedule.id.str()}};
    params.insert(params.end(), more.begin(), more.end());
    add_event(fleet, now, type, schedule.newest_order, {}, schedule.order.vehicle, actor,
              std::move(params));
}

void store(FleetState& fleet, Schedule& schedule) {
    ++schedule.revision;
    fleet.standing.changed_schedules.insert(schedule.id);
}

Result<Schedule*> find_for_change(FleetState& fleet, ScheduleId id,
                                  std::optional<std::int64_t> if_revision) {
    const auto it = fleet.standing.schedules.find(id);
    if (it == fleet.standing.schedules.end()) {
        return fail(Errc::kNotFound, "unknown_schedule",
                    "There is no such schedule; GET /api/v1/job-order-schedules lists them.", {},
                    {{"schedule", id.str()}});
    }
    if (if_revision && *if_revision != it->second.revision) {
        return fail(Errc::kStale, "stale_revision",
                    "The schedule has changed meanwhile. Read it again, then decide.", {},
                    {{"revision", it->second.revision}});
    }
    return &it->second;
}

/// Its order, checked as if it were to be made now. A silent vehicle is no fault of a schedule.
Status check_for_later(const FleetState& fleet, const NewOrder& order, Time now) {
    const auto checked = check_order(fleet, order, {});
    if (!checked) return fail(checked.error());
    const auto plan = plan_order(fleet, order, checked->stations, {}, now);
    if (plan || plan.error().reason.code == reasons::kVehicleGone ||
        plan.error().reason.code == reasons::kNoVehicle) {
        return {};
    }
    return fail(plan.error());
}

/// What bars one time often bars the next thousand: one event tells of them all, and the order that
/// is made at last says how many they were.
void skip(FleetState& fleet, Schedule& schedule, Reason why, Time now) {
    ++schedule.skipped;
    auto& in_a_row = fleet.standing.skipped_in_a_row[schedule.id];
    const bool again = in_a_row > 0 && schedule.last_skip.code == why.code;
    in_a_row = again ? in_a_row + 1 : 1;
    if (again) {
        schedule.last_skip = std::move(why);
        return;
    }
    Params params{{"reason", why.code}};
    params.insert(params.end(), why.params.begin(), why.params.end());
    schedule.last_skip = std::move(why);
    note(fleet, now, event::kJobOrderScheduleSkipped, schedule, {}, std::move(params));
}

void make_order(FleetState& fleet, Schedule& schedule, Time at, Time now) {
    if (fleet.orders.open().contains(schedule.newest_order)) {
        const auto number = fleet.find(schedule.newest_order)->number;
        skip(fleet, schedule, {"previous_order_open", {{"order", "JO-" + std::to_string(number)}}},
             now);
        return;
    }
    NewOrder order = schedule.order;
    order.actor = "schedule:" + schedule.name;
    order.from_schedule = schedule.id;
    order.due = at + schedule.recurrence.window;
    order.planned_beside = true;  // as it was when the schedule was made
    const auto created = create_order(fleet, order, now);
    if (!created) {
        skip(fleet, schedule, created.error().reason, now);
        return;
    }
    ++schedule.made;
    schedule.newest_order = created->order.id;
    Params params{{"order", "JO-" + std::to_string(created->order.number)}};
    const auto left_out = fleet.standing.skipped_in_a_row.extract(schedule.id);
    if (!left_out.empty()) params.push_back({"skipped_before", left_out.mapped()});
    note(fleet, now, event::kJobOrderScheduleMade, schedule, {}, std::move(params));
}

}  // namespace

void restore_standing(FleetState& fleet, StoredFleet& stored) {
    for (auto& schedule : stored.schedules) {
        fleet.standing.schedules[schedule.id] = std::move(schedule);
    }
    for (auto& one : stored.templates) fleet.standing.templates[one.name] = std::move(one);
}

void require_persons_for_schedules(FleetState& fleet, Time now) {
    for (const auto& [id, schedule] : fleet.standing.schedules) {
        if (schedule.paused || !schedule.next) continue;
        for (auto& [name, live] : fleet.vehicles) {
            const bool wanted = schedule.order.vehicle.empty() || schedule.order.vehicle == name;
            const auto& type = schedule.order.vehicle_type;
            if (wanted && (type.empty() || type == live.type->id)) {
                require_person(fleet, live, {reasons::kServerRestarted, {}}, now);
            }
        }
    }
}

void take_standing(FleetState& fleet, Records& records) {
    StandingOrders& standing = fleet.standing;
    // Deleted ones first: their names may have been taken again.
    for (auto& gone : std::exchange(standing.deleted_schedules, {})) {
        records.schedules.push_back(std::move(gone));
    }
    for (const ScheduleId& id : std::exchange(standing.changed_schedules, {})) {
        const auto it = standing.schedules.find(id);
        if (it != standing.schedules.end()) records.schedules.push_back(it->second);
    }
    records.templates = std::exchange(standing.changed_templates, {});
}

void run_schedules(FleetState& fleet, Time now) {
    // Everybody's time is six o'clock: each order is planned, so some at a tick, oldest first.
    std::vector<std::pair<Time, Schedule*>> due;
    for (auto& [id, schedule] : fleet.standing.schedules) {
        if (schedule.paused || !schedule.next || now < *schedule.next) continue;
        due.emplace_back(*schedule.next, &schedule);
    }
    std::ranges::stable_sort(due, {}, [](const auto& one) { return one.first; });
    if (due.size() > kAtATick) due.resize(kAtATick);
    for (auto& [when, the_one] : due) {
        Schedule& schedule = *the_one;
        // After a long silence only the newest time can still be kept.
        const Time at = last_time(schedule.recurrence, now).value_or(*schedule.next);
        if (at != *schedule.next || now - at > schedule.recurrence.window) {
            skip(fleet, schedule, {"time_missed", {}}, now);
        }
        if (now - at <= schedule.recurrence.window) make_order(fleet, schedule, at, now);
        schedule.next = next_time(schedule.recurrence, now);
        if (!schedule.next) note(fleet, now, event::kJobOrderScheduleOver, schedule, {});
        store(fleet, schedule);
    }
}

Result<Schedule> Fleet::create_schedule(const NewSchedule& wanted, Time now) {
    FleetState& fleet = input<&Fleet::create_schedule>(now, wanted);
    auto& schedules = fleet.standing.schedules;
    NewOrder order = wanted.order;
    order.planned_beside = false;  // is not part of what it says
    for (const auto& [id, known] : schedules) {
        if (known.name != wanted.name) continue;
        Recurrence same = wanted.recurrence;
        if (same.from == Time{}) same.from = known.recurrence.from;  // it meant "from now on"
        if (known.recurrence == same && known.order == order) return known;
        return fail(Errc::kConflict, "duplicate_schedule",
                    "There is another schedule " + wanted.name +
                        ". Use another name, or delete that one first.",
                    "/name", {{"schedule", id.str()}});
    }
    if (schedules.size() >= kMaxSchedules) {
        return fail(Errc::kConflict, "too_many_schedules",
                    "There are 1000 schedules. Delete one that nobody uses, then repeat.", "/name");
    }
    if (auto possible = check_for_later(fleet, wanted.order, now); !possible) {
        Error error = possible.error();
        error.field = "/order" + error.field;
        return fail(std::move(error));
    }
    Schedule made;
    made.name = wanted.name;
    made.recurrence = wanted.recurrence;
    if (made.recurrence.from == Time{}) made.recurrence.from = now;
    made.next = next_time(made.recurrence, now - Duration(1));
    if (!made.next) {
        return fail(Errc::kInvalid, "schedule_over",
                    "This schedule would never make an order. Set until to a later time.",
                    "/until");
    }
    made.id = ScheduleId(fleet.ids.next(now));
    made.order = std::move(order);
    made.created_by = wanted.actor;
    made.created = now;
    const Schedule& kept = schedules[made.id] = made;
    fleet.standing.changed_schedules.insert(kept.id);
    note(fleet, now, event::kJobOrderScheduleCreated, kept, wanted.actor);
    return kept;
}

Result<Schedule> Fleet::pause_schedule(ScheduleId id, bool paused,
                                       std::optional<std::int64_t> if_revision,
                                       const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::pause_schedule>(now, id, paused, if_revision, actor);
    auto found = find_for_change(fleet, id, if_revision);
    if (!found) return fail(found.error());
    Schedule& schedule = **found;
    if (schedule.paused == paused) return schedule;
    schedule.paused = paused;
    // What fell into the pause is left out, not made up for.
    if (!paused) schedule.next = next_time(schedule.recurrence, now);
    note(fleet, now, paused ? event::kJobOrderSchedulePaused : event::kJobOrderScheduleResumed,
         schedule, actor);
    store(fleet, schedule);
    return schedule;
}

Status Fleet::delete_schedule(ScheduleId id, std::optional<std::int64_t> if_revision,
                              const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::delete_schedule>(now, id, if_revision, actor);
    auto found = find_for_change(fleet, id, if_revision);
    if (!found) return fail(found.error());
    Schedule gone = **found;
    gone.deleted = true;
    note(fleet, now, event::kJobOrderScheduleDeleted, gone, actor);
    fleet.standing.schedules.erase(id);
    fleet.standing.skipped_in_a_row.erase(id);
    fleet.standing.changed_schedules.erase(id);
    fleet.standing.deleted_schedules.push_back(std::move(gone));
    return {};
}

std::optional<Schedule> Fleet::schedule(ScheduleId id) const {
    const auto it = state_->standing.schedules.find(id);
    return it == state_->standing.schedules.end() ? std::nullopt : std::optional(it->second);
}

std::vector<Schedule> Fleet::schedules() const {
    std::vector<Schedule> all;
    for (const auto& [id, schedule] : state_->standing.schedules) all.push_back(schedule);
    return all;
}

}  // namespace pulseline::fleet
