#pragma once

#include <memory>
#include <optional>

#include "core/fleet/state/leg_plan.hpp"
#include "core/planning/legs/leg_planner.hpp"

/// The other side of leg_plans.hpp: what the fleet has asked for is planned here, on another
/// thread.
namespace pulseline::fleet {

/// Answers the questions of Outputs::plans_wanted, and keeps its planner for the next one.
/// Thread safety: none. REQUIRES: the plant outlives it.
class LegPlanAnswerer {
public:
    LegPlanAnswer answer(const LegPlanQuestion& question);

private:
    std::shared_ptr<const PlantTables> tables_;
    std::optional<planning::LegPlanner> planner_;  // made of those
};

}  // namespace pulseline::fleet
