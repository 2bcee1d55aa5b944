#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/fleet/tables/plant_tables.hpp"
#include "core/planning/legs/leg_planner.hpp"
#include "core/plant/plant.hpp"

/// What a vehicle would do to get somewhere, in every motion mode.
namespace pulseline::fleet {

struct MotionQuestion {
    plant::VehicleId vehicle;
    std::optional<int> station;             // its number
    std::optional<geometry::Pose2> target;  // REQUIRES: either a station or a target pose
    plant::HallId hall;                     // of start and target; empty: the vehicle's
    std::optional<geometry::Pose2> start;   // none: where the vehicle stands
    std::optional<bool> loaded;             // none: as the vehicle is
    std::vector<plant::MotionMode> modes;   // none: all of the vehicle's type
};

/// A question with all that the fleet knows about it, to be answered on another thread.
struct MotionTask {
    planning::LegRequest request;
    geometry::Pose2 target;
    std::vector<plant::MotionMode> modes;
    std::vector<planning::StandingBody> standing;
    std::vector<planning::ClosedFloor> closures;
    std::shared_ptr<const PlantTables> tables;
};

/// Answers such questions, and keeps its planner, with all that has worked out, for the next one.
/// Thread safety: none. REQUIRES: the plant outlives it.
class MotionPreviewer {
public:
    /// Every mode asked for with its plan or the reason against it, in the order of
    /// plant::kMotionModes; besides the reasons of LegPlanner::assess_modes mode_not_supported for
    /// one that is not the type's. Of all modes of the type the one that kAuto takes is suggested.
    std::vector<planning::ModeOption> preview(const MotionTask& task);

private:
    std::shared_ptr<const PlantTables> tables_;
    std::optional<planning::LegPlanner> planner_;  // made of those
};

}  // namespace pulseline::fleet
