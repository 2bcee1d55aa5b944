#include "core/fleet/legs/stops.hpp"

#include <cmath>

#include "core/fleet/floor/grants.hpp"
#include "core/fleet/legs/ending.hpp"
#include "core/fleet/legs/step_actions.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/kinematics/dead_reckoning.hpp"
#include "core/plant/tolerance.hpp"

namespace pulseline::fleet {
namespace {

constexpr int kApproaches = 3;  // of one step before a person is asked

// A leg ends within centimetres of its station, and no camera sees a station's codes from farther
// away: what says so has read another code.
constexpr double kFarFromStation_m = 1;
constexpr double kFarFromStation_rad = radians(30);
// Its own pose follows what it has measured, but for the message under way.
constexpr double kElsewhere_m = 0.3;
// A vehicle that went round something still shows how it reckons; one that drove elsewhere first
// does not.
constexpr double kLongerThanPlanned = 1.2;

/// Why a measurement cannot be true; null: it can.
const char* fault_of(const FleetState& fleet, const LiveVehicle& live,
                     const plant::Station& station, const Pose2& found) {
    if (!(std::isfinite(found.x_m) && std::isfinite(found.y_m) &&
          std::isfinite(found.heading_rad))) {
        return "measured_nowhere";
    }
    if (!is_in_hall(fleet, {found, station.hall.str()})) return "measured_outside_hall";
    const bool far =
        geometry::distance(found.position(), station.pose.position()) > kFarFromStation_m ||
        std::abs(wrap(found.heading_rad - station.pose.heading_rad)) > kFarFromStation_rad;
    if (far) return "measured_far_from_station";
    const bool elsewhere =
        live.record.pose_known &&
        geometry::distance(found.position(), live.record.pose.position()) > kElsewhere_m;
    return elsewhere ? "measured_elsewhere" : nullptr;
}

/// What a usual vehicle would have missed the station by, where the whole drive began at a place
/// that had been measured; else nothing.
kinematics::ExpectedDeviation expected_of_drive(const LiveVehicle& live) {
    const auto& basis = live.record.basis;
    if (!basis || basis->kind != PoseBasis::Kind::kStop || live.leg().attempt != 1) return {};
    std::vector<kinematics::Segment> segments;
    double length_m = 0;
    bool drives = false;  // else it only measures again where it stands
    for (const vda5050::OrderEdge& edge : live.leg().edges) {
        segments.push_back(edge.segment);
        length_m += std::abs(edge.segment.length_m);
        drives = drives || edge.segment.length_m != 0 || edge.segment.turn_rad != 0;
    }
    if (!drives) return {};
    if (basis->driven_m > kLongerThanPlanned * length_m + kElsewhere_m) return {};
    return kinematics::expected_deviation(segments, kinematics::usual_noise(live.type->kinematics));
}

Arrival arrival_of(const LiveVehicle& live, const plant::Station& station, const Pose2& arrived) {
    const plant::Deviation by = plant::deviation(station, arrived);
    const auto expected = expected_of_drive(live);
    return {by.dx_m, by.dy_m, by.dheading_rad, expected.position_m, expected.heading_rad};
}

StopRecord stop_record(FleetState& fleet, const LiveVehicle& live, const plant::Station& station,
                       const vda5050::StopMeasurement& found, Time now) {
    const Leg& leg = live.leg();
    StopRecord stop;
    stop.id = StopRecordId(fleet.ids.next(now));
    stop.order = leg.order;
    stop.leg = leg.id;
    stop.step = leg.step;
    stop.vehicle = live.record.id;
    stop.station = station.id;
    stop.station_number = station.number;
    stop.mode = leg.mode;
    stop.theoretical = station.pose;
    stop.measured = found.pose;
    const plant::Deviation by = plant::deviation(station, found.pose);
    stop.dx_m = by.dx_m;
    stop.dy_m = by.dy_m;
    stop.dheading_rad = by.dheading_rad;
    stop.along_m = by.along_m;
    stop.left_m = by.left_m;
    stop.sigma_xy_m = found.sigma_xy_m;
    stop.sigma_heading_rad = found.sigma_heading_rad;
    stop.tolerance = station.tolerance;
    stop.inside = by.inside;
    stop.attempt = leg.attempt;
    stop.method = found.method;
    stop.markers = found.markers;
    stop.load_kg = live.state.load_kg;
    if (live.load) stop.load = live.load->id;
    stop.at = now;
    if (found.arrived) stop.arrival = arrival_of(live, station, *found.arrived);
    return stop;
}

/// After an unsuccessful approach: the step is tried again, or a person is asked.
void try_again(FleetState& fleet, LiveVehicle& live, Reason reason, Time now) {
    JobOrder* order = fleet.find(live.leg().order);
    const int attempt = live.leg().attempt;
    const int step = live.leg().step;
    end_leg(fleet, live, LegEnd::kAnotherApproach, now);
    if (!order) return;
    auto& current = order->steps[static_cast<std::size_t>(step)];
    current.state = StepState::kPending;
    current.attempts = attempt;
    fleet.store(*order);
    if (attempt >= kApproaches && order->state == JobState::kRunning) {
        current.attempts = 0;  // a person who resumes it grants new approaches
        set_order_state(fleet, *order, JobState::kInterrupted, std::move(reason), {}, now);
    }
}

}  // namespace

void handle_measured_stop(FleetState& fleet, LiveVehicle& live,
                          const vda5050::StopMeasurement& told, Time now) {
    const plant::Station* station = plant::find_station(fleet.plant, live.leg().station);
    if (!station) return;
    if (const char* fault = fault_of(fleet, live, *station, told.pose)) {
        return handle_failed_stop(fleet, live, fault, now);
    }
    vda5050::StopMeasurement found = told;
    found.pose.heading_rad = wrap(told.pose.heading_rad);
    if (found.arrived && fault_of(fleet, live, *station, *found.arrived)) found.arrived.reset();
    const StopRecord stop = stop_record(fleet, live, *station, found, now);
    fleet.out.records.stops.push_back(stop);
    live.record.pose = found.pose;
    live.record.pose_known = true;
    live.record.at_station = station->id;
    live.record.last_stop = stop.id;
    live.record.last_stop_station = station->id;
    live.record.last_stop_inside = stop.inside;
    live.record.basis = PoseBasis{PoseBasis::Kind::kStop, station->id, {}, now, 0};
    fleet.store(live);
    add_event(fleet, now, event::kStopMeasured, stop.order, stop.leg, stop.vehicle, {},
              {{"stop", stop.id.str()},
               {"station", static_cast<std::int64_t>(stop.station_number)},
               {"dx_m", stop.dx_m},
               {"dy_m", stop.dy_m},
               {"dheading_rad", stop.dheading_rad},
               {"inside", stop.inside},
               {"attempt", static_cast<std::int64_t>(stop.attempt)}});

    JobOrder* order = fleet.find(live.leg().order);
    if (order) {
        order->steps[static_cast<std::size_t>(stop.step)].stop = stop.id;
        fleet.store(*order);
    }
    if (!stop.inside) {
        try_again(fleet, live,
                  {"out_of_tolerance",
                   {{"station", static_cast<std::int64_t>(stop.station_number)},
                    {"dx_m", stop.dx_m},
                    {"dy_m", stop.dy_m},
                    {"dheading_rad", stop.dheading_rad}}},
                  now);
        return;
    }
    pass_stop(fleet, live, now);
    end_leg(fleet, live, LegEnd::kDone, now);
    if (!order) return;
    handle_good_stop(fleet, *order, static_cast<std::size_t>(stop.step), now);
}

void handle_failed_stop(FleetState& fleet, LiveVehicle& live, const std::string& why, Time now) {
    const Leg& leg = live.leg();
    const plant::Station* station = plant::find_station(fleet.plant, leg.station);
    const std::int64_t number = station ? station->number : 0;
    add_event(fleet, now, event::kStopNotMeasured, leg.order, leg.id, live.record.id, {},
              {{"station", number}, {"why", why}, {"attempt", std::int64_t{leg.attempt}}});
    try_again(fleet, live, {"stop_not_measured", {{"station", number}, {"why", why}}}, now);
}

}  // namespace pulseline::fleet
