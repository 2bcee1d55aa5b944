#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/kinematics/dead_reckoning.hpp"
#include "core/kinematics/motion.hpp"
#include "core/kinematics/trajectory.hpp"
#include "core/planning/legs/leg_chain.hpp"
#include "core/planning/roads/leg_roads.hpp"
#include "core/planning/roads/motion_graph.hpp"
#include "core/planning/room/standing_body.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::planning {

struct LegRequest {
    const plant::VehicleType* type = nullptr;
    bool loaded = false;
    plant::HallId hall;
    geometry::Pose2 start;          // measured pose
    plant::StationId from_station;  // empty when the vehicle stands at no station
    plant::StationId target;
    std::optional<geometry::Pose2> target_pose;  // instead of a station: no lanes lead there
    plant::MotionMode mode = plant::MotionMode::kAuto;
    bool operator==(const LegRequest&) const = default;
};

/// The longest way of a leg without a code below the vehicle's cameras: from where it starts, which
/// it knows, between codes, and to the station's.
struct BlindWay {
    double way_m = 0;
    /// After which the next code is still in view, with three sigma (localisation::blind_way_m).
    double at_most_m = std::numeric_limits<double>::infinity();
    bool loses_itself() const { return way_m > at_most_m; }
};

/// What another way is taken for where there is one, the least first.
enum class Drawback : std::uint8_t { kNone, kLosesItself, kClosedFloor };

/// One way to drive a leg.
struct LegPlan {
    plant::MotionMode mode = plant::MotionMode::kLinear;
    std::vector<kinematics::Segment> segments;
    std::vector<double> max_speed_mps;  // of each segment by its lane; 0, or empty: none
    std::vector<plant::NodeId> route;   // roadmap nodes visited; empty for a direct motion
    double length_m = 0;
    int turns = 0;        // changes of direction up to arrival; an arc is one
    double cost = 0;      // in units of k, roadmap routes and direct motions alike
    double accuracy = 0;  // of the cost, for driving where its place is uncertain
    double duration_s = 0;
    kinematics::ExpectedDeviation expected;  // at its end, on odometry alone, nothing adjusted yet
    /// Closed floor it leads over because there is no other way: ids of a smallest set that has to
    /// be reopened.
    std::vector<std::string> closures;
    std::vector<std::string> loads;  // likewise those that stand or hang in its way, with a load
    BlindWay blind;
    // For people, filled in by assess_modes only: it costs more than the planning.
    double clearance_m = 0;  // least distance to walls, obstacles and standing bodies
    std::string nearest;     // what that least distance is to: "wall", area or vehicle id
    std::optional<kinematics::WheelPeaks> wheels;  // absent when the type states no wheels
    double swept_area_m2 = 0;
    std::vector<geometry::Polygon> swept;   // outline rings of the swept area, hall frame
    std::optional<Result<LegChain>> chain;  // by which codes it finds its way, or why it has none

    Drawback drawback() const {
        if (!closures.empty() || !loads.empty()) return Drawback::kClosedFloor;
        return blind.loses_itself() ? Drawback::kLosesItself : Drawback::kNone;
    }
};

/// Of the feasible modes kAuto takes the one that is ready soonest, counting the drive, the
/// adjusting of its expected deviation, and caution beside what it comes near to; over closed floor
/// only where no mode leads round it, and over floor where the vehicle loses itself (BlindWay) only
/// where no mode leads past codes.
struct ModeOption {
    plant::MotionMode mode = plant::MotionMode::kLinear;
    Result<LegPlan> plan;
    bool suggested = false;  // what kAuto takes
};

/// Another way to drive a leg, and why it was not taken.
struct LegAlternative {
    LegPlan plan;
    // What it costs more than the leg that was, in units of k, and for what.
    double more_cost = 0;
    double more_length = 0;
    double more_turns = 0;
    double more_accuracy = 0;
    double more_s = 0;
    enum class Reason : std::uint8_t { kLength, kTurns, kAccuracy, kTime };
    Reason main_reason = Reason::kLength;
};

/// Whether a free manoeuvre may do for the request what nothing else does.
bool may_need_free_manoeuvre(const LegRequest& request);

/// Plans legs in one plant. What depends on the plant alone (obstacles, lanes that a vehicle type
/// fits through) is worked out once, in the constructor; exact costs to a station's node when a leg
/// first leads there. REQUIRES: the plant outlives the planner unchanged.
/// Thread safety: none, not even for const methods: they build cost tables. One planner a thread.
class LegPlanner {
public:
    explicit LegPlanner(const plant::Plant& plant);
    /// Another one for the same plant, without closures: shares what the plant alone decides.
    LegPlanner again() const;
    ~LegPlanner();
    LegPlanner(LegPlanner&&) noexcept;
    LegPlanner& operator=(LegPlanner&&) noexcept;

    /// Every motion mode of the vehicle type with its plan or the reason against it, in the order
    /// of plant::kMotionModes. A mode other than kAuto that is refused stays refused; `linear`
    /// drives straight when that is free and it does not lose itself, else along the roadmap
    /// route (turning at its nodes, forwards or backwards) found by the direction-penalised A*; for
    /// types with free manoeuvres, where there is neither, over free floor (grid_leg.hpp).
    /// Standing bodies are gone round where a mode has a way, as the order will go; else they lower
    /// `clearance_m` and set `nearest` and make nothing infeasible, since they may have left by the
    /// time the leg starts (traffic sends idle ones away and waits for the others). Reason codes
    /// besides those of plan_motion: blocked {by, at_x_m, at_y_m, clearance_m, limit_m} (wall or
    /// obstacle), no_route {from, to, blocked_by?}, footprint_too_large {edge, by, clearance_m,
    /// limit_m}, station_not_for_type {station, vehicle_type}, unknown_station, other_hall {from,
    /// to}.
    std::vector<ModeOption> assess_modes(const LegRequest& request,
                                         const std::vector<StandingBody>& standing) const;

    /// The plan of request.mode, or for kAuto the suggested one, or why there is none (kAuto: the
    /// reason of the most promising mode).
    /// A free manoeuvre goes round who stands there; where it cannot, as if nobody did: they may be
    /// asked to leave.
    Result<LegPlan> plan_leg(const LegRequest& request,
                             const std::vector<StandingBody>& standing = {}) const;
    /// The same without free manoeuvres, which alone take more than a few milliseconds.
    Result<LegPlan> plan_primitive_leg(const LegRequest& request) const;

    /// As plan_primitive_leg, but `first_m` straight ahead (negative: back) before anything else:
    /// for a vehicle that cannot turn where it stands.
    Result<LegPlan> plan_leg_after(double first_m, LegRequest request) const;

    /// Up to `count` other ways along the roadmap, by cost, sufficiently different from `plan`
    /// (what plan_leg or assess_modes gave for the request) and from each other, none over closed
    /// floor or who stands there.
    std::vector<LegAlternative> alternatives(const LegRequest& request, const LegPlan& plan,
                                             int count,
                                             const std::vector<StandingBody>& standing) const;

    /// Floor closed from now on, instead of what was: legs lead round it where they can.
    void set_closures(const std::vector<ClosedFloor>& closures);

    /// What a vehicle of the type may do on the roadmap, for traffic.
    MotionGraph motion_graph(const plant::VehicleType& type, bool loaded) const;

private:
    Result<LegPlan> plan_known(const LegRequest& request, bool with_free) const;
    struct Tables;
    class GoingRound;
    explicit LegPlanner(std::unique_ptr<Tables> tables);
    std::unique_ptr<Tables> tables_;
};

}  // namespace pulseline::planning
