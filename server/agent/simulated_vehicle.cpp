#include "server/agent/simulated_vehicle.hpp"

#include <utility>

#include "core/simulation/machine/vehicle_motion.hpp"
#include "server/agent/utc.hpp"

namespace pulseline::agent {
namespace {

using namespace std::chrono_literals;

constexpr auto kTruthInterval = 50ms;

plant::VehicleType as_loaded(plant::VehicleType type, bool loaded) {
    type.cameras = plant::cameras_of(type, loaded);
    return type;
}

VehicleSettings known_beforehand(const simulation::World& world, const plant::Vehicle& vehicle,
                                 const plant::VehicleType& type, const SimulationSettings& settings,
                                 SimulatedVehicle::Program program) {
    VehicleSettings known;
    known.hall = plant::find_station(world.plant, vehicle.home)->hall;
    known.errors = world.errors;
    known.odometry = drives_by_wheels(type, settings)
                         ? localisation::odometry_noise(world.errors.drive, type)
                         : simulation::odometry_noise(simulation::MotionErrors{});
    known.loaded = plant::first_load(world.plant, vehicle.id) != nullptr;
    known.vehicles = program.vehicles;
    known.learned = std::move(program.learned);
    known.map = std::move(program.map);
    known.particles_seed = simulation::seed_for(settings.seed, "particles " + vehicle.id.str());
    return known;
}

}  // namespace

SimulatedVehicle::SimulatedVehicle(const simulation::World& world, const plant::Vehicle& vehicle,
                                   const geometry::Pose2& true_pose, SimulationSettings settings,
                                   Program program, TruthLog* truth)
    : type_(as_loaded(*plant::find_vehicle_type(world.plant, vehicle.type),
                      plant::first_load(world.plant, vehicle.id) != nullptr)),
      machine_(world, vehicle, type_, true_pose, settings),
      program_(vehicle, type_, machine_,
               known_beforehand(world, vehicle, type_, settings, std::move(program))),
      truth_(truth) {}

void SimulatedVehicle::step(double dt_s, Vehicle::Steady::time_point now) {
    if (machine_.apply_faults(dt_s)) program_.tell_soon();
    program_.step(dt_s, now);
    write_truth(now);
}

void SimulatedVehicle::write_truth(Vehicle::Steady::time_point now) {
    if (truth_ == nullptr) return;
    const onboard::Executor& executor = program_.executor();
    const onboard::PoseEstimate& estimate = program_.estimate();
    TruthLine line{program_.plant_vehicle().id.str(),
                   machine_.true_pose(),
                   !program_.standing(),
                   executor.order_id(),
                   executor.last_node_sequence_id(),
                   executor.base_end_sequence_id(),
                   {estimate.pose(), estimate.sigma_xy_m(), estimate.sigma_heading_rad()}};
    const TruthLine& last = last_truth_line_;
    const bool told = line.moving == last.moving && line.order_id == last.order_id &&
                      line.last_node_seq == last.last_node_seq &&
                      line.base_end_seq == last.base_end_seq && line.vehicle == last.vehicle;
    const bool moved = !(line.pose == last.pose) && now - last_truth_ >= kTruthInterval;
    if (told && !moved) return;
    last_truth_ = now;
    last_truth_line_ = line;
    truth_->write(line, to_ns(utc_now()) / 1'000'000);
}

}  // namespace pulseline::agent
