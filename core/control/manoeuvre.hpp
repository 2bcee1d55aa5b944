#pragma once

#include <vector>

#include "core/control/motion_compensation.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::control {

/// How near to the target a vehicle shall come, and how far from it it may get on the way.
struct AdjustmentLimits {
    double good_m = 0.002;  // inside both there is nothing to adjust
    double good_rad = radians(0.03);
    double reach_m = 0.1;  // of the body's centre from the target, at every moment
    double reach_rad = radians(1.0);
    int passes = 6;  // measured, moved, measured again
    /// Where the stop would be refused: outside, standing still is no choice, and more passes are
    /// made. 0: none, what is left is never refused.
    double accept_m = 0;
    double accept_rad = 0;
    int passes_outside = 12;  // twice as many while each comes nearer
};

/// True where a vehicle may not stay (AdjustmentLimits::accept_m).
bool is_outside(const Pose2& body_from_target, const AdjustmentLimits& limits);

/// Small moves that bring a standing vehicle nearer to a target.
struct Manoeuvre {
    std::vector<Move> moves;  // as wanted, not as commanded
    Pose2 leaves;             // the target seen from where the moves would end
    double badness = 0;       // of the expected end, as badness_of() counts
};

/// Square of a deviation in units of what is good: position and heading count alike.
double badness_of(const Pose2& body_from_target, const AdjustmentLimits& limits);

/// Moves below this, metres or radians, are not worth making.
double least_size(MoveKind kind);

/// True for a vehicle that can move sideways as it stands.
bool moves_sideways(const plant::VehicleType& type);

/// The moves of least expected badness within reach; none when standing still is best, and is
/// accepted.
///
/// Omnidirectional vehicles shift along both axes and turn, or do a part of that. The others do
/// what Li 2020, section 4.1, does, rotate - advance - rotate, forwards or backwards, with one or
/// two ways between the turns: with little room a sideways error takes two, one back along one
/// heading and one ahead along another, which shift the body by their length times the angle
/// between them (0.1 m each and 1 deg to either side: 3.5 mm). What is too far for one pass is
/// approached as near as goes.
///
/// Tried are headings of both ways spread over the reach, with the ways' lengths solved from the
/// target; each costs what it leaves and what its moves are expected to go wrong by
/// (MotionCompensation::expected_error), so long turns lose against short ways while a vehicle is
/// little known, and no move is made that spoils more than it mends; but from outside of what is
/// accepted any move is better than none: it may end inside, and teaches how the vehicle moves.
Manoeuvre best_manoeuvre(const plant::VehicleType& type, const Pose2& body_from_target,
                         const AdjustmentLimits& limits, const MotionCompensation& compensation);

}  // namespace pulseline::control
