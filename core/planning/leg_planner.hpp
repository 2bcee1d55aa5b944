#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/kinematics/motion.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::planning {

/// A vehicle (or what it carries) that stands in the way.
struct StandingBody {
    plant::VehicleId vehicle;
    std::vector<geometry::Polygon> outline;  // hall frame, convex pieces
};

struct LegRequest {
    const plant::VehicleType* type = nullptr;
    bool loaded = false;
    plant::HallId hall;
    geometry::Pose2 start;           // measured pose
    plant::StationId from_station;   // empty when the vehicle stands at no station
    plant::StationId target;
    plant::MotionMode mode = plant::MotionMode::kAuto;
};

/// One way to drive a leg.
struct LegPlan {
    plant::MotionMode mode = plant::MotionMode::kLinear;
    std::vector<kinematics::Segment> segments;
    std::vector<plant::NodeId> route;  // roadmap nodes visited; empty for a direct motion
    double length_m = 0;
    int turns = 0;                     // changes of direction
    double cost = 0;                   // in units of k, roadmap routes and direct motions alike
    double duration_s = 0;
    double clearance_m = 0;            // least distance to walls, obstacles and standing bodies
    std::string nearest;               // what that least distance is to: "wall", area or vehicle id
    double swept_area_m2 = 0;
    std::vector<geometry::Polygon> swept;  // outline rings of the swept area, hall frame
};

struct ModeOption {
    plant::MotionMode mode = plant::MotionMode::kLinear;
    Result<LegPlan> plan;
    bool suggested = false;  // what kAuto takes: the feasible one with the least time
};

/// Every motion mode of the vehicle type with its plan or the reason against it. A mode other than
/// kAuto that is refused stays refused; `linear` drives straight when that is free, else along the
/// roadmap route (turning at its nodes) found by the direction-penalised A*.
/// Standing bodies only lower `clearance_m` and set `nearest`; they make nothing infeasible, since
/// they may have left by the time the leg starts (traffic waits for them).
/// Further reason codes: blocked {by, at_x_m, at_y_m, clearance_m, limit_m} (wall or obstacle),
/// no_route {from, to, blocked_by?}, footprint_too_large {edge, clearance_m},
/// station_not_for_type {station, vehicle_type}.
std::vector<ModeOption> assess_modes(const plant::Plant& plant, const LegRequest& request,
                                     const std::vector<StandingBody>& standing);

/// The plan of request.mode, or for kAuto the suggested one, or why there is none (kAuto: the
/// reason of the most promising mode).
Result<LegPlan> plan_leg(const plant::Plant& plant, const LegRequest& request,
                         const std::vector<StandingBody>& standing);

}  // namespace pulseline::planning
