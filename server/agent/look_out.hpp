#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "core/control/protective_fields.hpp"
#include "core/fleet/state/vehicle_messages.hpp"
#include "core/simulation/drive.hpp"
#include "core/simulation/lidar.hpp"
#include "core/simulation/world.hpp"

namespace pulseline::agent {

/// The vehicle's scanners and the fields that follow its motion: beside something it drives slower,
/// before something it stops and waits until that is gone. Not a safety function, as little as the
/// fields are.
class LookOut {
public:
    static constexpr const char* kObstacle = "obstacle";  // type of the error it reports

    /// Two scanners at opposite corners of the vehicle that see the walls and obstacles of its hall
    /// and what put() places. `drive` is slowed down by it and must outlive it.
    LookOut(const simulation::World& world, const plant::Vehicle& vehicle,
            const plant::HallId& hall, simulation::Drive& drive, std::uint64_t seed);

    /// Something not in the drawing, hall frame.
    void put(geometry::Polygon obstacle) { others_.push_back(std::move(obstacle)); }
    void take_away() { others_.clear(); }
    /// The bodies of the vehicles near a place, as they truly stand now: asked at every look.
    using Neighbours = std::function<void(geometry::Point2, std::vector<geometry::Polygon>&)>;
    void see(Neighbours neighbours) { neighbours_ = std::move(neighbours); }

    /// Before what bars its run it stops with room to swing out, instead of driving up to it as
    /// near as the fields let it: for a vehicle that may go round.
    void keep_room(bool keeps) { keeps_room_ = keeps; }
    /// Bars the way as the fields do, while somebody knows of something that they do not see.
    void bar(bool bars) { told_to_bar_ = bars; }
    void step(double dt_s);
    bool barred() const { return barred_; }
    /// The last look, one scan a scanner, and how many there have been. While nothing moves nor
    /// wants to, it does not look.
    const std::vector<control::Scan>& scans() const { return scans_; }
    std::size_t looks() const { return looks_; }
    /// True once after it began or ended to bar the way.
    bool take_changed();
    /// Field, and what is in the way.
    void write_state(fleet::StateMessage& state) const;

private:
    kinematics::Twist start_twist() const;
    kinematics::Twist intended() const;
    double stopping_m(const kinematics::Twist& twist) const;
    control::FieldAnswer check(const kinematics::Twist& twist);
    control::FieldAnswer look();

    simulation::Drive& drive_;
    std::vector<simulation::Lidar> scanners_;
    std::vector<control::Scan> scans_;
    std::vector<control::ProtectiveFields> fields_;  // one for each convex piece of the outline
    std::vector<geometry::Polygon> others_;
    Neighbours neighbours_;
    std::vector<geometry::Polygon> seen_;  // by the last look, beside what stands for good
    std::mt19937_64 random_;
    control::FieldAnswer last_;
    std::size_t looks_ = 0;
    double until_scan_s_ = 0;
    double free_for_s_ = 0;
    bool keeps_room_ = false;
    bool told_to_bar_ = false;
    bool barred_ = false;
    bool changed_ = false;
};

}  // namespace pulseline::agent
