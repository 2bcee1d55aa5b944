#pragma once

#include <vector>

#include "core/kinematics/motion.hpp"
#include "core/plant/plant.hpp"

/// Halls in which vehicles drive for an experiment.
namespace pulseline::experiments {

inline constexpr double kWayLength_m = 200;

/// What a vehicle finds its way by.
enum class Method { kOdometry, kCodes, kLight, kReflectors, kContours };

/// One of the kind that the type reads, surveyed as plants usually have them.
void lay_code(plant::Plant& plant, const plant::VehicleType& type, const geometry::Pose2& pose);

/// `plant` with nothing but a straight way along x in an empty hall, and beside it what the method
/// needs; codes one every `spacing_m`, 0: none.
plant::Plant straight_way(plant::Plant plant, const plant::VehicleType& type, Method method,
                          double spacing_m);
/// The way in pieces.
std::vector<kinematics::Segment> pieces();

}  // namespace pulseline::experiments
