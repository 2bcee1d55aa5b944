#pragma once

#include <cmath>
#include <numbers>

namespace pulseline {

inline constexpr double kPi = std::numbers::pi;

/// Angle brought into (-pi, pi].
inline double wrap(double angle_rad) {
    const double a = angle_rad - 2 * kPi * std::round(angle_rad / (2 * kPi));
    return a <= -kPi ? a + 2 * kPi : a;
}
constexpr double radians(double degrees) { return degrees * kPi / 180.0; }
constexpr double degrees(double radians) { return radians * 180.0 / kPi; }

}  // namespace pulseline
