#include <utility>

#include "core/fleet/dispatch/dispatch.hpp"
#include "core/fleet/fleet.hpp"
#include "core/fleet/journal/recorder.hpp"
#include "core/fleet/legs/ending.hpp"
#include "core/fleet/orders/idempotency.hpp"
#include "core/fleet/orders/orders.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/job_control.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/sending.hpp"
#include "core/vda5050/actions.hpp"

// What people and programs ask of job orders.
namespace pulseline::fleet {
namespace {

tl::unexpected<Error> no_such_order(JobOrderId id) {
    return fail(Errc::kNotFound, "unknown_job_order", "There is no job order " + id.str() + ".", {},
                {{"order", id.str()}});
}

tl::unexpected<Error> wrong_state(const JobOrder& order, const char* method) {
    return fail(Errc::kConflict, "not_in_this_state",
                std::string("A job order in state ") + to_string(order.state) + " cannot be " +
                    method + ".",
                {}, {{"state", to_string(order.state)}, {"method", method}});
}

tl::unexpected<Error> end_under_way(const JobOrder& order) {
    return fail(Errc::kConflict, "end_under_way",
                "The order is being ended; its vehicle still has to confirm that it stands. Wait "
                "for that.",
                {}, {{"state", to_string(order.state)}});
}

Result<JobOrder*> find_for_change(FleetState& fleet, JobOrderId id,
                                  std::optional<std::int64_t> if_revision) {
    JobOrder* order = fleet.find(id);
    if (!order) return no_such_order(id);
    if (if_revision && *if_revision != order->revision) {
        return fail(Errc::kStale, "stale_revision",
                    "The order has changed meanwhile. Read it again, then decide.", {},
                    {{"revision", order->revision}});
    }
    return order;
}

tl::unexpected<Error> not_allowed(const JobOrder& order, JobMethod method) {
    if (order.removed) {
        return fail(Errc::kConflict, "job_order_removed",
                    "The order was taken out of the list; it can only be read.", {},
                    {{"state", to_string(order.state)}, {"method", to_string(method)}});
    }
    return fail(Errc::kConflict, "not_in_this_state",
                std::string("A job order in state ") + to_string(order.state) +
                    " does not take the method " + to_string(method) +
                    ". Read it again, then choose a method of that state.",
                {}, {{"state", to_string(order.state)}, {"method", to_string(method)}});
}

Status start(FleetState& fleet, JobOrder& order, const std::string& actor, Time now) {
    set_order_state(fleet, order, JobState::kAllowedToStart, {}, actor, now);
    return {};
}

Status revoke_start(FleetState& fleet, JobOrder& order, const std::string& actor, Time now) {
    set_order_state(fleet, order, JobState::kNotAllowedToStart,
                    {"paused_by_person", {{"actor", actor}}}, actor, now);
    return {};
}

/// The vehicle stops inside its base; the leg stays.
Status pause(FleetState& fleet, JobOrder& order, const std::string& actor, Time now) {
    if (order.cancel_requested) return end_under_way(order);
    order.pause_requested = true;
    set_order_state(fleet, order, JobState::kInterrupted, {"paused_by_person", {{"actor", actor}}},
                    actor, now);
    LiveVehicle* live = fleet.find(order.assigned_vehicle);
    if (live && live->has_leg()) pause_motion(fleet, *live, vda5050::kStartPause, now);
    return {};
}

Status resume(FleetState& fleet, JobOrder& order, const std::string& actor, Time now) {
    if (order.cancel_requested) return end_under_way(order);
    if (order.assigned_vehicle.empty()) {
        return fail(Errc::kConflict, "waits_for_vehicle",
                    "The order's vehicle was taken out. It goes on by itself with the next free "
                    "one.",
                    {}, {{"state", to_string(order.state)}});
    }
    LiveVehicle* live = fleet.find(order.assigned_vehicle);
    if (live && waits_for_person(*live)) {
        return fail(Errc::kConflict, "needs_person",
                    "Vehicle " + live->record.id.str() +
                        " waits for a person to let it move again: POST /api/v1/fleet/resume.",
                    {}, {{"vehicle", live->record.id.str()}});
    }
    const bool was_paused = std::exchange(order.pause_requested, false);
    set_order_state(fleet, order, JobState::kRunning, {}, actor, now);
    // Also without a leg: the drive may have ended while the pause was on its way.
    if (was_paused && live) pause_motion(fleet, *live, vda5050::kStopPause, now);
    return {};
}

/// Ends the order: at once where no vehicle drives for it, else when the vehicle has confirmed and
/// stands, and its floor is free.
Status end(FleetState& fleet, JobOrder& order, bool as_stop, const std::string& actor, Time now) {
    const bool asked_before = std::exchange(order.cancel_requested, true);
    order.stop_requested = as_stop;
    order.reason = {as_stop ? "stopped_by_person" : "cancelled_by_person", {{"actor", actor}}};
    fleet.store(order);
    add_event(fleet, now, as_stop ? event::kJobOrderStopRequested : event::kJobOrderCancelRequested,
              order.id, {}, order.assigned_vehicle, actor);
    LiveVehicle* live = fleet.find(order.assigned_vehicle);
    if (!live || !live->has_leg() || live->leg().order != order.id) {
        abort_order(fleet, order, order.reason, actor, now);
    } else if (!asked_before) {
        cancel_leg(fleet, *live, now);
        // A pause that waits at the vehicle would outlive the order that asked for it.
        if (order.pause_requested) pause_motion(fleet, *live, vda5050::kStopPause, now);
    }
    return {};
}

/// May follow a Stop that is under way: then it ends as Aborted.
Status abort(FleetState& fleet, JobOrder& order, const std::string& actor, Time now) {
    if (order.cancel_requested && !order.stop_requested) return {};
    return end(fleet, order, false, actor, now);
}

Status stop(FleetState& fleet, JobOrder& order, const std::string& actor, Time now) {
    if (order.cancel_requested && !order.stop_requested) return end_under_way(order);
    if (order.stop_requested) return {};
    return end(fleet, order, true, actor, now);
}

/// Out of the receiver's list, into history. One that never started is Aborted there.
Status remove(FleetState& fleet, JobOrder& order, JobMethod method, const std::string& actor,
              Time now) {
    order.removed = true;
    if (!is_final(order.state)) {
        abort_order(fleet, order, {"removed_by_person", {{"actor", actor}}}, actor, now);
    }
    add_event(fleet, now, event::kJobOrderRemoved, order.id, {}, order.assigned_vehicle, actor,
              {{"method", to_string(method)}});
    fleet.store(order);
    return {};
}

Status update(FleetState& fleet, JobOrder& order, const ControlRequest& request, Time now) {
    if (!request.update) {
        return fail(Errc::kInvalid, "missing_field",
                    "Update needs the order's new content; add it as \"order\".", "/order");
    }
    auto done = update_order(fleet, order, *request.update, request.actor, now);
    if (done) return done;
    Error error = done.error();
    error.field = "/order" + error.field;
    return fail(std::move(error));
}

Status apply(FleetState& fleet, JobOrder& order, const ControlRequest& request, Time now) {
    const std::string& actor = request.actor;
    switch (request.method) {
        case JobMethod::kStart:
            return start(fleet, order, actor, now);
        case JobMethod::kRevokeStart:
            return revoke_start(fleet, order, actor, now);
        case JobMethod::kPause:
            return pause(fleet, order, actor, now);
        case JobMethod::kResume:
            return resume(fleet, order, actor, now);
        case JobMethod::kUpdate:
            return update(fleet, order, request, now);
        case JobMethod::kAbort:
            return abort(fleet, order, actor, now);
        case JobMethod::kStop:
            return stop(fleet, order, actor, now);
        case JobMethod::kCancel:
        case JobMethod::kClear:
            return remove(fleet, order, request.method, actor, now);
        case JobMethod::kStore:
        case JobMethod::kStoreAndStart:
            break;  // they make orders; the table has refused them
    }
    return not_allowed(order, request.method);
}

}  // namespace

Result<Created> Fleet::create(const NewOrder& order, Time now) {
    FleetState& fleet = input<&Fleet::create>(now, order);
    auto created = create_order(fleet, order, now);
    if (!created || created->repeated) return created;
    dispatch(fleet, now);
    created->order = *fleet.find(created->order.id);
    return created;
}

Result<JobOrder> Fleet::pause_order(JobOrderId id, std::optional<std::int64_t> if_revision,
                                    const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::pause_order>(now, id, if_revision, actor);
    auto found = find_for_change(fleet, id, if_revision);
    if (!found) return fail(found.error());
    JobOrder& order = **found;
    Status done = wrong_state(order, "paused");
    if (order.state == JobState::kAllowedToStart) done = revoke_start(fleet, order, actor, now);
    if (order.state == JobState::kRunning) done = pause(fleet, order, actor, now);
    if (!done) return fail(done.error());
    return order;
}

Result<JobOrder> Fleet::resume_order(JobOrderId id, std::optional<std::int64_t> if_revision,
                                     const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::resume_order>(now, id, if_revision, actor);
    auto found = find_for_change(fleet, id, if_revision);
    if (!found) return fail(found.error());
    JobOrder& order = **found;
    Status done = wrong_state(order, "resumed");
    if (order.state == JobState::kNotAllowedToStart) done = start(fleet, order, actor, now);
    if (order.state == JobState::kInterrupted) done = resume(fleet, order, actor, now);
    if (!done) return fail(done.error());
    dispatch(fleet, now);
    return *fleet.find(id);
}

Result<JobOrder> Fleet::cancel_order(JobOrderId id, std::optional<std::int64_t> if_revision,
                                     const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::cancel_order>(now, id, if_revision, actor);
    auto found = find_for_change(fleet, id, if_revision);
    if (!found) return fail(found.error());
    JobOrder& order = **found;
    if (is_final(order.state)) return wrong_state(order, "cancelled");
    if (auto done = abort(fleet, order, actor, now); !done) return fail(done.error());
    return order;
}

Result<std::optional<JobOrder>> Fleet::earlier_answer(const std::string& client,
                                                      const std::string& key,
                                                      const std::string& body_sha256) const {
    return fleet::earlier_answer(*state_, client, key, body_sha256);
}

Result<Created> Fleet::control_order(JobOrderId id, const ControlRequest& request, Time now) {
    FleetState& fleet = input<&Fleet::control_order>(now, id, request);
    const auto earlier =
        earlier_answer(request.idempotency_client, request.idempotency_key, request.body_sha256);
    if (!earlier) return fail(earlier.error());
    if (*earlier) return Created{**earlier, true};
    auto found = find_for_change(fleet, id, request.if_revision);
    if (!found) return fail(found.error());
    JobOrder& order = **found;
    if (order.removed || !transition(order.state, request.method)) {
        return not_allowed(order, request.method);
    }
    if (auto done = apply(fleet, order, request, now); !done) return fail(done.error());
    keep_answer(
        fleet, {request.idempotency_client, request.idempotency_key, request.body_sha256, id, now});
    dispatch(fleet, now);
    return Created{*fleet.find(id), false};
}

}  // namespace pulseline::fleet
