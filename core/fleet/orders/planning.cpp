#include "core/fleet/orders/planning.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/fleet/legs/leg_plans.hpp"
#include "core/fleet/orders/checks.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/leg_request.hpp"
#include "core/fleet/vehicle/link.hpp"
#include "core/fleet/vehicle/readiness.hpp"

namespace pulseline::fleet {
namespace {

// Near enough that the cameras see the codes and the vehicle only has to correct its stop. Well
// inside what a correction reaches (our agents: 0.1 m and 1 deg): one that is refused as too far
// would be asked for again and again, where a leg gets there.
constexpr double kNearlyThere_m = 0.06;
constexpr double kNearlyThere_rad = radians(0.8);
constexpr std::size_t kPlannedOfType = 8;  // vehicles that may be given an order nobody is named in
constexpr double kUnknownAway_m = 1e6;     // of one whose place is not known: behind all others

std::string step_field(std::size_t step, const char* name) {
    return "/steps/" + std::to_string(step) + "/" + name;
}

bool may_stop_at(const plant::Station& station, const plant::VehicleType& type) {
    return station.vehicle_types.empty() ||
           std::find(station.vehicle_types.begin(), station.vehicle_types.end(), type.id) !=
               station.vehicle_types.end();
}

/// The last station of all that vehicles have to do, with one look at the open orders.
using LastStations = std::map<plant::VehicleId, plant::StationId>;

LastStations last_stations(const FleetState& fleet) {
    LastStations last;
    for (const JobOrderId& id : fleet.orders.open()) {
        const JobOrder& order = *fleet.find(id);
        for (const auto* vehicle : {&order.wanted_vehicle, &order.assigned_vehicle}) {
            if (!vehicle->empty()) last[*vehicle] = order.steps.back().station;
        }
    }
    return last;
}

/// Where the vehicle will stand when all it has to do is done; nullopt: nobody knows.
std::optional<Pose2> future_pose(const FleetState& fleet, const LiveVehicle& live,
                                 const LastStations& last) {
    const auto found = last.find(live.record.id);
    if (found != last.end()) {
        if (const auto* station = plant::find_station(fleet.plant, found->second)) {
            return station->pose;
        }
    }
    return live.record.pose_known ? std::optional(live.record.pose) : std::nullopt;
}

Result<OrderPlan> plan_with(const FleetState& fleet, const NewOrder& order,
                            const Stations& stations, const LiveVehicle& live,
                            std::optional<Pose2> pose, FreeManoeuvres free) {
    OrderPlan plan;
    plan.vehicle = live.record.id;
    for (std::size_t i = 0; i < order.steps.size(); ++i) {
        const plant::Station* station = stations[i];
        if (!may_stop_at(*station, *live.type)) {
            return fail(
                Errc::kUnreachable, "station_not_for_type",
                "Station " + std::to_string(station->number) + " is not for vehicles of type " +
                    live.type->name + ". Choose another station or vehicle.",
                step_field(i, "station"),
                {{"station", std::int64_t{station->number}}, {"vehicle_type", live.type->name}});
        }
        plan.starts.push_back(pose.value_or(Pose2{}));
        plan.legs.emplace_back();
        plan.durations_s.push_back(0);
        if (pose && !nearly_there(live, *pose, *station)) {
            auto request = leg_request(fleet, live, *pose, station->id, order.steps[i].mode);
            auto leg = free == FreeManoeuvres::kPlanned ? fleet.planner.plan_leg(request)
                                                        : plan_here(fleet, request);
            const bool beside = !leg && leg.error().code == Errc::kNeedsPlan;
            if (beside && order.planned_beside) {
                plan.durations_s.back() = least_drive_s(live, *pose, *station);
                pose = station->pose;
                continue;
            }
            if (!leg) {
                Error error = leg.error();
                if (error.field.empty()) {
                    error.field = step_field(i, order.steps[i].mode == plant::MotionMode::kAuto
                                                    ? "station"
                                                    : "motion_mode");
                }
                return fail(std::move(error));
            }
            plan.durations_s.back() = leg->duration_s;
            plan.legs.back() = PlannedLeg{std::move(request), std::move(*leg)};
        }
        pose = station->pose;
    }
    return plan;
}

bool is_gone(const FleetState& fleet, const LiveVehicle& live, Time now) {
    return silence(fleet, live, now) >= kGoneAfter;
}

struct Candidate {
    const LiveVehicle* live = nullptr;
    std::optional<Pose2> pose;  // from where it would come
};

/// Those that are worth a plan, by name: with a thousand vehicles a plan of each takes seconds.
std::vector<Candidate> nearest_of_each_type(const FleetState& fleet, const NewOrder& order,
                                            const Pose2& goal, Time now) {
    const LastStations last = last_stations(fleet);
    std::map<plant::VehicleTypeId, std::vector<std::pair<double, Candidate>>> by_type;
    for (const auto& [id, live] : fleet.vehicles) {
        if (is_gone(fleet, live, now) || !may_have(fleet, order, live)) continue;
        if (live.record.integration != Integration::kUtilise) continue;
        const auto pose = future_pose(fleet, live, last);
        const double away_m =
            pose ? geometry::distance(pose->position(), goal.position()) : kUnknownAway_m;
        by_type[live.type->id].push_back({away_m, {&live, pose}});
    }
    std::vector<Candidate> nearest;
    for (auto& [type, all] : by_type) {
        std::ranges::stable_sort(all, {}, [](const auto& one) { return one.first; });
        if (all.size() > kPlannedOfType) all.resize(kPlannedOfType);
        for (auto& [away_m, candidate] : all) nearest.push_back(candidate);
    }
    std::ranges::sort(nearest, {}, [](const Candidate& one) -> const plant::VehicleId& {
        return one.live->record.id;
    });
    return nearest;
}

}  // namespace

bool nearly_there(const LiveVehicle& live, const Pose2& pose, const plant::Station& station) {
    const Pose2 off = geometry::inverse(station.pose) * pose;
    const bool in_place = std::hypot(off.x_m, off.y_m) < 1e-3 && std::abs(off.heading_rad) < 1e-4;
    const bool correctable = !station.markers.empty() && !live.type->cameras.empty();
    return in_place || (correctable && std::hypot(off.x_m, off.y_m) < kNearlyThere_m &&
                        std::abs(off.heading_rad) < kNearlyThere_rad);
}

double least_drive_s(const LiveVehicle& live, const Pose2& from, const plant::Station& to) {
    return geometry::distance(from.position(), to.pose.position()) / live.type->max_speed_mps;
}

Result<OrderPlan> plan_order(const FleetState& fleet, const NewOrder& order,
                             const Stations& stations, Time now, FreeManoeuvres free) {
    if (!order.vehicle.empty()) {
        const LiveVehicle* live = fleet.find(order.vehicle);
        if (is_gone(fleet, *live, now)) {
            return fail(Errc::kConflict, reasons::kVehicleGone,
                        "Vehicle " + order.vehicle.str() +
                            " has been silent for more than 60 s. Bring it back or choose another.",
                        "/vehicle",
                        {{"vehicle", order.vehicle.str()},
                         {"silent_s", seconds(silence(fleet, *live, now))}});
        }
        if (live->record.integration != Integration::kUtilise) {
            return fail(
                Errc::kConflict, "not_integrated",
                "Vehicle " + order.vehicle.str() + " is taken out (" +
                    to_string(live->record.integration) +
                    "). Set its integration to utilise or choose another.",
                "/vehicle",
                {{"vehicle", order.vehicle.str()}, {"level", to_string(live->record.integration)}});
        }
        return plan_with(fleet, order, stations, *live,
                         future_pose(fleet, *live, last_stations(fleet)), free);
    }
    // Any vehicle: the one that gets there soonest; the reason of the nearest miss when none can.
    std::optional<OrderPlan> best;
    double best_s = 0;
    std::optional<Error> why_not;
    for (const auto& [live, pose] :
         nearest_of_each_type(fleet, order, stations.front()->pose, now)) {
        auto plan = plan_with(fleet, order, stations, *live, pose, free);
        if (!plan) {
            // One that only a plan beside the fleet can judge is not refused for another's reason.
            if (!why_not || plan.error().code == Errc::kNeedsPlan) why_not = plan.error();
            continue;
        }
        double time_s = 0;
        for (const double leg_s : plan->durations_s) time_s += leg_s;
        if (!best || time_s < best_s) {
            best = std::move(*plan);
            best_s = time_s;
        }
    }
    if (best) return std::move(*best);
    if (why_not) return fail(*why_not);
    return fail(Errc::kConflict, reasons::kNoVehicle,
                "No vehicle that this order may have has been heard in the last 60 s. Connect one, "
                "then repeat.",
                "/vehicle");
}

}  // namespace pulseline::fleet
