#include "core/fleet/vehicle/whereabouts.hpp"

#include <cmath>

#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/body.hpp"

namespace pulseline::fleet {
namespace {

constexpr double kAtStation_m = 0.25;
constexpr double kAtStation_rad = 3.0 * kPi / 180.0;

}  // namespace

// It may have lost its pose since: it still stands where it was confirmed last.
bool has_stood(const VehicleRecord& record) {
    return record.pose_known || !record.at_station.empty() || !(record.pose == Pose2{});
}

std::string hall_of(const FleetState& fleet, const LiveVehicle& live) {
    if (live.has_leg()) return live.leg().hall;
    // Of a plant that had other halls it may not be one any more.
    const plant::HallId known(live.record.hall);
    if (plant::find_hall(fleet.plant, known)) return known.str();
    const auto* home = plant::find_station(fleet.plant, live.vehicle->home);
    if (home) return home->hall.str();
    return fleet.plant.halls.empty() ? std::string{} : fleet.plant.halls.front().id.str();
}

std::size_t hall_index(const FleetState& fleet, const std::string& hall) {
    return hall_index(fleet.plant, plant::HallId(hall));
}

plant::StationId station_at(const FleetState& fleet, const LiveVehicle& live, const Pose2& pose) {
    const std::string hall = hall_of(fleet, live);
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
    for (const auto& [id, live] : fleet.vehicles) {
        const auto& claim = live.record.claim;
        if (id == except || !(live.record.pose_known || claim)) continue;
        if (live.record.integration < Integration::kRespect) continue;
        if (claim && claim->hall == hall.str()) {
            bodies.push_back({id, outline_at(live, claim->pose)});
        }
        if (hall_of(fleet, live) != hall.str() || !has_stood(live.record)) continue;
        bodies.push_back({id, outline_at(live, live.record.pose)});
    }
    return bodies;
}

bool is_in_doubt(const LiveVehicle& live) { return live.record.claim.has_value(); }

bool is_in_hall(const FleetState& fleet, const Whereabouts& where) {
    const auto* hall = plant::find_hall(fleet.plant, plant::HallId(where.hall));
    if (!hall) return false;
    // First what no arithmetic with the outline would survive.
    const geometry::Point2 at = where.pose.position();
    const geometry::Box box = geometry::bounding_box(hall->outline);
    const bool about = at.x_m >= box.min.x_m && at.x_m <= box.max.x_m && at.y_m >= box.min.y_m &&
                       at.y_m <= box.max.y_m;
    return about && geometry::contains(hall->outline, at);
}

}  // namespace pulseline::fleet
