#pragma once

#include <cstdint>
#include <deque>
#include <random>

namespace pulseline::simulation {

/// One servo drive with what it moves, all of it at the driven end: motion in u (metres of rim,
/// radians of steering, metres of lift), forces in F (newtons, or newton metres).
struct ServoParameters {
    // Motor and gear. Torque constant and gear ratio give the force of an ampere, resistance and
    // inductance are in the bandwidth of the current loop: its PI cancels the winding's pole
    // (Kp = L w, Ki = R w), which leaves a lag of first order.
    double force_per_ampere = 100;     // F/A: torque constant x ratio / radius x efficiency
    double current_limit_a = 60;       // of the drive, to either side
    double current_loop_radps = 1000;  // 160 Hz, usual for servo drives of some kW
    double rotor_inertia = 30;         // F s^2/u: rotor and gear, seen from the driven end
    double viscous_friction = 50;      // F s/u
    double coulomb_friction = 40;      // F
    // Loops.
    double tuned_inertia = 500;         // what the velocity loop was tuned for
    double velocity_loop_radps = 60;    // 10 Hz: a third of what a stiff gear would bear
    double velocity_integral_s = 0.08;  // reset time of the velocity PI
    double position_gain_per_s = 3.5;   // Tang 2020, section 2.1: of the drive wheels' motors
    double feedforward = 1;             // share of the commanded velocity
    double speed_limit = 2;             // u/s, of the velocity command
    // Encoder and command path.
    double increment = 1e-6;      // u of one count: 17 bit behind the gear
    double noise_increments = 1;  // half width of its uniform noise
    int dead_cycles = 2;          // between the PLC's command and the drive: field bus
    double cycle_s = 0.01;        // of the PLC
};

/// One axis: position loop P in the PLC, velocity PI and current PI in the servo drive (Tang 2020,
/// section 2.1, figure 2), motor and load. cycle() is one cycle of the PLC; inside, the
/// drive runs at kDriveStep_s. The current lag is integrated exactly, friction implicitly (Coulomb
/// friction as a projection that never reverses the motion), so it is stable for any parameters
/// whose velocity loop is slower than 1 / (4 kDriveStep_s).
/// Bandwidths of the defaults: current 160 Hz, velocity 10 Hz, position 0.56 Hz.
class ServoAxis {
public:
    static constexpr double kRounding_s = 1e-9;  // so little less of time is a whole cycle
    static constexpr double kDriveStep_s = 0.001;

    ServoAxis(const ServoParameters& parameters, std::uint64_t seed);

    /// Inertia of what moves with it, in F s^2/u (kilograms for a wheel).
    void set_load(double inertia);
    /// Coulomb friction, of the weight that it bears.
    void set_friction(double force) { parameters_.coulomb_friction = force; }
    /// From outside: gravity on a slope, the weight on a lift. Positive along positive motion.
    void set_external_force(double force) { external_force_ = force; }
    void set_dead_encoder(bool dead) { dead_encoder_ = dead; }

    /// Holds the commanded position, moving at `velocity` there.
    void cycle(double position, double velocity);
    /// The brake falls in: it stands, and the loops forget.
    void brake();
    /// Before a brake opens: the motor already pushes with `force`, so that a load does not sink.
    void preload(double force);
    /// The counter is set to `position`, standing: homing.
    void home(double position);

    /// True, not as the encoder tells.
    double position() const { return position_; }
    double velocity() const { return velocity_; }
    double measured_position() const { return measured_; }
    double current_a() const { return current_a_; }
    double force() const { return parameters_.force_per_ampere * current_a_; }
    /// Commanded minus measured, as the drive sees it: behind the dead time.
    double following_error() const { return commanded_ - measured_; }
    bool at_current_limit() const { return at_limit_; }

private:
    struct Command {
        double position = 0;
        double velocity = 0;
    };

    double read_encoder();
    void drive_step(double wanted_velocity);

    ServoParameters parameters_;
    int drive_steps_;  // of a cycle
    std::mt19937_64 random_;
    std::deque<Command> on_the_way_;
    double current_lag_;  // what is left of a current's error after a step
    double inertia_ = 0;
    double external_force_ = 0;
    bool dead_encoder_ = false;
    bool at_limit_ = false;

    double commanded_ = 0;
    double position_ = 0;
    double velocity_ = 0;
    double current_a_ = 0;
    double integral_ = 0;  // of the velocity PI, in F
    double measured_ = 0;
    double measured_velocity_ = 0;
};

}  // namespace pulseline::simulation
