#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "api/machine/frames.hpp"
#include "core/simulation/machine/drive_heat.hpp"
#include "core/simulation/machine/equipment.hpp"
#include "core/simulation/machine/wheels_on_floor.hpp"
#include "core/simulation/world/floor_camera.hpp"
#include "core/simulation/world/scanners.hpp"
#include "core/simulation/world/world.hpp"
#include "server/agent/options.hpp"

namespace pulseline::agent {

/// The controller of a simulated machine, as MACHINE.md says: frames in, frames out, no socket.
/// Thread safety: none. Deterministic: the same seed and frames give the same poses.
class SimulatedController {
public:
    struct Settings {
        std::uint64_t seed = 1;
        std::optional<double> battery_percent;  // absent: full enough
        bool dark = false;                      // no light below its cameras
        std::vector<Fault> faults;  // of wheels, cameras, scanners and what is in its way
    };

    /// `type`: with its cameras as they hang under its load. REQUIRES: a driven wheel. What it is
    /// made of must outlive it.
    SimulatedController(const simulation::World& world, const plant::Vehicle& vehicle,
                        const plant::VehicleType& type, const geometry::Pose2& true_pose,
                        const Settings& settings);

    /// Whether such a machine has such a fault.
    static bool has(Fault::Kind fault);

    /// What it answers, in order. A `Refused` is the last: the connection ends behind it.
    std::vector<machine::Frame> handle(const machine::Frame& frame);
    /// Time without a frame.
    void wait(double dt_s);
    /// Faults whose time has come.
    void apply_faults(double dt_s);
    /// The program has gone: what it had begun ends, and the next one says hello again.
    void part();

    /// What one of its cameras sees now. REQUIRES: it has it.
    cv::Mat render(std::size_t camera);
    const geometry::Pose2& true_pose() const { return wheels_.true_pose(); }
    bool braked() const { return braked_; }

private:
    machine::Description description() const;
    machine::Feedback feedback(std::uint32_t cycle);
    std::optional<std::string> drive(const machine::SetPoints& points);
    machine::Frame picture(const machine::Expose& expose);
    machine::Frame scans(const machine::Look& look);
    void apply(const Fault& fault);
    std::optional<machine::LiftEnded> begin(const machine::Lift& lift);
    void end_lift(std::vector<machine::Frame>& answers);
    void fall_in();

    const simulation::World& world_;
    const plant::VehicleType& type_;
    plant::HallId hall_;
    simulation::WheelsOnFloor wheels_;
    simulation::VehicleEquipment equipment_;
    std::vector<plant::Camera> cameras_;  // as they truly hang
    simulation::SimulatedScanners scanners_;
    std::vector<control::Scan> seen_;
    std::mt19937_64 random_;
    Settings settings_;
    double load_kg_;
    std::optional<machine::Hello> hello_;
    std::optional<std::uint32_t> lift_;  // under way
    bool braked_ = true;
    bool covered_ = false;  // the codes below
    double age_s_ = 0;
    double silent_s_ = 0;
    simulation::DriveHeat heat_;
};

}  // namespace pulseline::agent
