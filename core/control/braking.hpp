#pragma once

#include <algorithm>
#include <cmath>

/// One rate (of way or of turning) driven for a step and then braked with the full acceleration.
namespace pulseline::control {

/// Way of `rate`, signed like it: rate dt + rate^2 / 2a.
inline double way_to_rest(double rate, double accel, double dt_s) {
    return rate * dt_s + rate * std::abs(rate) / (2 * accel);
}
/// The greatest rate from which a way still suffices: rate dt + rate^2 / 2a <= way.
inline double rate_that_ends(double way, double accel, double dt_s) {
    return accel * (std::sqrt(dt_s * dt_s + 2 * way / accel) - dt_s);
}
inline double towards_zero(double rate, double by) {
    return std::copysign(std::max(0.0, std::abs(rate) - by), rate);
}

}  // namespace pulseline::control
