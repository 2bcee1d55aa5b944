#include <utility>

#include "core/fleet/state.hpp"

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

Result<JobOrder*> find_for_change(FleetState& fleet, JobOrderId id,
                                  std::optional<std::int64_t> if_revision) {
    JobOrder* order = fleet.find(id);
    if (!order) return no_such_order(id);
    if (if_revision && *if_revision != order->revision) {
        return fail(Errc::kConflict, "stale_revision",
                    "The order has changed meanwhile. Read it again, then decide.", {},
                    {{"revision", order->revision}});
    }
    return order;
}

}  // namespace

Result<Created> Fleet::create(const NewOrder& order, Time now) {
    auto created = create_order(*state_, order, now);
    if (!created || created->repeated) return created;
    dispatch(*state_, now);
    created->order = *state_->find(created->order.id);
    return created;
}

Result<JobOrder> Fleet::pause_order(JobOrderId id, std::optional<std::int64_t> if_revision,
                                    const std::string& actor, Time now) {
    auto found = find_for_change(*state_, id, if_revision);
    if (!found) return fail(found.error());
    JobOrder& order = **found;
    if (order.state == JobState::kAllowedToStart) {  // ISA-95: RevokeStart
        set_order_state(*state_, order, JobState::kNotAllowedToStart,
                        {"paused_by_person", {{"actor", actor}}}, actor, now);
    } else if (order.state == JobState::kRunning) {
        order.pause_requested = true;
        set_order_state(*state_, order, JobState::kInterrupted,
                        {"paused_by_person", {{"actor", actor}}}, actor, now);
        VehicleRun* run = state_->find(order.assigned_vehicle);
        if (run && run->has_leg()) pause_motion(*state_, *run, "startPause", now);
    } else {
        return wrong_state(order, "paused");
    }
    return order;
}

Result<JobOrder> Fleet::resume_order(JobOrderId id, std::optional<std::int64_t> if_revision,
                                     const std::string& actor, Time now) {
    auto found = find_for_change(*state_, id, if_revision);
    if (!found) return fail(found.error());
    JobOrder& order = **found;
    if (order.state == JobState::kNotAllowedToStart) {
        set_order_state(*state_, order, JobState::kAllowedToStart, {}, actor, now);
    } else if (order.state == JobState::kInterrupted && !order.cancel_requested) {
        VehicleRun* run = state_->find(order.assigned_vehicle);
        if (run && (run->record.needs_resume || run->record.paused)) {
            return fail(Errc::kConflict, "needs_person",
                        "Vehicle " + run->record.id.str() +
                            " waits for a person to let it move again: POST /api/v1/fleet/resume.",
                        {}, {{"vehicle", run->record.id.str()}});
        }
        const bool was_paused = std::exchange(order.pause_requested, false);
        set_order_state(*state_, order, JobState::kRunning, {}, actor, now);
        if (was_paused && run && run->has_leg()) pause_motion(*state_, *run, "stopPause", now);
    } else {
        return wrong_state(order, "resumed");
    }
    dispatch(*state_, now);
    return *state_->find(id);
}

Result<JobOrder> Fleet::cancel_order(JobOrderId id, std::optional<std::int64_t> if_revision,
                                     const std::string& actor, Time now) {
    auto found = find_for_change(*state_, id, if_revision);
    if (!found) return fail(found.error());
    JobOrder& order = **found;
    if (is_final(order.state)) return wrong_state(order, "cancelled");
    if (order.cancel_requested) return order;
    order.cancel_requested = true;
    order.reason = {"cancelled_by_person", {{"actor", actor}}};
    state_->store(order);
    add_event(*state_, now, "job_order.cancel_requested", id, {}, order.assigned_vehicle, actor);
    VehicleRun* run = state_->find(order.assigned_vehicle);
    if (run && run->has_leg() && run->leg().order == id) {
        cancel_leg(*state_, *run, now);
        // A pause that waits at the vehicle would outlive the order that asked for it.
        if (order.pause_requested) pause_motion(*state_, *run, "stopPause", now);
    } else {
        abort_order(*state_, order, order.reason, actor, now);
    }
    return order;
}

}  // namespace pulseline::fleet
