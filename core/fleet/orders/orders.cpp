#include "core/fleet/orders/orders.hpp"

#include "core/fleet/orders/checks.hpp"
#include "core/fleet/orders/idempotency.hpp"
#include "core/fleet/orders/planning.hpp"
#include "core/fleet/orders/start_conditions.hpp"
#include "core/fleet/orders/station_defaults.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {
namespace {

// Each waits in memory, in every dashboard's snapshot and in every look for work.
constexpr std::size_t kMostOpenOrders = 5000;

/// Puts into the order what a request may set at its creation and by Update.
void fill(JobOrder& order, const NewOrder& request, const CheckedOrder& checked,
          const OrderPlan& plan) {
    order.wanted_vehicle = request.vehicle;
    order.wanted_type = request.vehicle_type;
    order.priority = request.priority;
    order.earliest_start = request.earliest_start;
    order.due = request.due;
    order.after = checked.after;
    order.steps.clear();
    for (std::size_t i = 0; i < request.steps.size(); ++i) {
        Step made;
        made.station = checked.stations[i]->id;
        made.mode = request.steps[i].mode;
        made.before = request.steps[i].before;
        made.after = request.steps[i].after;
        made.planned_s = plan.durations_s[i];
        order.steps.push_back(std::move(made));
    }
}

}  // namespace

Result<Created> create_order(FleetState& fleet, const NewOrder& asked, Time now) {
    const auto earlier =
        earlier_answer(fleet, asked.idempotency_client, asked.idempotency_key, asked.body_sha256);
    if (!earlier) return fail(earlier.error());
    if (*earlier) return Created{**earlier, true};
    const NewOrder request = with_station_defaults(fleet, asked);
    if (!request.client_order_id.empty()) {
        if (const auto known = fleet.orders.with_client_id(request.client_order_id)) {
            return fail(Errc::kConflict, "duplicate_client_order_id",
                        "Order " + request.client_order_id +
                            " exists already. Use another client_order_id.",
                        "/client_order_id", {{"order", known->str()}});
        }
    }
    if (fleet.orders.open().size() >= kMostOpenOrders) {
        return fail(Errc::kConflict, "too_many_open_orders",
                    "There are " + std::to_string(kMostOpenOrders) +
                        " open orders. Wait until some have ended, or cancel those that nobody "
                        "needs; then repeat.",
                    {}, {{"open", static_cast<std::int64_t>(kMostOpenOrders)}});
    }
    const auto checked = check_order(fleet, request, {});
    if (!checked) return fail(checked.error());
    const auto plan = plan_order(fleet, request, checked->stations, {}, now);
    if (!plan) return fail(plan.error());
    // The vehicle begins by what was planned for it, if nothing has changed until then.
    if (plan->legs.front()) fleet.find(plan->vehicle)->newest_plan = plan->legs.front();

    JobOrder order;
    order.id = JobOrderId(fleet.ids.next(now));
    order.number = ++fleet.order_number;
    order.client_order_id = request.client_order_id;
    order.sequence = request.sequence;
    order.from_template = request.from_template;
    order.from_schedule = request.from_schedule;
    order.created_by = request.actor;
    order.created = now;
    fill(order, request, *checked, *plan);
    if (!request.start) {
        order.state = JobState::kNotAllowedToStart;
        order.reason = {"waits_for_start", {}};
    }
    const JobOrder& stored = fleet.orders.add(std::move(order));
    fleet.stored_orders.insert(stored.id);
    Params params{{"number", stored.number},
                  {"steps", static_cast<std::int64_t>(stored.steps.size())}};
    if (!request.start) params.push_back({"state", to_string(stored.state)});
    add_event(fleet, now, event::kJobOrderCreated, stored.id, {}, stored.wanted_vehicle,
              request.actor, std::move(params));
    keep_answer(fleet, {request.idempotency_client, request.idempotency_key, request.body_sha256,
                        stored.id, now});
    return Created{stored, false};
}

Status update_order(FleetState& fleet, JobOrder& order, const NewOrder& asked,
                    const std::string& actor, Time now) {
    const NewOrder request = with_station_defaults(fleet, asked);
    const auto checked = check_order(fleet, request, order.id);
    if (!checked) return fail(checked.error());
    const auto plan = plan_order(fleet, request, checked->stations, order.id, now);
    if (!plan) return fail(plan.error());
    JobOrder changed = order;
    fill(changed, request, *checked, *plan);
    changed.sequence = request.sequence;
    if (depends_on(fleet, changed, order.id, &changed)) {
        return fail(Errc::kConflict, "dependency_cycle",
                    "The order would wait for orders that wait for it. Leave one of them out.",
                    request.after.empty() ? "/sequence" : "/after");
    }
    changed.sequence = order.sequence;
    order = std::move(changed);
    fleet.orders.set_sequence(order, request.sequence);
    add_event(fleet, now, event::kJobOrderUpdated, order.id, {}, order.wanted_vehicle, actor,
              {{"steps", static_cast<std::int64_t>(order.steps.size())}});
    fleet.store(order);
    return {};
}

}  // namespace pulseline::fleet
