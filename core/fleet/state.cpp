#include "core/fleet/state.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::fleet {
namespace {

constexpr double kAtStation_m = 0.25;
constexpr double kAtStation_rad = 3.0 * kPi / 180.0;

/// Reasons are the same wait while their code and names stay; numbers in them may drift.
bool same_wait(const Reason& a, const Reason& b) {
    if (a.code != b.code) return false;
    const auto names = [](const Reason& reason) {
        std::vector<std::string> found;
        for (const auto& param : reason.params) {
            if (const auto* text = std::get_if<std::string>(&param.value)) found.push_back(*text);
        }
        return found;
    };
    return names(a) == names(b);
}

}  // namespace

void add_event(FleetState& fleet, Time now, std::string type, JobOrderId order, LegId leg,
               const plant::VehicleId& vehicle, const std::string& actor, Params params) {
    fleet.out.records.events.push_back(
        {++fleet.event_seq, now, std::move(type), order, leg, vehicle, actor, std::move(params)});
}

void set_order_state(FleetState& fleet, JobOrder& order, JobState to, Reason reason,
                     const std::string& actor, Time now) {
    const JobState from = order.state;
    order.state = to;
    order.reason = std::move(reason);
    if (to == JobState::kRunning && order.started == Time{}) order.started = now;
    if (to != JobState::kRunning) order.expected.reset();
    if (is_final(to)) {
        order.ended = now;
        fleet.orders.close(order);
    }
    Params params{{"from", to_string(from)}, {"to", to_string(to)}};
    if (!order.reason.code.empty()) params.push_back({"reason", order.reason.code});
    for (const auto& param : order.reason.params) params.push_back(param);
    add_event(fleet, now, "job_order.state", order.id, {}, order.assigned_vehicle, actor,
              std::move(params));
    fleet.store(order);
}

void set_order_reason(FleetState& fleet, JobOrder& order, Reason reason, Time now) {
    if (same_wait(order.reason, reason)) return;
    order.reason = std::move(reason);
    if (!order.reason.code.empty()) {
        order.expected.reset();  // until it goes on
        Params params{{"reason", order.reason.code}};
        for (const auto& param : order.reason.params) params.push_back(param);
        add_event(fleet, now, "job_order.waits", order.id, {}, order.assigned_vehicle, {},
                  std::move(params));
    }
    fleet.store(order);
}

Duration silence(const FleetState& fleet, const VehicleRun& run, Time now) {
    return now - run.last_heard.value_or(fleet.started);
}

double speed_share(const VehicleRun& run) {
    return run.factsheet && run.factsheet->speed_max_mps > 0
               ? run.factsheet->speed_max_mps / run.type->max_speed_mps
               : 1.0;
}

bool is_loaded(const VehicleRun& run) { return plant::is_loaded(*run.vehicle); }

std::vector<geometry::Polygon> outline_at(const VehicleRun& run, const Pose2& pose) {
    std::vector<geometry::Polygon> outline;
    for (const auto& piece : plant::outline_with_load(*run.type, is_loaded(run))) {
        outline.push_back(geometry::transformed(pose, piece));
    }
    return outline;
}

std::string hall_of(const FleetState& fleet, const VehicleRun& run) {
    if (run.has_leg()) return run.leg().hall;
    // Of a plant that had other halls it may not be one any more.
    const plant::HallId known(run.record.hall);
    if (plant::find_hall(fleet.plant, known)) return known.str();
    const auto* home = plant::find_station(fleet.plant, run.vehicle->home);
    if (home) return home->hall.str();
    return fleet.plant.halls.empty() ? std::string{} : fleet.plant.halls.front().id.str();
}

std::size_t hall_index(const FleetState& fleet, const std::string& hall) {
    return hall_index(fleet.plant, plant::HallId(hall));
}

plant::StationId station_at(const FleetState& fleet, const VehicleRun& run, const Pose2& pose) {
    const std::string hall = hall_of(fleet, run);
    for (const auto& station : fleet.plant.stations) {
        if (station.hall.str() != hall) continue;
        if (geometry::distance(pose.position(), station.pose.position()) < kAtStation_m &&
            std::abs(wrap(pose.heading_rad - station.pose.heading_rad)) < kAtStation_rad) {
            return station.id;
        }
    }
    return {};
}

std::vector<planning::StandingBody> standing_bodies(const FleetState& fleet,
                                                    const plant::HallId& hall,
                                                    const plant::VehicleId& except) {
    std::vector<planning::StandingBody> bodies;
    for (const auto& [id, run] : fleet.vehicles) {
        const auto& claim = run.record.claim;
        if (id == except || !(run.record.pose_known || claim)) continue;
        if (run.record.integration < Integration::kRespect) continue;
        if (claim && claim->hall == hall.str()) {
            bodies.push_back({id, outline_at(run, claim->pose)});
        }
        if (hall_of(fleet, run) != hall.str() || !has_stood(run.record)) continue;
        bodies.push_back({id, outline_at(run, run.record.pose)});
    }
    return bodies;
}

}  // namespace pulseline::fleet
