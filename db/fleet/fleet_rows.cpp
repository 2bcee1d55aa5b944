#include "db/fleet/fleet_rows.hpp"

#include "db/fleet/leg_json.hpp"
#include "db/fleet/order_json.hpp"
#include "db/json_text.hpp"
#include "db/names.hpp"

namespace pulseline::db {
void OrderRow::set(const fleet::JobOrder& order) {
    id = stored_id(order.id);
    number = order.number;
    client_order_id = order.client_order_id;
    wanted_vehicle = order.wanted_vehicle.str();
    assigned_vehicle = order.assigned_vehicle.str();
    priority = order.priority;
    current_step = static_cast<std::int64_t>(order.current_step);
    state = stored(order.state);
    cancel_requested = order.cancel_requested;
    pause_requested = order.pause_requested;
    reason_code = order.reason.code;
    reason_params = params_to_json(order.reason.params);
    created_by = order.created_by;
    created_ns = to_ns(order.created);
    started_ns = to_ns(order.started);
    ended_ns = to_ns(order.ended);
    expected_ns = order.expected ? to_ns(*order.expected) : 0;
    revision = order.revision;
    wanted_type = order.wanted_type.str();
    earliest_start_ns = order.earliest_start ? to_ns(*order.earliest_start) : 0;
    due_ns = order.due ? to_ns(*order.due) : 0;
    dependencies = dependencies_to_json(order.after);
    sequence = order.sequence;
    sequence_vehicle = order.sequence_vehicle.str();
    from_template = order.from_template;
    from_schedule = stored_id(order.from_schedule);
    stop_requested = order.stop_requested;
    removed = order.removed;
}

fleet::JobOrder OrderRow::get() const {
    fleet::JobOrder order;
    read_id(id, order.id);
    order.number = count(number);
    order.client_order_id = client_order_id;
    order.wanted_vehicle = plant::VehicleId(wanted_vehicle);
    order.assigned_vehicle = plant::VehicleId(assigned_vehicle);
    order.priority = static_cast<int>(priority);
    order.current_step = static_cast<std::size_t>(current_step);
    read(state, order.state);
    order.cancel_requested = cancel_requested != 0;
    order.pause_requested = pause_requested != 0;
    order.reason = {reason_code, params_from_json(reason_params)};
    order.created_by = created_by;
    order.created = time_from_ns(created_ns);
    order.started = time_from_ns(started_ns);
    order.ended = time_from_ns(ended_ns);
    if (expected_ns != 0) order.expected = time_from_ns(expected_ns);
    order.revision = count(revision);
    order.wanted_type = plant::VehicleTypeId(wanted_type);
    if (earliest_start_ns != 0) order.earliest_start = time_from_ns(earliest_start_ns);
    if (due_ns != 0) order.due = time_from_ns(due_ns);
    order.after = dependencies_from_json(dependencies);
    order.sequence = sequence;
    order.sequence_vehicle = plant::VehicleId(sequence_vehicle);
    order.from_template = from_template;
    read_id(from_schedule, order.from_schedule);
    order.stop_requested = stop_requested != 0;
    order.removed = removed != 0;
    return order;
}

void StepRow::set(const std::string& order, std::size_t index, const fleet::Step& step) {
    order_id = order;
    position = static_cast<std::int64_t>(index);
    station = step.station.str();
    mode = plant::to_string(step.mode);
    state = stored(step.state);
    leg = stored_id(step.leg);
    stop = stored_id(step.stop);
    attempts = step.attempts;
    planned_s = finite(step.planned_s, "planned_s");
    actions_before = actions_to_json(step.before);
    actions_after = actions_to_json(step.after);
    phase = stored(step.phase);
    actions_done = static_cast<std::int64_t>(step.actions_done);
}

fleet::Step StepRow::get() const {
    fleet::Step step;
    step.station = plant::StationId(station);
    read(mode, step.mode);
    read(state, step.state);
    read_id(leg, step.leg);
    read_id(stop, step.stop);
    step.attempts = static_cast<int>(attempts);
    step.planned_s = planned_s;
    step.before = actions_from_json(actions_before);
    step.after = actions_from_json(actions_after);
    read(phase, step.phase);
    step.actions_done = static_cast<std::size_t>(actions_done);
    return step;
}

void StopRow::set(const fleet::StopRecord& s) {
    numbers = s;
    has_arrival = s.arrival.has_value();
    arrival = s.arrival.value_or(fleet::Arrival{});
    for (const auto& [value, name] :
         {std::pair(s.theoretical.x_m, "theoretical.x_m"),
          std::pair(s.theoretical.y_m, "theoretical.y_m"),
          std::pair(s.theoretical.heading_rad, "theoretical.heading_rad"),
          std::pair(s.measured.x_m, "measured.x_m"),
          std::pair(s.measured.y_m, "measured.y_m"),
          std::pair(s.measured.heading_rad, "measured.heading_rad"),
          std::pair(s.dx_m, "dx_m"),
          std::pair(s.dy_m, "dy_m"),
          std::pair(s.dheading_rad, "dheading_rad"),
          std::pair(s.along_m, "along_m"),
          std::pair(s.left_m, "left_m"),
          std::pair(s.sigma_xy_m, "sigma_xy_m"),
          std::pair(s.sigma_heading_rad, "sigma_heading_rad"),
          std::pair(s.tolerance.dx_m, "tolerance.dx_m"),
          std::pair(s.tolerance.dy_m, "tolerance.dy_m"),
          std::pair(s.tolerance.dheading_rad, "tolerance.dheading_rad"),
          std::pair(s.load_kg, "load_kg"),
          std::pair(arrival.dx_m, "arrival.dx_m"),
          std::pair(arrival.dy_m, "arrival.dy_m"),
          std::pair(arrival.dheading_rad, "arrival.dheading_rad"),
          std::pair(arrival.expected_m, "arrival.expected_m"),
          std::pair(arrival.expected_rad, "arrival.expected_rad")}) {
        finite(value, name);
    }
    id = stored_id(s.id);
    order_id = stored_id(s.order);
    leg = stored_id(s.leg);
    step = s.step;
    vehicle = s.vehicle.str();
    station = s.station.str();
    station_number = s.station_number;
    mode = plant::to_string(s.mode);
    tolerance_shape = stored(s.tolerance.shape);
    inside = s.inside;
    attempt = s.attempt;
    method = s.method;
    markers = texts_to_json(s.markers);
    load = s.load.str();
    at_ns = to_ns(s.at);
}

fleet::StopRecord StopRow::get() const {
    fleet::StopRecord s = numbers;
    read_id(id, s.id);
    read_id(order_id, s.order);
    read_id(leg, s.leg);
    s.step = static_cast<int>(step);
    s.vehicle = plant::VehicleId(vehicle);
    s.station = plant::StationId(station);
    s.station_number = static_cast<int>(station_number);
    read(mode, s.mode);
    read(tolerance_shape, s.tolerance.shape);
    s.inside = inside != 0;
    s.attempt = static_cast<int>(attempt);
    s.method = method;
    s.markers = texts_from_json(markers);
    s.load = plant::LoadId(load);
    s.at = time_from_ns(at_ns);
    s.arrival.reset();
    if (has_arrival != 0) s.arrival = arrival;
    return s;
}

void EventRow::set(const fleet::Event& event) {
    seq = event.seq;
    at_ns = to_ns(event.at);
    type = event.type;
    order_id = stored_id(event.order);
    leg = stored_id(event.leg);
    vehicle = event.vehicle.str();
    actor = event.actor;
    params = params_to_json(event.params);
}

fleet::Event EventRow::get() const {
    fleet::Event event;
    event.seq = seq;
    event.at = time_from_ns(at_ns);
    event.type = type;
    read_id(order_id, event.order);
    read_id(leg, event.leg);
    event.vehicle = plant::VehicleId(vehicle);
    event.actor = actor;
    event.params = params_from_json(params);
    return event;
}

void LoadPlaceRow::set(const fleet::LoadRecord& load) {
    id = load.id.str();
    vehicle = load.vehicle.str();
    station = load.station.str();
    at_ns = to_ns(load.at);
    actor = load.actor;
}

fleet::LoadRecord LoadPlaceRow::get() const {
    return {plant::LoadId(id), plant::VehicleId(vehicle), plant::StationId(station),
            time_from_ns(at_ns), actor};
}

void LoadSheetRow::set(const fleet::LoadSheet& sheet) {
    load.set(sheet.load);
    at_ns = to_ns(sheet.at);
    actor = sheet.actor;
    retired = sheet.retired ? 1 : 0;
}

fleet::LoadSheet LoadSheetRow::get() const {
    return {load.get(), time_from_ns(at_ns), actor, retired != 0};
}

fleet::LoadMove LoadMoveRow::get() const {
    return {id,
            {plant::VehicleId(from_vehicle), plant::StationId(from_station)},
            {plant::VehicleId(to_vehicle), plant::StationId(to_station)},
            time_from_ns(at_ns),
            actor};
}

void VehicleRow::set(const fleet::VehicleRecord& v) {
    id = v.id.str();
    pose_known = v.pose_known;
    x_m = finite(v.pose.x_m, "pose.x_m");
    y_m = finite(v.pose.y_m, "pose.y_m");
    heading_rad = finite(v.pose.heading_rad, "pose.heading_rad");
    at_station = v.at_station.str();
    leg = stored_id(v.leg);
    has_leg = v.has_leg;
    leg_data = v.has_leg ? leg_to_json(v.leg_data) : std::string();
    needs_resume = v.needs_resume;
    needs_resume_code = v.needs_resume_reason.code;
    needs_resume_params = params_to_json(v.needs_resume_reason.params);
    const fleet::Pause pause = v.paused.value_or(fleet::Pause{});
    paused = v.paused.has_value();
    paused_by = pause.actor;
    paused_ns = to_ns(pause.at);
    paused_with_fleet = pause.with_fleet;
    last_stop = stored_id(v.last_stop);
    last_stop_station = v.last_stop_station.str();
    last_stop_inside = v.last_stop_inside;
    integration = stored(v.integration);
    hall = v.hall;
    const fleet::Whereabouts claim = v.claim.value_or(fleet::Whereabouts{});
    claimed_hall = claim.hall;
    claimed_x_m = finite(claim.pose.x_m, "claim.x_m");
    claimed_y_m = finite(claim.pose.y_m, "claim.y_m");
    claimed_heading_rad = finite(claim.pose.heading_rad, "claim.heading_rad");
    in_doubt = v.claim.has_value();
    const fleet::PoseBasis rests = v.basis.value_or(fleet::PoseBasis{});
    basis = v.basis ? stored(rests.kind) : "";
    basis_station = rests.station.str();
    basis_actor = rests.actor;
    basis_ns = to_ns(rests.at);
    basis_driven_m = finite(rests.driven_m, "basis.driven_m");
}

fleet::VehicleRecord VehicleRow::get() const {
    fleet::VehicleRecord v;
    v.id = plant::VehicleId(id);
    v.pose_known = pose_known != 0;
    v.pose = {x_m, y_m, heading_rad};
    v.at_station = plant::StationId(at_station);
    read_id(leg, v.leg);
    v.has_leg = has_leg != 0;
    if (v.has_leg) v.leg_data = leg_from_json(leg_data);
    v.needs_resume = needs_resume != 0;
    v.needs_resume_reason = {needs_resume_code, params_from_json(needs_resume_params)};
    if (paused != 0) {
        v.paused = fleet::Pause{paused_by, time_from_ns(paused_ns), paused_with_fleet != 0};
    }
    read_id(last_stop, v.last_stop);
    v.last_stop_station = plant::StationId(last_stop_station);
    v.last_stop_inside = last_stop_inside != 0;
    read(integration, v.integration);
    v.hall = hall;
    if (in_doubt != 0) {
        v.claim = fleet::Whereabouts{{claimed_x_m, claimed_y_m, claimed_heading_rad}, claimed_hall};
    }
    if (!basis.empty()) {
        v.basis = fleet::PoseBasis{{},
                                   plant::StationId(basis_station),
                                   basis_actor,
                                   time_from_ns(basis_ns),
                                   basis_driven_m};
        read(basis, v.basis->kind);
    }
    return v;
}

}  // namespace pulseline::db
