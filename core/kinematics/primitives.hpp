#pragma once

#include <vector>

#include "core/kinematics/motion.hpp"

/// Building blocks of motion plans: turns, straights and arcs appended one after the other.
namespace pulseline::kinematics {

/// Turns of at least this much are ordered as two, so that their direction cannot be mistaken.
constexpr double kSplitTurn_rad = radians(170.0);
/// Rounding: moves and turns below are dropped.
constexpr double kNothing = 1e-6;

/// Turn from one heading to another the short way; exactly half a turn goes counter-clockwise.
double shortest_turn_rad(double from_rad, double to_rad);

/// Turn on the spot by `turn_rad` (not wrapped), in two pieces when it is large.
void append_turn(std::vector<Segment>& segments, const Pose2& from, double turn_rad);
/// Straight to `target` with unchanged heading.
void append_straight(std::vector<Segment>& segments, const Pose2& from, Point2 target);
/// Arc by `turn_rad` about `centre` in pieces of at most 90 deg, ending at `target`.
void append_arc(std::vector<Segment>& segments, const Pose2& from, Point2 centre, double turn_rad,
                bool backwards, Point2 target);

/// True when the vehicle drives from one segment into the next without a stop.
bool runs_on(const Segment& before, const Segment& after);
/// Sets every duration: segments that run on share the time of one trapezoidal profile.
/// `max_speed_mps` holds one limit per segment; empty: the vehicle's own.
void set_durations(const plant::VehicleType& type, std::vector<Segment>& segments,
                   const std::vector<double>& max_speed_mps = {});
/// Sums of a finished list of segments.
MotionPlan summed(MotionMode mode, std::vector<Segment> segments);

}  // namespace pulseline::kinematics
