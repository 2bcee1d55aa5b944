#pragma once

#include <array>
#include <vector>

#include "core/kinematics/motion.hpp"

/// What one vehicle type can drive exactly, and the short ways it has from pose to pose.
namespace pulseline::planning {

/// One exact motion of a body: a turn on the spot, a straight or an arc. The value form of
/// kinematics::Segment, which knows its poses as well.
struct Move {
    kinematics::Segment::Kind kind = kinematics::Segment::Kind::kStraight;
    double amount = 0;         // turn: rad, ccw positive; else m, negative: backwards
    double direction_rad = 0;  // straight: of the way in the body frame at a positive amount
    double curvature = 0;      // arc: 1 / radius, positive: centre on the left
};

/// Pose after a share in [0, 1] of the move.
geometry::Pose2 moved(const geometry::Pose2& from, const Move& move, double share = 1);
/// Farthest that a body's point moves, for a body reaching `reach_m` from its origin.
double farthest_moved_m(const Move& move, double reach_m);

/// Up to five moves one after the other.
struct Way {
    std::array<Move, 5> moves;
    int count = 0;
    double cost_m = 0;
};

/// Thread safety: an unchanging one may be used by any number of threads.
class Steering {
public:
    explicit Steering(const plant::VehicleType& type);

    /// Ways from pose to pose, least cost first; never empty. Words of Reeds and Shepp on arcs of
    /// radius_m(); for a type that may turn on the spot (lists self rotation or linear motion) also
    /// turn, straight forwards or backwards, turn; for one that moves in any direction (Mecanum, or
    /// lists lateral motion) also turn and straight, straight and turn.
    void ways(const geometry::Pose2& from, const geometry::Pose2& to, std::vector<Way>& ways) const;
    /// Cost of the first of them, in metres.
    double least_cost_m(const geometry::Pose2& from, const geometry::Pose2& to) const;

    /// Metres driven, for a turn on the spot those the vehicle could have driven in its time.
    double cost_m(const Move& move) const;
    /// What a stop between two moves counts besides, so that fewer moves and reversals win.
    static constexpr double kStop_m = 0.5;

    /// The type's least radius of arcs. For a type that states none half its length: it can turn
    /// on the spot, so arcs are there to keep moving, and a tighter one swings its ends about as
    /// far out as turning on the spot does.
    double radius_m() const { return radius_m_; }
    bool turns_on_the_spot() const { return spot_; }
    bool any_direction() const { return any_direction_; }

private:
    double radius_m_;
    double turn_m_;  // cost of a radian on the spot
    bool spot_;
    bool any_direction_;
};

/// The moves as segments from `start`: each begins where the one before ends, and the last one ends
/// at `goal` itself (which the moves reach but for rounding).
std::vector<kinematics::Segment> segments_of(const geometry::Pose2& start,
                                             const std::vector<Move>& moves,
                                             const geometry::Pose2& goal);

}  // namespace pulseline::planning
