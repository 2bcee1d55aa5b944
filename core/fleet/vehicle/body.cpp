#include "core/fleet/vehicle/body.hpp"

#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {

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

double speed_of(const VehicleRun& run) {
    return run.factsheet && run.factsheet->speed_max_mps > 0 ? run.factsheet->speed_max_mps
                                                             : run.type->max_speed_mps;
}

double accel_of(const VehicleRun& run) {
    return run.factsheet && run.factsheet->acceleration_max_mps2 > 0
               ? run.factsheet->acceleration_max_mps2
               : run.type->max_accel_mps2;
}

}  // namespace pulseline::fleet
