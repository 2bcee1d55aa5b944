#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "core/fleet/state/job_order.hpp"
#include "core/fleet/state/ports.hpp"
#include "db/plant/plant_rows.hpp"

/// Rows of the fleet's tables as plain columns, shared by the store that writes and the history
/// that reads. `columns` and `fields()` list the same names in the same order.
namespace pulseline::db {

struct OrderRow {
    static constexpr const char* kColumns =
        "id, number, client_order_id, wanted_vehicle, assigned_vehicle, priority, current_step, "
        "state, cancel_requested, pause_requested, reason_code, reason_params, created_by, "
        "created_ns, started_ns, ended_ns, expected_ns, revision, wanted_type, earliest_start_ns, "
        "due_ns, dependencies, sequence, sequence_vehicle, from_template, from_schedule, "
        "stop_requested, removed";
    std::string id, client_order_id, wanted_vehicle, assigned_vehicle, state, reason_code,
        reason_params, created_by, wanted_type, dependencies, sequence, sequence_vehicle,
        from_template, from_schedule;
    std::int64_t number = 0, priority = 0, current_step = 0, created_ns = 0, started_ns = 0,
                 ended_ns = 0, expected_ns = 0, revision = 0, earliest_start_ns = 0, due_ns = 0;
    int cancel_requested = 0, pause_requested = 0, stop_requested = 0, removed = 0;

    auto fields() {
        return std::tie(id, number, client_order_id, wanted_vehicle, assigned_vehicle, priority,
                        current_step, state, cancel_requested, pause_requested, reason_code,
                        reason_params, created_by, created_ns, started_ns, ended_ns, expected_ns,
                        revision, wanted_type, earliest_start_ns, due_ns, dependencies, sequence,
                        sequence_vehicle, from_template, from_schedule, stop_requested, removed);
    }
    void set(const fleet::JobOrder& order);
    fleet::JobOrder get() const;  // without steps
};

struct StepRow {
    static constexpr const char* kColumns =
        "order_id, position, station, mode, state, leg, stop, attempts, planned_s, "
        "actions_before, actions_after, phase, actions_done";
    std::string order_id, station, mode, state, leg, stop, actions_before, actions_after, phase;
    std::int64_t position = 0, attempts = 0, actions_done = 0;
    double planned_s = 0;

    auto fields() {
        return std::tie(order_id, position, station, mode, state, leg, stop, attempts, planned_s,
                        actions_before, actions_after, phase, actions_done);
    }
    void set(const std::string& order, std::size_t index, const fleet::Step& step);
    fleet::Step get() const;
};

struct StopRow {
    static constexpr const char* kColumns =
        "id, order_id, leg, step, vehicle, station, station_number, mode, theoretical_x_m, "
        "theoretical_y_m, theoretical_heading_rad, measured_x_m, measured_y_m, "
        "measured_heading_rad, dx_m, dy_m, dheading_rad, along_m, left_m, sigma_xy_m, "
        "sigma_heading_rad, tolerance_shape, tolerance_dx_m, tolerance_dy_m, "
        "tolerance_dheading_rad, inside, attempt, method, markers, load_kg, load, at_ns, "
        "has_arrival, "
        "arrival_dx_m, arrival_dy_m, arrival_dheading_rad, arrival_expected_m, "
        "arrival_expected_rad";
    std::string id, order_id, leg, vehicle, station, mode, tolerance_shape, method, markers, load;
    std::int64_t step = 0, station_number = 0, attempt = 0, at_ns = 0;
    int inside = 0, has_arrival = 0;
    fleet::Arrival arrival;
    fleet::StopRecord numbers;  // its doubles are columns of their own

    auto fields() {
        auto& n = numbers;
        return std::tie(id, order_id, leg, step, vehicle, station, station_number, mode,
                        n.theoretical.x_m, n.theoretical.y_m, n.theoretical.heading_rad,
                        n.measured.x_m, n.measured.y_m, n.measured.heading_rad, n.dx_m, n.dy_m,
                        n.dheading_rad, n.along_m, n.left_m, n.sigma_xy_m, n.sigma_heading_rad,
                        tolerance_shape, n.tolerance.dx_m, n.tolerance.dy_m,
                        n.tolerance.dheading_rad, inside, attempt, method, markers, n.load_kg, load,
                        at_ns, has_arrival, arrival.dx_m, arrival.dy_m, arrival.dheading_rad,
                        arrival.expected_m, arrival.expected_rad);
    }
    void set(const fleet::StopRecord& stop);
    fleet::StopRecord get() const;
};

struct EventRow {
    static constexpr const char* kColumns =
        "seq, at_ns, type, order_id, leg, vehicle, actor, params";
    std::int64_t seq = 0, at_ns = 0;
    std::string type, order_id, leg, vehicle, actor, params;

