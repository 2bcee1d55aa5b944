#pragma once

namespace pulseline {

/// Standard acceleration of free fall (ISO 80000-3).
inline constexpr double kGravity_mps2 = 9.80665;

}  // namespace pulseline
