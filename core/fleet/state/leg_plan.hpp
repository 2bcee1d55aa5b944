#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/time.hpp"
#include "core/planning/legs/leg_planner.hpp"
#include "core/plant/plant.hpp"

/// Legs that take longer to plan than others may wait for the fleet: free manoeuvres, some tens of
/// milliseconds each and half a second where there is hardly room. The fleet asks for such a plan
/// (Outputs::plans_wanted), the order waits (plan_under_way), and Fleet::leg_planned brings the
/// answer. It is an input, so a journal made again gives the same.
namespace pulseline::fleet {

struct PlantTables;

struct LegPlanAnswer {
    std::optional<planning::LegPlan> plan;
    Reason why_not;  // set when there is no plan
};

/// What a vehicle's next leg waits for, or has got. A plan that cannot be begun is asked for anew:
/// others stand elsewhere by then.
struct AwaitedPlan {
    std::int64_t question = 0;
    planning::LegRequest request;
    Time asked;
    std::optional<LegPlanAnswer> answer;  // the newest plan, or why there is none
};

/// A question with all that the fleet knows about it, to be answered on another thread.
struct LegPlanQuestion {
    std::int64_t number = 0;
    plant::VehicleId vehicle;
    planning::LegRequest request;
    std::vector<planning::ClosedFloor> closures;
    std::vector<planning::StandingBody> standing;  // the others
    std::shared_ptr<const PlantTables> tables;
};

}  // namespace pulseline::fleet
