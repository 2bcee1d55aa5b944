#include "core/fleet/vehicle/leg_request.hpp"

#include <cmath>

#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"

namespace pulseline::fleet {
namespace {

// Near enough that the cameras see the codes and the vehicle only has to correct its stop. Well
// inside what a correction reaches (our agents: 0.1 m and 1 deg): one that is refused as too far
// would be asked for again and again, where a leg gets there.
constexpr double kNearlyThere_m = 0.06;
constexpr double kNearlyThere_rad = radians(0.8);

}  // namespace

bool nearly_there(const LiveVehicle& live, const Pose2& pose, const plant::Station& station) {
    const Pose2 off = geometry::inverse(station.pose) * pose;
    const bool in_place = std::hypot(off.x_m, off.y_m) < 1e-3 && std::abs(off.heading_rad) < 1e-4;
    const bool by_codes = !station.markers.empty() && !live.type->cameras.empty();
    const bool correctable = by_codes || !live.type->receivers.empty();
    return in_place || (correctable && std::hypot(off.x_m, off.y_m) < kNearlyThere_m &&
                        std::abs(off.heading_rad) < kNearlyThere_rad);
}

double least_drive_s(const LiveVehicle& live, const Pose2& from, const plant::Station& to) {
    return geometry::distance(from.position(), to.pose.position()) / live.type->max_speed_mps;
}

planning::LegRequest leg_request(const FleetState& fleet, const LiveVehicle& live,
                                 const Pose2& start, const plant::StationId& target,
                                 plant::MotionMode mode) {
    planning::LegRequest request;
    request.type = live.type;
    request.loaded = is_loaded(live);
    request.hall = plant::HallId(hall_of(fleet, live));
    request.start = start;
    request.from_station = station_at(fleet, live, start);
    request.target = target;
    request.mode = mode;
    return request;
}

}  // namespace pulseline::fleet
