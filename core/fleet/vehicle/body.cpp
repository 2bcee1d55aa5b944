#include "core/fleet/vehicle/body.hpp"

#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {

double speed_share(const LiveVehicle& live) {
    return live.factsheet && live.factsheet->speed_max_mps > 0
               ? live.factsheet->speed_max_mps / live.type->max_speed_mps
               : 1.0;
}

bool is_loaded(const LiveVehicle& live) { return live.load != nullptr; }

std::vector<geometry::Polygon> outline_at(const LiveVehicle& live, const Pose2& pose) {
    std::vector<geometry::Polygon> outline;
    for (const auto& piece : plant::outline_with_load(*live.type, is_loaded(live))) {
        outline.push_back(geometry::transformed(pose, piece));
    }
    return outline;
}

double speed_of(const LiveVehicle& live) {
    return live.factsheet && live.factsheet->speed_max_mps > 0 ? live.factsheet->speed_max_mps
                                                               : live.type->max_speed_mps;
}

double accel_of(const LiveVehicle& live) {
    return live.factsheet && live.factsheet->acceleration_max_mps2 > 0
               ? live.factsheet->acceleration_max_mps2
               : live.type->max_accel_mps2;
}

}  // namespace pulseline::fleet