    auto fields() { return std::tie(seq, at_ns, type, order_id, leg, vehicle, actor, params); }
    void set(const fleet::Event& event);
    fleet::Event get() const;
};

/// Where a load is.
struct LoadPlaceRow {
    static constexpr const char* kColumns = "id, vehicle, station, at_ns, actor";
    std::string id, vehicle, station, actor;
    std::int64_t at_ns = 0;

    auto fields() { return std::tie(id, vehicle, station, at_ns, actor); }
    void set(const fleet::LoadRecord& load);
    fleet::LoadRecord get() const;
};

/// What is known of it.
struct LoadSheetRow {
    static constexpr const char* kColumns =
        "id, name, kind, model, mass_kg, centre_x_m, centre_y_m, outline, vehicle_types, names, "
        "at_ns, actor, retired";
    LoadRow load;
    std::int64_t at_ns = 0, retired = 0;
    std::string actor;

    auto fields() {
        auto& l = load.element;
        return std::tie(load.id, l.name, load.kind, l.model, l.mass_kg, l.centre.x_m, l.centre.y_m,
                        load.outline, load.vehicle_types, load.names, at_ns, actor, retired);
    }
    void set(const fleet::LoadSheet& sheet);
    fleet::LoadSheet get() const;
};

/// Where it had been before. Only read: the store writes it from what it knew and a LoadPlaceRow.
struct LoadMoveRow {
    static constexpr const char* kColumns =
        "id, from_vehicle, from_station, to_vehicle, to_station, at_ns, actor";
    std::string from_vehicle, from_station, to_vehicle, to_station, actor;
    std::int64_t id = 0, at_ns = 0;

    auto fields() {
        return std::tie(id, from_vehicle, from_station, to_vehicle, to_station, at_ns, actor);
    }
    fleet::LoadMove get() const;
};

struct VehicleRow {
    static constexpr const char* kColumns =
        "id, pose_known, x_m, y_m, heading_rad, at_station, leg, has_leg, leg_data, needs_resume, "
        "needs_resume_code, needs_resume_params, paused, last_stop, last_stop_station, "
        "last_stop_inside, integration, hall, claimed_hall, claimed_x_m, claimed_y_m, "
        "claimed_heading_rad, in_doubt, paused_by, paused_ns, paused_with_fleet, basis, "
        "basis_station, basis_actor, basis_ns, basis_driven_m";
    std::string id, at_station, leg, leg_data, needs_resume_code, needs_resume_params, last_stop,
        last_stop_station, integration, hall, claimed_hall, paused_by, basis, basis_station,
        basis_actor;
    double x_m = 0, y_m = 0, heading_rad = 0;
    double claimed_x_m = 0, claimed_y_m = 0, claimed_heading_rad = 0;
    double basis_driven_m = 0;
    int pose_known = 0, has_leg = 0, needs_resume = 0, paused = 0, last_stop_inside = 0;
    int in_doubt = 0, paused_with_fleet = 0;
    std::int64_t paused_ns = 0, basis_ns = 0;

    auto fields() {
        return std::tie(id, pose_known, x_m, y_m, heading_rad, at_station, leg, has_leg, leg_data,
                        needs_resume, needs_resume_code, needs_resume_params, paused, last_stop,
                        last_stop_station, last_stop_inside, integration, hall, claimed_hall,
                        claimed_x_m, claimed_y_m, claimed_heading_rad, in_doubt, paused_by,
                        paused_ns, paused_with_fleet, basis, basis_station, basis_actor, basis_ns,
                        basis_driven_m);
    }
    void set(const fleet::VehicleRecord& vehicle);
    fleet::VehicleRecord get() const;
};

}  // namespace pulseline::db
