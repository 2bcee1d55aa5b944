#pragma once

#include "api/json/object_reader.hpp"

/// What a number of a message can be at all. Wider than any hall, vehicle or load, and narrow
/// enough that no sum, product or quotient of a few of them overflows behind the codecs: a number
/// beyond these is an error of its message, told to whoever sent it.
namespace pulseline::vda5050::limits {

inline constexpr json::NumberLimits kPlace_m{-1e6, 1e6};  // in the hall
inline constexpr json::NumberLimits kAngle_rad{-100, 100};
/// The official schemas' half turn, a little more than pi. No angle that is sent exceeds it.
inline constexpr double kSchemaPi = 3.14159265359;
inline constexpr json::NumberLimits kSigma_m{0, 100};
inline constexpr json::NumberLimits kSight_m{0, 1};  // of a reflector, by a laser scanner
inline constexpr json::NumberLimits kSigma_rad{0, 4};
inline constexpr json::NumberLimits kLength_m{0, 1e3};        // of bodies and widths of ways
inline constexpr json::NumberLimits kOnVehicle_m{-1e3, 1e3};  // in the body frame
inline constexpr json::NumberLimits kSpeed_mps{0, 1e3};
inline constexpr json::NumberLimits kVelocity_mps{-1e3, 1e3};
inline constexpr json::NumberLimits kTurnRate_radps{-1e3, 1e3};
inline constexpr json::NumberLimits kAcceleration_mps2{0, 1e4};
inline constexpr json::NumberLimits kDistance_m{-1e6, 1e6};  // driven
inline constexpr json::NumberLimits kDeviation_m{0, 1e6};
inline constexpr json::NumberLimits kPercent{0, 100};
inline constexpr json::NumberLimits kShare{0, 1};
inline constexpr json::NumberLimits kTimes{1, 1e12};
inline constexpr json::NumberLimits kAgo_s{0, 1e9};
inline constexpr json::NumberLimits kForce_n{-1e9, 1e9};
inline constexpr json::NumberLimits kLoad_kg{-1e6, 1e6};  // scales without load read below 0
inline constexpr json::NumberLimits kTemperature_c{-273.15, 1e4};
inline constexpr json::NumberLimits kResidual_px{0, 1e5};
/// Parameters of actions that the codec does not know.
inline constexpr json::NumberLimits kParameter{-1e9, 1e9};

/// A slower top speed than that is no drive but an error: 1e-300 m/s make every drive endless.
inline constexpr double kLeastTopSpeed_mps = 1e-3;

}  // namespace pulseline::vda5050::limits
