#include "core/fleet/vehicle/leg_request.hpp"

#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"

namespace pulseline::fleet {

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
