#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/planning/legs/road_leg.hpp"
#include "core/planning/manoeuvre/free_manoeuvre.hpp"

namespace pulseline::planning {

/// Free manoeuvres as legs: round closed floor where there is room, and remembered, since an order
/// that waits asks again and again.
/// Thread safety: none.
class FreeLegs {
public:
    /// REQUIRES: the plant outlives it unchanged.
    explicit FreeLegs(const plant::Plant& plant) : plant_(plant) {}

    /// From where the vehicle stands to the station, past bodies that stay where they are. Errors
    /// as of plan_free_manoeuvre.
    Result<LegDraft> draft(const LegTask& task, const std::vector<StandingBody>& standing);

    /// What is known of a hall's floor, worked out when it is first asked for; null: no such hall.
    const FreeFloor* floor(const plant::HallId& hall);

private:
    struct Known {
        plant::VehicleType type;
        FreeManoeuvreRequest request;
        plant::HallId hall;
        Result<kinematics::MotionPlan> motion;
    };
    Result<kinematics::MotionPlan> plan(const FreeFloor& floor,
                                        const FreeManoeuvreRequest& request);

    const plant::Plant& plant_;
    std::map<plant::HallId, std::unique_ptr<const FreeFloor>> floors_;
    std::deque<Known> known_;
};

}  // namespace pulseline::planning
