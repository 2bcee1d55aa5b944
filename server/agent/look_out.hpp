#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "core/control/protective_fields.hpp"
#include "core/fleet/vehicle_messages.hpp"
#include "core/simulation/drive.hpp"
#include "core/simulation/lidar.hpp"
#include "core/simulation/world.hpp"

namespace pulseline::agent {

/// The vehicle's scanners and the fields that follow its motion: beside something it drives slower,
/// before something it stops and waits until that is gone. Not a safety function, as little as the
/// fields are.
class LookOut {
public:
    /// Two scanners at opposite corners of the vehicle that see the walls and obstacles of its hall
    /// and what put() places. `drive` is slowed down by it and must outlive it.
    LookOut(const simulation::World& world, const plant::Vehicle& vehicle,
            const plant::HallId& hall, simulation::Drive& drive, std::uint64_t seed);

    /// Something not in the drawing, hall frame.
    void put(geometry::Polygon obstacle) { others_.push_back(std::move(obstacle)); }
    void take_away() { others_.clear(); }

    void step(double dt_s);
    /// True once after it began or ended to bar the way.
    bool take_changed();
    /// Field, and what is in the way.
    void write_state(fleet::StateMessage& state) const;

private:
    kinematics::Twist intended() const;
    control::FieldAnswer look();

    simulation::Drive& drive_;
    std::vector<simulation::Lidar> scanners_;
    std::vector<control::Scan> scans_;
    std::vector<control::ProtectiveFields> fields_;  // one for each convex piece of the outline
    std::vector<geometry::Polygon> others_;
    std::mt19937_64 random_;
    control::FieldAnswer last_;
    double until_scan_s_ = 0;
    double free_for_s_ = 0;
    bool barred_ = false;
    bool changed_ = false;
};

}  // namespace pulseline::agent
