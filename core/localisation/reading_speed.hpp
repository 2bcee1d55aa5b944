#pragma once

#include <optional>
#include <span>

#include "core/kinematics/motion.hpp"
#include "core/plant/plant.hpp"

/// How fast a vehicle may drive over a code that it relies on.
namespace pulseline::localisation {

/// What the readers still take of a picture that motion has smeared (core/vision/README.md, level
/// hard; measured by EveryKind.IsReadThroughTheSmearThatSpeedsReckonWith).
inline constexpr double kMostSmear_px = 6;

/// The highest speed [m/s] of a camera's foot over the floor at which it surely reads a code of
/// that size: the lesser of
///   sqrt(3) r frame_rate_hz   one picture at least falls into the way on which the code is whole
///                             in view, which is 2 sqrt(r^2 - o^2) for a code `o` beside the foot's
///                             line; o = r / 2 is taken, half of what may be (view_radius_m: r =
///                             (d_FOV - d_Tag) / 2 of Li 2022 eq. 5, as corrected)
///   kMostSmear_px height_m / (f_px exposure_s)   the picture smears by no more than that
/// 0: it never sees the code whole.
double reading_speed_mps(const plant::Camera& camera, double size_m);

/// What a vehicle of the type must keep to on the segment [m/s, of its body] so that one of the
/// cameras that pass the code surely reads it; nullopt when it drives no faster there anyway, does
/// not pass the code at all, or turns on the spot, where speed limits do not count.
std::optional<double> limit_to_read_mps(const plant::VehicleType& type,
                                        std::span<const plant::Camera> cameras,
                                        const plant::Marker& marker,
                                        const kinematics::Segment& segment);

}  // namespace pulseline::localisation
