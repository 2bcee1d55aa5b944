#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/control/obstacle_ring.hpp"
#include "core/geometry/polygon.hpp"
#include "core/kinematics/wheels.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::control {

using geometry::Point2;
using geometry::Pose2;
using kinematics::Twist;

/// Precise navigation near a goal. Weights are those of eq. 11.
struct DynamicWindowOptions {
    double tolerance_m = 0.003;
    double tolerance_rad = radians(0.1);
    double margin_m = 0.05;        // kept between the outline and every obstacle
    double top_speed_mps = 0.3;    // near the goal; the type's own if that is less
    double clear_m = 0.5;          // obstacles farther away than that do not count any more
    double weight_angle = 0.5;     // alpha
    double weight_distance = 0.1;  // beta
    double weight_speed = 0.1;     // gamma
    double weight_target = 1.0;    // eta
};

/// What a step knows.
struct WindowInput {
    Twist present;         // body frame, as it drives now
    Pose2 hall_from_body;  // estimate
    Pose2 hall_from_target;
    double dt_s = 0.05;                 // until the next step, > 0
    std::span<const Point2> obstacles;  // body frame, e.g. lidar returns
};

struct WindowCommand {
    enum class State { kDriving, kReached, kBlocked };
    Twist twist;
    State state = State::kDriving;
    /// kBlocked: the obstacle that bars every better motion, body frame.
    std::optional<Point2> blocked_by;
};

/// Dynamic window approach of Li 2022, eq. 11 to 14 as corrected: of the twists that the vehicle
/// can have after one step (acceleration window, wheel limits), the one of greatest
///     G = alpha angle' + beta dist + gamma vel' + eta dtar,
/// each term spread over [0, 1] among the samples. A sample stands for where it would come to rest:
/// driven for one step, then braked.
///   angle' (12)  far: 1 - |bearing of the target from the direction driven| / pi; near: 1 -
///                |heading - target's| / pi. Near is inside the tolerance, where only the heading
///                is left; for vehicles that move sideways always, since their heading is free.
///   dist         least way between outline and obstacles at rest, as far as they count
///   vel' (14)    speed / top speed, of samples below sqrt(2 a d_tar) (with the step: v dt + v^2 /
///                2a <= d_tar) and exactly 0 inside the tolerance
///   dtar (13)    cos(pi/2 min(1, d_tar / d_tar0)), d_tar0 the distance where the approach began
/// A differential vehicle turns first where the target lies more aside than ahead, forwards or
/// backwards; the paper says nothing of it, and a vehicle that passes beside its goal never ends.
/// Obstacles bar a sample by a bound that holds for convex outlines (obstacle_ring.hpp).
///
/// One object drives one approach; a new target begins a new one. No allocation in step().
class DynamicWindow {
public:
    /// REQUIRES: the type's limits are > 0.
    explicit DynamicWindow(plant::VehicleType type, const DynamicWindowOptions& options = {});

    /// The outline must stay inside this polygon (hall frame) with the margin, like walls; empty:
    /// no corridor. Allocates.
    void set_corridor(const geometry::Polygon& corridor);
    WindowCommand step(const WindowInput& input);

    /// Whether the acceleration window allows to go from one twist to another in a step.
    bool is_in_window(const Twist& from, const Twist& to, double dt_s) const;

private:
    static constexpr double kRounding = 1e-9;

    struct Sample {
        Twist twist;
        Pose2 rest;  // where it would come to rest, in the present body frame
        double angle = 0;
        double distance = 0;
        double speed = 0;
        double target = 0;
        std::optional<std::size_t> barred_by;  // place in the ring
    };

    void begin_step(const WindowInput& input);
    void gather_obstacles(const WindowInput& input);
    void sample_differential(const WindowInput& input);
    void sample_sideways(const WindowInput& input);
    void offer(const WindowInput& input, const Twist& twist);
    void weigh_obstacles();
    double angle_term(const Pose2& rest, const Twist& twist) const;
    Pose2 rest_of(const Twist& twist, double dt_s) const;
    double turn_that_ends(double turn_rad, double present_radps, double dt_s) const;
    Twist braked(const Twist& present, double dt_s) const;
    const Sample* best(bool obstacles_count) const;

    plant::VehicleType type_;
    DynamicWindowOptions options_;
    bool sideways_;
    double top_speed_mps_;
    double most_lever_m_ = 0;  // of a wheel
    std::vector<Point2> corridor_;
    ObstacleRing ring_;

    Pose2 body_from_target_;
    double d_tar_m_ = 0;
    double d_tar0_m_ = 0;
    std::optional<Pose2> approached_;
    bool in_tolerance_ = false;
    std::vector<Sample> samples_;
};

}  // namespace pulseline::control
