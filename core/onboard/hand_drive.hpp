#pragma once

#include "core/kinematics/wheels.hpp"
#include "core/onboard/drive.hpp"

namespace pulseline::onboard {

/// Driving a vehicle from a hand-held control beside it (Tang 2020: the first alignment): forwards,
/// backwards, sideways and turning, together where the wheels can, slowly, and only while the
/// person keeps asking for it. Whoever lets go, or loses the line, has the vehicle brake.
/// Thread safety: none. No clock: time passes by step().
class HandDrive {
public:
    /// Of somebody walking beside it.
    static constexpr double kFastest_mps = 0.3;
    static constexpr double kFastest_radps = 0.1;
    /// Without another command the vehicle brakes after this.
    static constexpr double kLetGo_s = 0.3;

    explicit HandDrive(Drive& drive) : drive_(drive) {}

    /// Brakes; from then on it moves by command() only. What was queued is dropped.
    void take();
    /// Asks to move so (body frame) from now on for kLetGo_s, no faster than the above. Fails
    /// with cannot_move_so {wheel, sideways_mps} and leaves the vehicle braking.
    Status command(const kinematics::Twist& wanted);
    /// REQUIRES: taken and not given back.
    void step(double dt_s);
    bool standing() const { return drive_.standing(); }
    /// REQUIRES: standing().
    void give_back();

private:
    Drive& drive_;
    kinematics::Twist wanted_;
    double asked_for_s_ = 0;  // left of the last command
    bool taking_ = false;     // brakes before it is steered
};

}  // namespace pulseline::onboard
