#include "core/fleet/views/order_preview.hpp"

#include <utility>
#include <vector>

#include "core/fleet/fleet.hpp"
#include "core/fleet/floor/closures.hpp"
#include "core/fleet/orders/checks.hpp"
#include "core/fleet/orders/order_loads.hpp"
#include "core/fleet/orders/planning.hpp"
#include "core/fleet/orders/station_defaults.hpp"
#include "core/fleet/orders/transfer_checks.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/leg_request.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/fleet/views/start_checks.hpp"

namespace pulseline::fleet {

struct PreviewState {
    const plant::Plant& plant;
    std::shared_ptr<const PlantTables> tables;
    Time started;
    std::vector<LiveVehicle> vehicles;
    std::map<plant::LoadId, LoadSheet> load_sheets;
    std::map<plant::LoadId, LoadRecord> loads;
    std::vector<JobOrder> orders;
    std::vector<planning::ClosedFloor> closures;
};
namespace {

constexpr int kAlternatives = 3;

/// Without its floor and what is only worked out of the rest.
LiveVehicle known_of(const LiveVehicle& live) {
    LiveVehicle copy;
    copy.vehicle = live.vehicle;
    copy.type = live.type;
    copy.record = live.record;
    copy.connected = live.connected;
    copy.reconciled = live.reconciled;
    copy.link = live.link;
    copy.last_heard = live.last_heard;
    copy.state = live.state;
    copy.state_at = live.state_at;
    copy.factsheet = live.factsheet;
    copy.delivery = live.delivery;
    copy.lift = live.lift;
    return copy;
}

Result<OrderPlan> plan_of(const FleetState& fleet, const NewOrder& order, Time now) {
    const auto stations = stations_of(fleet, order);
    if (!stations) return fail(stations.error());
    if (auto vehicles = check_vehicle_fields(fleet, order); !vehicles) {
        return fail(vehicles.error());
    }
    if (auto loads = check_transfers(fleet, order, *stations); !loads) return fail(loads.error());
    return plan_order(fleet, order, *stations, {}, now, FreeManoeuvres::kPlanned);
}

Preview preview_of(const FleetState& fleet, const NewOrder& asked, Time now) {
    const NewOrder order = with_station_defaults(fleet, asked);
    Preview preview;
    preview.vehicle = order.vehicle;
    auto plan = plan_of(fleet, order, now);
    preview.accepted = plan.has_value();
    if (!plan) preview.problem = plan.error();
    if (plan) preview.vehicle = plan->vehicle;
    const LiveVehicle* live = fleet.find(preview.vehicle);
    if (!live) return preview;

    const plant::Station* first = nullptr;
    std::optional<planning::LegPlan> first_plan;
    std::optional<Pose2> pose;
    if (live->record.pose_known) pose = live->record.pose;
    const auto loaded = drives_loaded(fleet, order, {}, *live);
    const auto standing =
        standing_bodies(fleet, plant::HallId(hall_of(fleet, *live)), live->record.id);
    for (std::size_t i = 0; i < order.steps.size(); ++i) {
        const auto* station = plant::find_station(fleet.plant, order.steps[i].station_number);
        if (!station) break;
        StepPreview step;
        step.station = station->id;
        step.number = station->number;
        step.start = plan ? plan->starts[i] : pose.value_or(Pose2{});
        auto request = leg_request(fleet, *live, step.start, station->id, order.steps[i].mode);
        request.loaded = loaded[i];
        if (plan || pose) step.options = fleet.planner.assess_modes(request, standing);
        for (const auto& option : step.options) {
            const bool wanted = order.steps[i].mode == plant::MotionMode::kAuto
                                    ? option.suggested
                                    : option.mode == order.steps[i].mode;
            if (!wanted || !option.plan) continue;
            step.chosen = option.mode;
            step.alternatives =
                fleet.planner.alternatives(request, *option.plan, kAlternatives, standing);
            if (i == 0) first_plan = *option.plan;
        }
        if (i == 0) first = station;
        pose = station->pose;
        preview.steps.push_back(std::move(step));
    }
    preview.checks = start_checks(fleet, *live, first, first_plan, now);
    return preview;
}

}  // namespace

Preview Fleet::preview(const NewOrder& order, Time now) const {
    return preview_of(*state_, order, now);
}

OrderPreviewTask Fleet::preview_task(const NewOrder& order, Time now, JobOrderId self) const {
    const FleetState& fleet = *state_;
    auto known = std::make_shared<PreviewState>(PreviewState{fleet.plant,
                                                             fleet.tables,
                                                             fleet.started,
                                                             {},
                                                             fleet.load_sheets,
                                                             fleet.loads,
                                                             {},
                                                             closed_floors()});
    for (const auto& [id, live] : fleet.vehicles) known->vehicles.push_back(known_of(live));
    for (const JobOrderId& id : fleet.orders.open()) {
        if (id == self) continue;
        const JobOrder& open = *fleet.find(id);
        // The rest says nothing of where a vehicle will be, nor of who may have the order.
        const bool bound = !open.assigned_vehicle.empty() || !open.wanted_vehicle.empty();
        if (bound || (!order.sequence.empty() && open.sequence == order.sequence)) {
            known->orders.push_back(open);
        }
    }
    return {order, now, std::move(known)};
}

OrderPreviewer::OrderPreviewer() = default;
OrderPreviewer::~OrderPreviewer() = default;
OrderPreviewer::OrderPreviewer(OrderPreviewer&&) noexcept = default;
OrderPreviewer& OrderPreviewer::operator=(OrderPreviewer&&) noexcept = default;

void OrderPreviewer::know(const PreviewState& known) {
    if (!fleet_ || fleet_->tables != known.tables) {
        fleet_ = std::make_unique<FleetState>(known.plant, known.tables, 0, known.started);
    }
    fleet_->started = known.started;
    fleet_->vehicles.clear();
    for (const auto& live : known.vehicles) fleet_->vehicles.emplace(live.record.id, live);
    fleet_->load_sheets = known.load_sheets;
    fleet_->loads = known.loads;
    find_loads(*fleet_);
    fleet_->orders = {};
    for (const auto& order : known.orders) fleet_->orders.add(order);
    fleet_->planner.set_closures(known.closures);
}

Preview OrderPreviewer::preview(const OrderPreviewTask& task) {
    know(*task.state);
    return preview_of(*fleet_, task.order, task.asked);
}

Status OrderPreviewer::plan_ahead(const OrderPreviewTask& task) {
    know(*task.state);
    const auto order = with_station_defaults(*fleet_, task.order);
    const auto plan = plan_of(*fleet_, order, task.asked);
    return plan ? Status() : fail(plan.error());
}

}  // namespace pulseline::fleet
