#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/geometry/pose2.hpp"
#include "core/plant/vehicle_type.hpp"
#include "core/simulation/machine/servo_axis.hpp"

namespace pulseline::simulation {

struct LiftPlace {
    std::string name;
    geometry::Point2 position;  // body frame
};

/// Sizes of a screw lift with its servo motor. Limits are per lift.
struct LiftParameters {
    double stroke_m = 0.3;  // from the lower limit switch to the upper one
    double speed_mps = 0.01;
    double accel_mps2 = 0.02;
    double stiffness_npm = 1.5e7;  // lift, frame and what lies on it
    double most_force_n = 8e4;     // above: it stops
    double least_share = 0.02;     // of an even share of the load; below, the load has left it
    double uneven = 0.03;          // between the two sensors of a lift, half width
    double sensor_noise = 0.002;   // share, sigma
    double in_step_m = 0.0004;     // a lift lagging by more makes the others wait
    plant::AxisControl control = {};
};

/// Lifts that carry one rigid load, moving singly or in step (Tang 2020, section 2.1: bracket and
/// parking mechanisms, position loop in the PLC, velocity and current loop in the drives; two
/// pin-axis force sensors a bracket). In step means within 1 mm of each other: lifts at other
/// heights wait until the others have come level. A force out of its range stops the movement.
/// Standing, the brakes hold. All in the vehicle's own time.
class LiftingDrive {
public:
    struct Forces {
        double a_n = 0;
        double b_n = 0;
    };

    /// REQUIRES: at least one place.
    LiftingDrive(std::vector<LiftPlace> places, const LiftParameters& parameters,
                 std::uint64_t seed);

    /// What lies on the lifts: mass and centre in the body frame.
    void set_load(double load_kg, geometry::Point2 centre);

    /// Moves one lift, or all in step, to a height above the lower limit switch, at `speed_mps`;
    /// none: as fast as they can. Refused while moving (lifts_moving), out_of_stroke {height_m,
    /// stroke_m} and out_of_speed {speed_mps, most_mps}.
    std::optional<Reason> begin(std::optional<std::size_t> lift, double height_m,
                                std::optional<double> speed_mps = std::nullopt);
    void step(double dt_s);
    bool moving() const { return moving_; }
    /// They stay where they are.
    void stop();
    /// Why the last movement did not end: bracket_force_out_of_range {bracket, force_n, limit_n}.
    const std::optional<Reason>& stop_cause() const { return cause_; }

    const std::vector<LiftPlace>& places() const { return places_; }
    std::optional<std::size_t> find(const std::string& name) const;
    double height_m(std::size_t lift) const { return lifts_[lift].axis.position(); }
    /// Its encoder tells so much less than how high it truly is.
    void displace(std::size_t lift, double by_m) { lifts_[lift].above_m = by_m; }
    /// What the two sensors of a lift show now.
    Forces forces(std::size_t lift);

private:
    struct Lift {
        ServoAxis axis;
        double commanded_m = 0;
        double above_m = 0;  // what its encoder tells
        double wanted_m = 0;
        double split = 0;  // of the force between the sensors: (1 + split) / 2 and (1 - split) / 2
        double force_n = 0;
        double last_force_n = 0;  // one cycle ago
        bool moves = false;
    };

    void cycle();
    void advance(double sign);
    double pace(double left_m) const;
    void share_load();
    void check_forces();
    void finish();

    std::vector<LiftPlace> places_;
    LiftParameters parameters_;
    std::mt19937_64 random_;
    std::vector<Lift> lifts_;
    double load_kg_ = 0;
    geometry::Point2 centre_;
    double wanted_mps_ = 0;
    double speed_mps_ = 0;  // of the movement's profile
    double pending_s_ = 0;
    double settled_s_ = 0;
    bool moving_ = false;
    std::optional<Reason> cause_;
};

}  // namespace pulseline::simulation
