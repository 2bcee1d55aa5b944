#pragma once

#include <concepts>
#include <type_traits>

#include "core/fleet/state/codec.hpp"
#include "core/fleet/state/leg_plan.hpp"
#include "core/fleet/state/ports.hpp"

/// Every plain struct of the fleet, described once for writing, reading and comparing. A
/// description binds all members by place: one that is added does not compile until it stands here.
/// What is left out on purpose is bound all the same, and a comment says why.
namespace pulseline {

#define PULSELINE_FIELDS(Type, ...)                     \
    template <class V, class S>                         \
    requires std::same_as<std::remove_const_t<S>, Type> \
    void fields(V& visit, S& it) {                      \
        auto& [__VA_ARGS__] = it;                       \
        visit(__VA_ARGS__);                             \
    }
#define PULSELINE_LAST(Type, last)                \
    template <>                                   \
    struct fleet::journal::Last<Type> {           \
        static constexpr Type value = Type::last; \
    };

PULSELINE_FIELDS(Param, name, value)
PULSELINE_FIELDS(Reason, code, params)
PULSELINE_LAST(plant::MotionMode, kFree)
PULSELINE_LAST(plant::Tolerance::Shape, kEllipse)
PULSELINE_LAST(plant::LoadKind, kInstrument)
PULSELINE_LAST(kinematics::Segment::Kind, kCombined)
PULSELINE_LAST(vda5050::BlockingType, kHard)
PULSELINE_LAST(vda5050::ActionStatus, kFailed)
PULSELINE_LAST(fleet::JobState, kAborted)
PULSELINE_LAST(fleet::Integration, kUtilise)
PULSELINE_LAST(fleet::StepState, kSkipped)
PULSELINE_LAST(fleet::StepPhase, kAfter)
PULSELINE_LAST(fleet::JobMethod, kClear)
PULSELINE_LAST(fleet::Link, kGone)
PULSELINE_LAST(fleet::Activity, kUnknown)
PULSELINE_LAST(fleet::LiftMove::State, kFailed)
PULSELINE_LAST(fleet::PoseBasis::Kind, kReflectors)

namespace geometry {
PULSELINE_FIELDS(Point2, x_m, y_m)
PULSELINE_FIELDS(Pose2, x_m, y_m, heading_rad)
}  // namespace geometry

namespace plant {
PULSELINE_FIELDS(Load, id, name, kind, model, mass_kg, centre, outline, vehicle_types, vehicle,
                 station, names)
}  // namespace plant

namespace kinematics {
PULSELINE_FIELDS(Segment, kind, start, end, turn_rad, length_m, direction_rad, centre, duration_s)
PULSELINE_FIELDS(ExpectedDeviation, position_m, heading_rad)
}  // namespace kinematics

namespace planning {
// The type is the vehicle's own: snapshot.cpp puts it back.
template <class V, class S>
requires std::same_as<std::remove_const_t<S>, LegRequest>
void fields(V& visit, S& it) {
    auto& [type, loaded, hall, start, from_station, target, target_pose, mode] = it;
    visit(loaded, hall, start, from_station, target, target_pose, mode);
}
// What only the choice of a plan and people need is left out.
template <class V, class S>
requires std::same_as<std::remove_const_t<S>, LegPlan>
void fields(V& visit, S& it) {
    auto& [mode, segments, max_speed_mps, route, length_m, turns, cost, accuracy, duration_s,
           expected, closures, loads, blind, clearance_m, nearest, wheels, swept_area_m2, swept,
           chain] = it;
    visit(mode, segments, max_speed_mps, route, length_m, turns, cost, duration_s, expected,
          closures, loads);
}
}  // namespace planning

namespace plant {
PULSELINE_FIELDS(Corridor, left_m, right_m)
PULSELINE_FIELDS(Tolerance, shape, dx_m, dy_m, dheading_rad)
PULSELINE_FIELDS(LightPlane, a, b, offset_m)
PULSELINE_FIELDS(Transmitter, id, hall, position, z_m, roll_rad, pitch_rad, heading_rad, rate_hz,
                 first, second, range_m, elevation_rad, sigma_rad, sigma_place_m, sigma_turn_rad)
PULSELINE_FIELDS(Reflector, id, hall, position, sigma_m)
PULSELINE_FIELDS(BracketShare, bracket, share, limit)
}  // namespace plant

namespace vda5050 {
PULSELINE_FIELDS(SurveyedMarker, payload, kind, size_m, pose, sigma_m, sigma_rad)
PULSELINE_FIELDS(StopTarget, station_id, station_number, target, tolerance_x_m, tolerance_y_m,
                 tolerance_heading_rad, markers)
PULSELINE_FIELDS(InitPosition, pose, map_id, last_node_id, sigma_xy_m, sigma_heading_rad,
                 worked_out)
template <class V, class S>
requires std::same_as<std::remove_const_t<S>, Action>
void fields(V& visit, S& it) {
    auto& [type, id, blocking, stop_target, init_position, params, markers, transmitters,
           reflectors, segment_markers, boundary_marker] = it;
    visit(type, id, blocking, stop_target, init_position, params, transmitters, reflectors);
}
PULSELINE_FIELDS(OrderNode, node_id, sequence_id, released, pose, has_heading,
                 allowed_deviation_xy_m, allowed_deviation_theta_rad, map_id, actions)
// What an edge asks for is made anew whenever an order is sent, and nothing else has such markers.
template <class V, class S>
requires std::same_as<std::remove_const_t<S>, OrderEdge>
void fields(V& visit, S& it) {
    auto& [edge_id, sequence_id, released, segment, max_speed_mps, corridor, actions] = it;
    visit(edge_id, sequence_id, released, segment, max_speed_mps, corridor);
}
PULSELINE_FIELDS(OrderMessage, order_id, order_update_id, nodes, edges)
PULSELINE_FIELDS(InstantActionsMessage, actions)
PULSELINE_FIELDS(StopMeasurement, pose, sigma_xy_m, sigma_heading_rad, method, markers, arrived)
PULSELINE_FIELDS(ActionState, id, type, status, result_description, measurement)
PULSELINE_FIELDS(VehicleError, type, fatal, description, references)
PULSELINE_FIELDS(BracketStatus, name, force_a_n, force_b_n, height_m)
PULSELINE_FIELDS(WheelStatus, name, steering_rad, speed_mps, temperature_c, fault)
PULSELINE_FIELDS(CameraReading, camera, found, payload, code, angle_rad, sigma_m, rms_px, why_not)
PULSELINE_FIELDS(ReceiverReading, receiver, found, place, z_m, sigma_m, transmitters, why_not)
PULSELINE_FIELDS(ReflectorSight, place, sigma_m)
PULSELINE_FIELDS(NavigationStatus, by, driven_m, explained, why_not)
PULSELINE_FIELDS(ParkingFoot, name, extension_m, force_n)
PULSELINE_FIELDS(NodeState, node_id, sequence_id, released)
// Fixes are only shown; nothing is decided by them, so that they are no news, and not journalled.
template <class V, class S>
requires std::same_as<std::remove_const_t<S>, StateMessage>
void fields(V& visit, S& it) {
    auto& [header_id, timestamp, order_id, order_update_id, last_node_id, last_node_sequence_id,
           node_states, edge_states, driving, paused, new_base_request, distance_since_last_node_m,
           operating_mode, in_hand_of, pose, position_initialized, localization_score,
           deviation_range_m, map_id, velocity_mps, turn_rate_radps, battery_percent, charging,
           e_stop, field_violation, action_states, errors, brackets, wheels, cameras, receivers,
           reflectors, navigation, parking_feet, load_kg, fixes] = it;
    visit(header_id, timestamp, order_id, order_update_id, last_node_id, last_node_sequence_id,
          node_states, edge_states, driving, paused, new_base_request, distance_since_last_node_m,
          operating_mode, in_hand_of, pose, position_initialized, localization_score,
          deviation_range_m, map_id, velocity_mps, turn_rate_radps, battery_percent, charging,
          e_stop, field_violation, action_states, errors, brackets, wheels, cameras, receivers,
          reflectors, navigation, parking_feet, load_kg);
}
PULSELINE_FIELDS(Factsheet, series_name, speed_max_mps, acceleration_max_mps2, length_m, width_m,
                 actions, node_actions, instant_actions, json)
}  // namespace vda5050

namespace fleet {

// --- job_order.hpp
PULSELINE_FIELDS(StepAction, type, params)
PULSELINE_FIELDS(Step, station, mode, before, after, phase, actions_done, state, leg, stop,
                 attempts, planned_s)
PULSELINE_FIELDS(Dependency, order, number, outcome)
PULSELINE_FIELDS(JobOrder, id, number, client_order_id, wanted_vehicle, wanted_type,
                 assigned_vehicle, priority, earliest_start, due, after, sequence, sequence_vehicle,
                 from_template, from_schedule, steps, current_step, state, cancel_requested,
                 stop_requested, pause_requested, removed, reason, created_by, created, started,
                 ended, expected, revision)
PULSELINE_FIELDS(Arrival, dx_m, dy_m, dheading_rad, expected_m, expected_rad)
PULSELINE_FIELDS(StopRecord, id, order, leg, step, vehicle, station, station_number, mode,
                 theoretical, measured, dx_m, dy_m, dheading_rad, along_m, left_m, sigma_xy_m,
                 sigma_heading_rad, tolerance, inside, attempt, method, markers, load_kg, load, at,
                 arrival)
PULSELINE_FIELDS(Event, seq, at, type, order, leg, vehicle, actor, params)
PULSELINE_FIELDS(Leg, id, order, step, vehicle, station, mode, hall, update_id, nodes, edges,
                 released_nodes, passed_nodes, duration_s, attempt, actions_only, charges)
PULSELINE_FIELDS(Whereabouts, pose, hall)
PULSELINE_FIELDS(StatedPose, pose, sigma_xy_m, sigma_heading_rad)
PULSELINE_FIELDS(Pause, actor, at, with_fleet)
PULSELINE_FIELDS(LoadRecord, id, vehicle, station, at, actor)
PULSELINE_FIELDS(LoadPlace, vehicle, station)
PULSELINE_FIELDS(LoadSheet, load, at, actor, retired)
PULSELINE_FIELDS(PoseBasis, kind, station, actor, at, driven_m)
PULSELINE_FIELDS(VehicleRecord, id, pose_known, pose, hall, claim, at_station, leg, has_leg,
                 leg_data, needs_resume, needs_resume_reason, paused, integration, last_stop,
                 last_stop_station, last_stop_inside, basis)

// --- leg_plan.hpp
PULSELINE_FIELDS(LegPlanAnswer, plan, why_not)

// --- new_order.hpp, closure.hpp, standing_orders.hpp
PULSELINE_FIELDS(NewStep, station_number, mode, before, after, says_before, says_after)
PULSELINE_FIELDS(NewOrder, client_order_id, vehicle, vehicle_type, priority, start, earliest_start,
                 due, after, sequence, steps, planned_beside, from_template, from_schedule, actor,
                 idempotency_client, idempotency_key, body_sha256)
PULSELINE_FIELDS(Closure, id, name, hall, outline, edges, created_by, created)
PULSELINE_FIELDS(NewClosure, name, hall, outline, edges)
PULSELINE_FIELDS(OrderTemplate, name, description, parameters, body, created_by, created, deleted)
PULSELINE_FIELDS(Recurrence, every, daily_at_s, time_zone, window, from, until)
PULSELINE_FIELDS(NewSchedule, name, recurrence, order, actor)
PULSELINE_FIELDS(Schedule, id, name, recurrence, order, paused, next, newest_order, made, skipped,
                 last_skip, created_by, created, revision, deleted)
PULSELINE_FIELDS(StandingOrders, templates, schedules, changed_templates, changed_schedules,
                 deleted_schedules, skipped_in_a_row)
PULSELINE_FIELDS(ControlRequest, method, update, if_revision, actor, idempotency_client,
                 idempotency_key, body_sha256)

// --- views.hpp, ports.hpp: what a step puts out
PULSELINE_FIELDS(StoreFault, cause, since)
PULSELINE_FIELDS(ClockDifference, ahead, since)
// The chain follows from the leg and the plant.
template <class V, class S>
requires std::same_as<std::remove_const_t<S>, LegView>
void fields(V& visit, S& it) {
    auto& [id, station, mode, path, granted_points, granted_area, horizon_area, duration_s,
           progress, started, expected, chain] = it;
    visit(id, station, mode, path, granted_points, granted_area, horizon_area, duration_s, progress,
          started, expected);
}
PULSELINE_FIELDS(LoadView, force_n, centre, worst, fault)
PULSELINE_FIELDS(LiftMove, what, action_id, actor, at, state, why)
PULSELINE_FIELDS(CarriedLoad, id, name, mass_kg)
PULSELINE_FIELDS(VehicleView, id, link, activity, reason, last_heard, pose_known, pose_basis, pose,
                 claimed_pose, pose_at, hall, at_station, carries, order, leg, paused,
                 stands_paused, integration, needs_resume, needs_resume_reason, made_way, load,
                 lift, state)
PULSELINE_FIELDS(StationView, id, number, occupied_by, reserved_by, ready, last_stop, holds)
PULSELINE_FIELDS(IdempotencyRecord, client, key, body_sha256, order, at)
// The journal's own rows are no part of what it is compared by.
template <class V, class S>
requires std::same_as<std::remove_const_t<S>, Records>
void fields(V& visit, S& it) {
    auto& [orders, vehicles, loads, load_sheets, stops, events, idempotency, closures, reopened,
           schedules, templates, journal_rows] = it;
    visit(orders, vehicles, loads, load_sheets, stops, events, idempotency, closures, reopened,
          schedules, templates);
}
PULSELINE_FIELDS(VehicleMessage, vehicle, order, instant_actions)
// Closed floor, who stands where, and tables are those of the state it was asked in.
template <class V, class S>
requires std::same_as<std::remove_const_t<S>, LegPlanQuestion>
void fields(V& visit, S& it) {
    auto& [number, vehicle, request, closures, standing, tables] = it;
    visit(number, vehicle, request);
}
PULSELINE_FIELDS(Outputs, records, messages, vehicles, stations, plans_wanted, fleet_changed)

}  // namespace fleet
}  // namespace pulseline
