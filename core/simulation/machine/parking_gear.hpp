#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/geometry/pose2.hpp"
#include "core/plant/plant.hpp"
#include "core/simulation/machine/resting_body.hpp"
#include "core/simulation/machine/servo_axis.hpp"

namespace pulseline::simulation {

/// Height of the floor in m under a place of the body, above where its wheels stand on even floor;
/// nothing: there is none, as over a pit.
using FloorUnder = std::function<std::optional<double>(geometry::Point2 body)>;

/// Feet that lift a vehicle with its load off its wheels and level it on uneven floor (Tang 2020,
/// section 2.1: "parking mechanisms"; a ball head each, so that a foot stands flat). Lowering: each
/// goes down by itself until it touches, then all raise the vehicle in step. Raising: all in step
/// until the wheels carry it, then each by itself to its upper switch. A foot that finds no floor
/// raises nothing, and all go up again. One alone goes down until it touches, or, when it does not
/// carry, up to its switch. All in the vehicle's own time. No clock.
class ParkingGear {
public:
    /// REQUIRES: the type has parking feet.
    ParkingGear(const plant::VehicleType& type, FloorUnder floor_under, std::uint64_t seed);

    /// Its load: mass and centre in the body frame.
    void set_load(double load_kg, geometry::Point2 centre);

    /// The floor below that foot gives way. False: there is no such foot.
    bool dig(const std::string& foot);

    /// `foot`: that one alone. REQUIRES: it is below count(), and of raise that it does not carry.
    void lower(std::optional<std::size_t> foot = std::nullopt);
    void raise(std::optional<std::size_t> foot = std::nullopt);
    void step(double dt_s);
    /// They stay where they are.
    void stop();
    bool moving() const { return phase_ != Phase::kStands; }
    /// The vehicle is lifted, and this foot has a share of it.
    bool carries(std::size_t foot) const;
    /// One of them holds the vehicle (plant::kFootDown_m).
    bool extended() const;
    /// Why the last movement did not end as it should: foot_without_floor {foot, extension_m}, of
    /// one alone foot_reaches_no_floor, which stays; foot_overloaded {foot, force_n, limit_n},
    /// foot_lost_contact {foot}.
    const std::optional<Reason>& stop_cause() const { return cause_; }

    std::size_t count() const { return feet_.size(); }
    const std::string& name(std::size_t foot) const { return parking_.feet[foot].name; }
    std::optional<std::size_t> find(const std::string& name) const;
    double extension_m(std::size_t foot) const { return feet_[foot].axis.position(); }
    /// What the force sensor of a foot shows now.
    double force_n(std::size_t foot);
    /// How the vehicle lies on wheels and feet: height of its origin over its wheels' places on
    /// even floor, and its slopes along x and y.
    const Eigen::Vector3d& plane() const { return plane_; }

private:
    enum class Phase { kStands, kFeels, kLifts, kSinks, kRetracts };
    struct Foot {
        ServoAxis axis;
        double commanded_m = 0;
        double force_n = 0;
        bool touches = false;
        bool over_pit = false;
    };

    bool takes_part(std::size_t foot) const { return !alone_ || *alone_ == foot; }
    void begin(Phase phase);
    void cycle();
    void advance();
    void feel();
    void move_in_step(double sign);
    void retract();
    void move(Foot& foot, double to_m);
    std::optional<double> floor_under(std::size_t foot) const;
    void settle();
    bool check();
    void fail(Reason cause, Phase next);

    plant::ParkingGear parking_;
    double cycle_s_;
    std::vector<geometry::Point2> wheels_;
    double mass_kg_;  // of the vehicle alone
    FloorUnder floor_under_;
    std::mt19937_64 random_;
    std::vector<Foot> feet_;
    double load_kg_ = 0;
    geometry::Point2 load_centre_;
    Phase phase_ = Phase::kStands;
    std::optional<std::size_t> alone_;  // the one that moves; none: all
    double lifted_m_ = 0;               // since all touched; lowered again, they go on from there
    double pending_s_ = 0;
    double settled_s_ = 0;
    Eigen::Vector3d plane_ = Eigen::Vector3d::Zero();
    std::optional<Reason> cause_;
};

}  // namespace pulseline::simulation
