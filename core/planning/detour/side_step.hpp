#pragma once

#include <optional>

#include "core/planning/detour/detour_ground.hpp"
#include "core/planning/manoeuvre/manoeuvre_path.hpp"

namespace pulseline::planning {

/// Shift aside, straight past, shift back onto the line at `goal_m`: the way of a vehicle that
/// moves in any direction, its heading that of the line. Of the ways that are free, one of least
/// distance from the line, with its shifts as oblique as there is room. Frame of the ground; moves
/// from `start`.
/// REQUIRES: the vehicle's wheels can do it.
std::optional<Moves> side_step(const DetourGround& ground, const geometry::Pose2& start,
                               double goal_m);

}  // namespace pulseline::planning
