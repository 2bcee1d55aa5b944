#include "server/agent/simulated_machine.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "core/simulation/machine/vehicle_motion.hpp"
#include "server/agent/hall_truth.hpp"
#include "server/base/log.hpp"

namespace pulseline::agent {
namespace {

constexpr double kSeen_m = 50;  // a scanner's range and two long bodies

double first_charge(const plant::Vehicle& vehicle, const SimulationSettings& settings) {
    if (settings.battery_percent) return *settings.battery_percent;
    std::mt19937_64 random(simulation::seed_for(settings.seed, "battery " + vehicle.id.str()));
    return std::uniform_real_distribution<double>(82, 98)(random);
}

std::unique_ptr<simulation::SimulatedDrive> make_drive(
    const plant::VehicleType& type, const plant::Vehicle& vehicle, const geometry::Pose2& true_pose,
    double load_kg, const SimulationSettings& settings, const localisation::ErrorBudget& errors) {
    const auto seed = simulation::seed_for(settings.seed, "motion " + vehicle.id.str());
    if (drives_by_wheels(type, settings)) {
        return std::make_unique<simulation::ServoDrive>(type, true_pose, seed, settings.time_factor,
                                                        load_kg, errors);
    }
    return std::make_unique<simulation::VehicleMotion>(type, true_pose, seed, settings.time_factor);
}

}  // namespace

bool drives_by_wheels(const plant::VehicleType& type, const SimulationSettings& settings) {
    return settings.servo_drive &&
           std::any_of(type.wheels.begin(), type.wheels.end(),
                       [](const plant::Wheel& wheel) { return wheel.driven; });
}

SimulatedMachine::SimulatedMachine(const simulation::World& world, const plant::Vehicle& vehicle,
                                   const plant::VehicleType& type, const geometry::Pose2& true_pose,
                                   SimulationSettings settings)
    : vehicle_(vehicle),
      type_(type),
      hall_(plant::find_station(world.plant, vehicle.home)->hall),
      settings_(std::move(settings)),
      drive_(make_drive(type_, vehicle, true_pose, first_load_kg(world.plant, vehicle), settings_,
                        world.errors)),
      cameras_(world, hall_, *drive_, settings_.rendered,
               simulation::seed_for(settings_.seed, "eyes " + vehicle.id.str()),
               plant::first_load(world.plant, vehicle.id) != nullptr),
      load_kg_(first_load_kg(world.plant, vehicle)),
      equipment_(type_, drive_->true_pose(), charger_contacts(world.plant),
                 first_charge(vehicle, settings_), settings_.time_factor, load_kg_,
                 simulation::seed_for(settings_.seed, "body " + vehicle.id.str())),
      body_(*drive_) {
    const auto seed = [&](const char* part) {
        return simulation::seed_for(settings_.seed, part + (" " + vehicle.id.str()));
    };
    equipment_.work_below(world.supports, hall_, carried_at_first(world.plant, vehicle));
    const auto& stands = drive_->true_pose();
    if (!type_.receivers.empty()) {
        receivers_.emplace(world, hall_, type_, stands, seed("receivers"));
    }
    if (type_.navigation_scanner) {
        navigation_scanner_.emplace(world, hall_, type_, stands, seed("navigation scanner"));
    }
    if (settings_.servo_drive && !type_.scanners.empty()) {
        scanners_.emplace(world, hall_, type_, stands, seed("scanners"));
    }
}

void SimulatedMachine::step(double dt_s) {
    body_.step(dt_s);
    for (std::size_t i = 0; i < type_.wheels.size(); ++i) {
        drive_->set_hot(i, body_.heat().is_off(i));
    }
    equipment_.step(dt_s, std::abs(drive_->velocity_mps()) * dt_s);
    if (std::exchange(load_kg_, equipment_.load_kg()) != load_kg_) drive_->set_load(load_kg_);
}

void SimulatedMachine::write_state(vda5050::StateMessage& state) {
    body_.write_state(state);
    equipment_.write_state(state);
}

void SimulatedMachine::see(simulation::SimulatedScanners::Neighbours neighbours) {
    if (receivers_) receivers_->see(neighbours);
    if (navigation_scanner_) navigation_scanner_->see(neighbours);
    if (scanners_) scanners_->see(std::move(neighbours));
}

void SimulatedMachine::show_body(const plant::HallId& hall, geometry::Point2 from,
                                 std::vector<geometry::Polygon>& to) const {
    const auto& pose = drive_->true_pose();
    if (hall != hall_ || distance(pose.position(), from) > kSeen_m) return;
    for (const auto& piece : plant::outline_with_load(type_, load_kg_ > 0)) {
        to.push_back(geometry::transformed(pose, piece));
    }
}

bool SimulatedMachine::drives_fast() const {
    return std::abs(drive_->velocity_mps()) > type_.max_speed_mps * drive_->time_factor() / 2;
}

bool SimulatedMachine::apply_faults(double dt_s) {
    age_s_ += dt_s;
    const auto due = std::erase_if(settings_.faults, [&](const Fault& fault) {
        const bool waits = fault.driving && !drives_fast();
        if (age_s_ < fault.after_s || waits) return false;
        apply(fault);
        return true;
    });
    return due > 0;
}

void SimulatedMachine::apply(const Fault& fault) {
    auto* servo = dynamic_cast<simulation::ServoDrive*>(drive_.get());
    bool known = true;
    switch (fault.kind) {
        case Fault::Kind::kMarkerLost:
            return cameras_.cover();
        case Fault::Kind::kDark:
            return cameras_.darken();
        case Fault::Kind::kObstacle:
            if (scanners_) scanners_->put(thing_at(fault.place));
            return;
        case Fault::Kind::kWayFree:
            if (!scanners_) return;
            scanners_->take_away();
            return scanners_->clean();
        case Fault::Kind::kLookOutCovered:
            if (scanners_) scanners_->cover();
            return;
        case Fault::Kind::kTransmitterDark:
            if (receivers_) receivers_->cover(plant::TransmitterId(fault.part));
            return;
        case Fault::Kind::kCarried:
            return drive_->carry(fault.carried);
        case Fault::Kind::kScannerCovered:
            if (navigation_scanner_) navigation_scanner_->cover();
            return;
        case Fault::Kind::kWheel:
            body_.break_wheel(fault.part);
            if (servo != nullptr) known = servo->break_wheel(fault.part);
            break;
        case Fault::Kind::kBearing:
            known = body_.seize_bearing(fault.part);
            break;
        case Fault::Kind::kBracketOff:
            known = equipment_.displace_bracket(fault.part, fault.by_m);
            break;
        case Fault::Kind::kPit:
            known = equipment_.dig_below(fault.part);
            break;
        case Fault::Kind::kSlip:
            known = servo != nullptr && servo->set_slip(fault.part, fault.share);
            break;
        case Fault::Kind::kEncoder:
            known = servo != nullptr && servo->kill_encoder(fault.part);
            break;
    }
    if (!known)
        server::log::warn("fault.unknown_part",
                          {{"vehicle", vehicle_.id.str()}, {"part", fault.part}});
}

}  // namespace pulseline::agent
