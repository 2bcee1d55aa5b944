#include "core/fleet/state.hpp"

namespace pulseline::fleet {
namespace {

constexpr int kAlternatives = 3;

}  // namespace

Preview Fleet::preview(const NewOrder& order, Time now) const {
    Preview preview;
    preview.vehicle = order.vehicle;
    auto plan = plan_order(*state_, order, now);
    preview.accepted = plan.has_value();
    if (!plan) preview.problem = plan.error();
    if (plan) preview.vehicle = plan->vehicle;
    const VehicleRun* run = state_->find(preview.vehicle);
    if (!run) return preview;

    const plant::Station* first = nullptr;
    std::optional<planning::LegPlan> first_plan;
    std::optional<Pose2> pose;
    if (run->record.pose_known) pose = run->record.pose;
    const auto standing =
        standing_bodies(*state_, plant::HallId(hall_of(*state_, *run)), run->record.id);
    for (std::size_t i = 0; i < order.steps.size(); ++i) {
        const auto* station = plant::find_station(state_->plant, order.steps[i].station_number);
        if (!station) break;
        StepPreview step;
        step.station = station->id;
        step.number = station->number;
        step.start = plan ? plan->starts[i] : pose.value_or(Pose2{});
        const auto request =
            leg_request(*state_, *run, step.start, station->id, order.steps[i].mode);
        if (plan || pose) step.options = state_->planner.assess_modes(request, standing);
        for (const auto& option : step.options) {
            const bool wanted = order.steps[i].mode == plant::MotionMode::kAuto
                                    ? option.suggested
                                    : option.mode == order.steps[i].mode;
            if (!wanted || !option.plan) continue;
            step.chosen = option.mode;
            step.alternatives = state_->planner.alternatives(request, *option.plan, kAlternatives);
            if (i == 0) first_plan = *option.plan;
        }
        if (i == 0) first = station;
        pose = station->pose;
        preview.steps.push_back(std::move(step));
    }
    preview.checks = start_checks(*state_, *run, first, first_plan, now);
    return preview;
}

std::optional<JobOrder> Fleet::order(JobOrderId id) const {
    const JobOrder* order = state_->find(id);
    return order ? std::optional<JobOrder>(*order) : std::nullopt;
}

std::vector<JobOrder> Fleet::orders() const {
    constexpr std::size_t kRecent = 100;  // the store has the rest
    return state_->orders.newest_first(kRecent);
}

std::optional<VehicleView> Fleet::vehicle(const plant::VehicleId& id, Time now,
                                          bool with_leg) const {
    const VehicleRun* run = state_->find(id);
    if (!run) return std::nullopt;
    return view_of(*state_, *run, now, with_leg);
}

std::vector<VehicleView> Fleet::vehicles(Time now) const {
    std::vector<VehicleView> views;
    for (const auto& [id, run] : state_->vehicles) views.push_back(view_of(*state_, run, now));
    return views;
}

std::vector<StationView> Fleet::stations() const {
    std::vector<StationView> views;
    for (const auto& station : state_->plant.stations)
        views.push_back(station_view(*state_, station));
    return views;
}

std::int64_t Fleet::last_event_seq() const { return state_->event_seq; }

FleetView Fleet::view(Time) const {
    FleetView view;
    view.store_fault = state_->store_fault;
    // While nothing can be stored, events still wait; a reader must not go on behind them.
    view.last_event_seq = state_->store_fault ? state_->stored_seq : state_->event_seq;
    view.started = state_->started;
    view.paused = !state_->vehicles.empty();
    for (const auto& [id, run] : state_->vehicles) {
        ++view.vehicles_total;
        if (run.link == Link::kLive) ++view.vehicles_live;
        if (run.record.needs_resume) view.needs_resume.push_back(id);
        if (!run.record.paused) view.paused = false;
    }
    return view;
}

}  // namespace pulseline::fleet
