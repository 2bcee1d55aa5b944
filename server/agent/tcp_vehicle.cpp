#include "server/agent/tcp_vehicle.hpp"

#include <utility>

#include "server/agent/utc.hpp"

namespace pulseline::agent {
namespace {

using namespace std::chrono_literals;

constexpr auto kEvery = 50ms;

}  // namespace

Result<std::unique_ptr<TcpVehicle>> TcpVehicle::open(const MachineAddress& address,
                                                     const plant::Plant& plant,
                                                     const plant::Vehicle& vehicle,
                                                     TcpMachine::Settings settings,
                                                     const std::vector<CameraSource>& cameras,
                                                     VehicleSettings known, BeliefLog* log) {
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
    opened->log_ = log;
    return opened;
}

void TcpVehicle::step(double dt_s, Vehicle::Steady::time_point now) {
    program_->step(dt_s, now);
    if (log_ != nullptr) write_belief(now);
}

void TcpVehicle::write_belief(Vehicle::Steady::time_point now) {
    const onboard::Executor& executor = program_->executor();
    const onboard::PoseEstimate& estimate = program_->estimate();
    BeliefLine line{program_->plant_vehicle().id.str(),
                    {estimate.pose(), estimate.sigma_xy_m(), estimate.sigma_heading_rad()},
                    !program_->standing(),
                    executor.order_id(),
                    executor.last_node_sequence_id(),
                    executor.base_end_sequence_id(),
                    machine_->cycle()};
    const bool told = line.moving == told_.moving && line.order_id == told_.order_id &&
                      line.last_node_seq == told_.last_node_seq &&
                      line.base_end_seq == told_.base_end_seq && line.vehicle == told_.vehicle;
    const bool moved = !(line.believed.pose == told_.believed.pose) && now - told_at_ >= kEvery;
    if (told && !moved) return;
    log_->write(line, to_ns(utc_now()) / 1'000'000);
    told_ = std::move(line);
    told_at_ = now;
}

}  // namespace pulseline::agent
