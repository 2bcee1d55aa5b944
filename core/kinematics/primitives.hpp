#pragma once

#include <vector>

#include "core/kinematics/motion.hpp"
#include "core/kinematics/wheels.hpp"

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

/// Straight to `target` while the heading turns evenly by `turn_rad` (not wrapped), in pieces of
/// at most 90 deg.
void append_combined(std::vector<Segment>& segments, const Pose2& from, Point2 target,
                     double turn_rad);

/// Way of a segment by which it is driven: metres (Rotate: radians), never negative.
double size_of(const Segment& segment);

/// Motion of the body frame at share s of the way, per metre of it (Rotate: per radian).
Twist twist_along(const Segment& segment, double s);
/// Fastest that a segment may be driven, metres per second (Rotate: radians per second): body,
/// turning and every wheel stay within the type's limits. `max_speed_mps` 0: no further limit.
double max_rate(const plant::VehicleType& type, const Segment& segment, double max_speed_mps);
double max_accel(const plant::VehicleType& type, const Segment& segment);

/// True when the vehicle drives from one segment into the next without a stop.
bool runs_on(const Segment& before, const Segment& after);
/// End of the run that begins with segments[begin]: those that the vehicle drives without a stop
/// under one limit of `max_speed_mps`.
std::size_t run_end(const std::vector<Segment>& segments, std::size_t begin,
                    const std::vector<double>& max_speed_mps = {});
/// Sets every duration: segments that run on share the time of one trapezoidal profile; the first
/// of a run holds the time in which its steered wheels turn before it, from straight ahead for the
/// first run. `max_speed_mps` holds one limit per segment; empty: the vehicle's own.
void set_durations(const plant::VehicleType& type, std::vector<Segment>& segments,
                   const std::vector<double>& max_speed_mps = {});
/// Sums of a finished list of segments.
MotionPlan summed(MotionMode mode, std::vector<Segment> segments);

}  // namespace pulseline::kinematics
