#pragma once

#include <span>
#include <vector>

#include "core/planning/legs/road_leg.hpp"
#include "core/planning/roads/code_reach.hpp"

namespace pulseline::planning {

/// Of these segments, in their order; those of arcs and of combined ways in their middles.
std::vector<TurnAt> turns_on(std::span<const kinematics::Segment> segments);

/// Of a leg that drives these segments: the gap between codes, or light, that exceeds most, or
/// falls short least, what may lie between them. Without senses, or a plant with anything for them,
/// there is nothing to miss.
BlindWay blind_way(const LegTask& task, const std::vector<kinematics::Segment>& segments);

}  // namespace pulseline::planning
