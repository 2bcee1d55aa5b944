#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/simulation/machine/equipment.hpp"
#include "core/simulation/machine/servo_drive.hpp"
#include "core/simulation/world/navigation_scanner.hpp"
#include "core/simulation/world/receivers.hpp"
#include "core/simulation/world/scanners.hpp"
#include "core/simulation/world/world.hpp"
#include "server/agent/body_status.hpp"
#include "server/agent/camera_sensing.hpp"
#include "server/agent/machine.hpp"
#include "server/agent/options.hpp"

namespace pulseline::agent {

struct SimulationSettings {
    std::uint64_t seed = 1;
    double time_factor = 1;
    bool rendered = true;
    std::optional<double> battery_percent;  // absent: by the seed
    bool servo_drive = false;  // wheel by wheel; a type without driven wheels stays statistical
    std::vector<Fault> faults;
};

/// True when the simulated machine of such settings drives wheel by wheel.
bool drives_by_wheels(const plant::VehicleType& type, const SimulationSettings& settings);

/// A simulated vehicle in its simulated hall: it truly stands somewhere, sees others and is seen,
/// and its faults come as they are asked for. `world` must outlive it.
class SimulatedMachine final : public Machine {
public:
    /// `type`: with its cameras as they hang under its load.
    SimulatedMachine(const simulation::World& world, const plant::Vehicle& vehicle,
                     const plant::VehicleType& type, const geometry::Pose2& true_pose,
                     SimulationSettings settings);

    onboard::Drive& drive() override { return *drive_; }
    Cameras& cameras() override { return cameras_; }
    onboard::Equipment& equipment() override { return equipment_; }
    onboard::Scanners* scanners() override { return scanners_ ? &*scanners_ : nullptr; }
    onboard::Receivers* receivers() override { return receivers_ ? &*receivers_ : nullptr; }
    onboard::NavigationScanner* navigation_scanner() override {
        return navigation_scanner_ ? &*navigation_scanner_ : nullptr;
    }
    void step(double dt_s) override;
    void write_state(vda5050::StateMessage& state) override;

    /// Faults whose time has come. True: there were some.
    bool apply_faults(double dt_s);
    const geometry::Pose2& true_pose() const { return drive_->true_pose(); }
    /// What its scanners see of the vehicles around it, and what they take of its light.
    void see(simulation::SimulatedScanners::Neighbours neighbours);
    /// Puts its body, load included, as it truly stands, to what others' scanners see.
    void show_body(const plant::HallId& hall, geometry::Point2 from,
                   std::vector<geometry::Polygon>& to) const;
    const plant::HallId& hall() const { return hall_; }

private:
    bool drives_fast() const;
    void apply(const Fault& fault);

    const plant::Vehicle& vehicle_;
    const plant::VehicleType& type_;
    const plant::HallId hall_;
    SimulationSettings settings_;
    std::unique_ptr<simulation::SimulatedDrive> drive_;
    CameraSensing cameras_;
    double load_kg_;
    simulation::VehicleEquipment equipment_;
    BodyStatus body_;
    // Who does not drive by its wheels sees nothing, and thousands of them cost nothing.
    std::optional<simulation::SimulatedScanners> scanners_;
    std::optional<simulation::SimulatedReceivers> receivers_;  // of a type that has them
    std::optional<simulation::SimulatedNavigationScanner> navigation_scanner_;  // the same
    double age_s_ = 0;
};

}  // namespace pulseline::agent
