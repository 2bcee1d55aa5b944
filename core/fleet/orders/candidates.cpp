#include "core/fleet/orders/candidates.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/fleet/orders/order_loads.hpp"
#include "core/fleet/orders/start_conditions.hpp"
#include "core/fleet/vehicle/link.hpp"
#include "core/fleet/vehicle/readiness.hpp"

namespace pulseline::fleet {
namespace {

constexpr std::size_t kPlannedOfType = 8;  // vehicles that may be given an order nobody is named in
constexpr double kUnknownAway_m = 1e6;     // of one whose place is not known: behind all others

bool announces_all(const NewOrder& order, const LiveVehicle& live) {
    const auto announced = [&](const StepAction& action) {
        return announces_at_node(live, action);
    };
    return std::ranges::all_of(order.steps, [&](const NewStep& step) {
        return std::ranges::all_of(step.before, announced) &&
               std::ranges::all_of(step.after, announced);
    });
}

/// The last station of all that vehicles have to do besides the order itself, with one look at the
/// open orders.
using LastStations = std::map<plant::VehicleId, plant::StationId>;

LastStations last_stations(const FleetState& fleet, JobOrderId self) {
    LastStations last;
    for (const JobOrderId& id : fleet.orders.open()) {
        if (id == self) continue;
        const JobOrder& order = *fleet.find(id);
        for (const auto* vehicle : {&order.wanted_vehicle, &order.assigned_vehicle}) {
            if (!vehicle->empty()) last[*vehicle] = order.steps.back().station;
        }
    }
    return last;
}

std::optional<Pose2> pose_after(const FleetState& fleet, const LiveVehicle& live,
                                const LastStations& last) {
    const auto found = last.find(live.record.id);
    if (found != last.end()) {
        if (const auto* station = plant::find_station(fleet.plant, found->second)) {
            return station->pose;
        }
    }
    return live.record.pose_known ? std::optional(live.record.pose) : std::nullopt;
}

}  // namespace

bool is_candidate(const FleetState& fleet, const NewOrder& order, const LiveVehicle& live) {
    if (!order.vehicle.empty() && order.vehicle != live.record.id) return false;
    if (!order.vehicle_type.empty() && order.vehicle_type != live.type->id) return false;
    const auto bound = fleet.orders.vehicle_of_sequence(order.sequence);
    return bound.empty() || bound == live.record.id;
}

bool may_stop_at(const plant::Station& station, const LiveVehicle& live) {
    const auto& types = station.vehicle_types;
    return types.empty() || std::ranges::find(types, live.type->id) != types.end();
}

bool is_gone(const FleetState& fleet, const LiveVehicle& live, Time now) {
    return silence(fleet, live, now) >= kGoneAfter;
}

std::optional<Pose2> future_pose(const FleetState& fleet, const LiveVehicle& live,
                                 JobOrderId self) {
    return pose_after(fleet, live, last_stations(fleet, self));
}

std::vector<Candidate> nearest_of_each_type(const FleetState& fleet, const NewOrder& order,
                                            const Pose2& goal, JobOrderId self, Time now) {
    const LastStations last = last_stations(fleet, self);
    std::map<plant::VehicleTypeId, std::vector<std::pair<double, Candidate>>> by_type;
    for (const auto& [id, live] : fleet.vehicles) {
        if (is_gone(fleet, live, now) || !is_candidate(fleet, order, live)) continue;
        if (live.record.integration != Integration::kUtilise || !announces_all(order, live) ||
            cannot_carry_all(fleet, order, live))
            continue;
        const auto pose = pose_after(fleet, live, last);
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

}  // namespace pulseline::fleet
