#pragma once

#include "core/planning/legs/free_leg.hpp"
#include "core/planning/legs/grid_leg.hpp"
#include "core/planning/legs/road_leg.hpp"

/// From a leg's task to its plan: the ways of one motion mode, and whether they keep clear.
namespace pulseline::planning {

/// The plan of the best way of a mode (neither kAuto nor kFree), or the reason against it.
Result<LegPlan> assess_mode(const LegTask& task, plant::MotionMode mode);
/// The plan of a leg over free floor, of mode kLinear.
Result<LegPlan> assess_grid(const LegTask& task, GridLegs& grid);
/// The plan of a free manoeuvre past bodies that stay where they are.
Result<LegPlan> assess_free(const LegTask& task, FreeLegs& free,
                            const std::vector<StandingBody>& standing);

/// The finished plan of a draft whose swept area keeps clear, or what blocks it.
Result<LegPlan> finish(const LegTask& task, plant::MotionMode mode, LegDraft draft);
/// One way after another. A route begins where the vehicle first comes to the roadmap.
LegPlan joined(const plant::VehicleType& type, const LegPlan& first, const LegPlan& rest);

/// Another plan beside the one that was taken: what it costs more, and most of all for what.
LegAlternative compared(const plant::RoutingCost& cost, const LegPlan& taken, LegPlan other);

/// What people want to know of a plan besides: how near it comes to what, what the wheels do, and
/// its outline.
void describe(const plant::VehicleType& type, const Body& body, const Obstacles& obstacles,
              const std::vector<StandingBody>& standing, LegPlan& plan);

}  // namespace pulseline::planning
