#pragma once

#include <vector>

#include "core/base/result.hpp"
#include "core/plant/plant.hpp"

/// Motion primitives: how a vehicle gets from one pose to another in one motion mode.
namespace pulseline::kinematics {

using geometry::Point2;
using geometry::Pose2;
using plant::MotionMode;

/// One primitive move. Rotate turns about the body's own centre; Straight keeps the heading and
/// moves along `direction_rad` of the body frame (0 forwards, pi backwards, +-pi/2 sideways); Arc
/// turns the body about `centre` of the hall frame, heading tangential (backwards when
/// length_m < 0); Combined moves the body centre along a straight line while the heading turns
/// evenly with the way, `direction_rad` being that of the line in the body frame at its start. A
/// straight driven backwards has both direction pi and length_m < 0.
struct Segment {
    enum class Kind { kRotate, kStraight, kArc, kCombined };
    Kind kind = Kind::kStraight;
    Pose2 start;
    Pose2 end;
    double turn_rad = 0;       // change of heading, counter-clockwise positive; not wrapped
    double length_m = 0;       // path of the body centre; negative: driven backwards
    double direction_rad = 0;  // Straight and Combined
    Point2 centre;             // Arc only
    double duration_s = 0;  // share of its run's trapezoidal profile (pieces of one arc, one line)
    bool operator==(const Segment&) const = default;
};

struct MotionPlan {
    MotionMode mode = MotionMode::kLinear;
    std::vector<Segment> segments;
    double length_m = 0;
    double turn_rad = 0;  // sum of absolute turns
    double duration_s = 0;
};

/// Pose on a segment at share s in [0, 1] of its way.
Pose2 pose_at(const Segment& segment, double s);
/// Piece of a segment between shares s0 < s1 (durations are those of a standing start and stop).
Segment part(const plant::VehicleType& type, const Segment& segment, double s0, double s1);
/// Time of a move with trapezoidal speed profile from rest to rest.
double profile_duration_s(double distance, double max_rate, double max_accel);

/// Motion of `mode` (not kAuto) from pose to pose without regard to obstacles.
/// Errors (Errc::kUnreachable), reason codes: mode_not_supported, target_on_heading_line
/// {offset_m, radius_m, limit_m} (Tang eq. 7), not_in_place {distance_m} (self rotation needs the
/// same position), not_beside {along_m} (lateral), turn_radius_too_small {radius_m, limit_m},
/// already_there, cannot_move_so {wheel, sideways_mps} when its wheels cannot follow. A vehicle
/// type supports the modes it lists; kFree is
/// not planned here. Self rotation keeps the position, up to the 25 mm by which a measured stop may
/// be off.
Result<MotionPlan> plan_motion(const plant::VehicleType& type, const Pose2& from, const Pose2& to,
                               MotionMode mode);
/// All ways to drive `mode`, best first (forwards and backwards); the others matter when the best
/// one is blocked. Same errors.
Result<std::vector<MotionPlan>> motion_variants(const plant::VehicleType& type, const Pose2& from,
                                                const Pose2& to, MotionMode mode);
/// Within 1 mm and 0.005 deg.
bool is_there(const Pose2& from, const Pose2& to);

/// How finely a turning body is cut into steps; the pieces always hold all of it.
struct SweepDetail {
    double step_rad = radians(3.0);
    double excess_m = 0.005;  // how far a piece may stand out
};
/// Coarse enough to join and draw for people; where a vehicle fits is decided with the default.
constexpr SweepDetail kOutlineDetail{.step_rad = radians(10.0), .excess_m = 0.05};
/// Swept area of body pieces (convex, body frame) along segments: overlapping convex pieces.
std::vector<geometry::Polygon> sweep(const std::vector<geometry::Polygon>& body,
                                     const std::vector<Segment>& segments,
                                     const SweepDetail& detail = {});

}  // namespace pulseline::kinematics
