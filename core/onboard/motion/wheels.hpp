#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/kinematics/wheels.hpp"

namespace pulseline::onboard {

/// Port: the wheels of a machine under the set points of its drive, one a wheel of the type in its
/// order, in the cycles of its control (Tang 2020, section 2.1: the industrial computer commands,
/// the PLC closes the position loops), and what their encoders tell. Thread safety: none. No clock.
class Wheels {
public:
    virtual ~Wheels() = default;

    /// One cycle, driving.
    virtual void roll(std::span<const kinematics::WheelMotion> wanted) = 0;
    /// One cycle with the brakes on: only what steers moves.
    virtual void steer(std::span<const kinematics::WheelMotion> wanted) = 0;
    /// The brakes fall in: nothing rolls, and the loops forget.
    virtual void brake() = 0;

    /// Where the wheels are being steered to, for kinematics::wheels_of.
    virtual const std::vector<kinematics::WheelMotion>& present() const = 0;
    /// As the encoders tell of the last cycle; a wheel without motor rolls as commanded.
    virtual const std::vector<kinematics::WheelMotion>& measured() const = 0;
    /// Every steered wheel within `limit_rad` of what is wanted.
    virtual bool aligned(std::span<const kinematics::WheelMotion> wanted,
                         double limit_rad) const = 0;
    /// Stands, and the position loops have come to rest.
    virtual bool settled() const = 0;

    /// The machine behind them does not answer any more: its own brakes are on.
    virtual bool lost() const { return false; }
    /// The first wheel that is broken or does not follow its command.
    virtual std::optional<std::string> fault() const = 0;
    /// The first driven wheel that lags so far behind that its encoder, not the floor, is to blame.
    virtual std::optional<std::string> lagging() const = 0;
    /// Switches such a wheel's motor off until brake().
    virtual void switch_off(const std::string& wheel) = 0;
    /// The largest share of a wheel's speed that it loses on the floor, by free-rolling measuring
    /// wheels. nullopt: it has none, or is too slow to say.
    virtual std::optional<double> slip_share() const = 0;

    /// Cycles between a set point and what the drives do with it.
    virtual int dead_cycles() const = 0;
};

}  // namespace pulseline::onboard
