#include "server/agent/tcp_vehicle.hpp"

#include <utility>

namespace pulseline::agent {

Result<std::unique_ptr<TcpVehicle>> TcpVehicle::open(const MachineAddress& address,
                                                     const plant::Plant& plant,
                                                     const plant::Vehicle& vehicle,
                                                     TcpMachine::Settings settings,
                                                     const std::vector<CameraSource>& cameras,
                                                     VehicleSettings known) {
    const auto* type = plant::find_vehicle_type(plant, vehicle.type);
    if (type == nullptr) {
        return fail(Errc::kNotFound, "unknown_vehicle",
                    "vehicle " + vehicle.id.str() + " lacks its type");
    }
    std::unique_ptr<TcpVehicle> opened(new TcpVehicle);
    settings.loaded = plant::first_load(plant, vehicle.id) != nullptr;
    opened->type_ = *type;
    opened->type_.cameras = plant::cameras_of(*type, settings.loaded);
    known.errors = settings.errors;
    known.loaded = settings.loaded;
    known.odometry = localisation::odometry_noise(settings.errors.drive, opened->type_);
    auto sources = open_sources(cameras, opened->type_.cameras);
    if (!sources) return fail(sources.error());
    settings.sources = std::move(*sources);
    auto machine = TcpMachine::open(address, opened->type_, std::move(settings));
    if (!machine) return fail(machine.error());
    opened->machine_ = std::move(*machine);
    opened->program_ = std::make_unique<Vehicle>(vehicle, opened->type_, *opened->machine_, known);
    return opened;
}

}  // namespace pulseline::agent
