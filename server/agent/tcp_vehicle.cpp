#include "server/agent/tcp_vehicle.hpp"

#include <utility>

namespace pulseline::agent {

Result<std::unique_ptr<TcpVehicle>> TcpVehicle::open(
    const MachineAddress& address, const plant::Plant& plant, const plant::Vehicle& vehicle,
    double time_factor, const localisation::ErrorBudget& errors, VehicleSettings known) {
    const auto* type = plant::find_vehicle_type(plant, vehicle.type);
    if (type == nullptr) {
        return fail(Errc::kNotFound, "unknown_vehicle",
                    "vehicle " + vehicle.id.str() + " lacks its type");
    }
    std::unique_ptr<TcpVehicle> opened(new TcpVehicle);
    const bool loaded = plant::first_load(plant, vehicle.id) != nullptr;
    opened->type_ = *type;
    opened->type_.cameras = plant::cameras_of(*type, loaded);
    auto machine = TcpMachine::open(address, opened->type_, {time_factor, loaded, errors});
    if (!machine) return fail(machine.error());
    opened->machine_ = std::move(*machine);
    known.errors = errors;
    known.loaded = loaded;
    known.odometry = localisation::odometry_noise(errors.drive, opened->type_);
    opened->program_ = std::make_unique<Vehicle>(vehicle, opened->type_, *opened->machine_, known);
    return opened;
}

}  // namespace pulseline::agent
