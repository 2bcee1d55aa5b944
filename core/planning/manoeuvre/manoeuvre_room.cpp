#include "core/planning/manoeuvre/manoeuvre_room.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Polygon;
using geometry::Pose2;

constexpr double kStandOut_m = 0.004;  // of a finely swept area
constexpr double kLeastAdvance_m = 0.08;
// As for obstacles (Obstacles::limits_from): a start is measured again, nearer nothing drives.
constexpr double kLeaving_m = 0.010;
constexpr double kLeast_m = 0.10;
constexpr double kRounding_m = 1e-9;

Point2 middle_of(const StandingBody& body) {
    Point2 sum;
    double count = 0;
    for (const Polygon& outline : body.outline) {
        for (const Point2& p : outline) {
            sum = sum + p;
            ++count;
        }
    }
    return (1 / std::max(1.0, count)) * sum;
}

double inner_radius(const std::vector<Polygon>& body) {
    double most = 0;
    for (const Polygon& piece : body) {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < piece.size(); ++i) {
            const Point2 edge = piece[(i + 1) % piece.size()] - piece[i];
            least = std::min(least, cross(edge, Point2{} - piece[i]) / norm(edge));
        }
        most = std::max(most, least);
    }
    return most;
}

}  // namespace

ManoeuvreRoom::ManoeuvreRoom(const Floor& floor, const std::vector<StandingBody>& standing,
                             const Pose2& start, const Pose2& goal)
    : floor_(floor),
      standing_(standing),
      start_(start),
      goal_(goal),
      field_(floor.field),
      limits_(floor.obstacles.limits_from(placed(start), floor.body.clearance_m)) {
    const auto at_start = placed(start);
    const double clearance_m = floor.body.clearance_m;
    for (const StandingBody& other : standing_) {
        const double d = distance_to(other, at_start, clearance_m);
        standing_limits_.push_back(d < clearance_m ? std::max(kLeast_m, d - kLeaving_m)
                                                   : clearance_m);
        Circle around{middle_of(other), 0};
        for (const Polygon& outline : other.outline) {
            for (const Point2& p : outline) {
                around.radius_m = std::max(around.radius_m, geometry::distance(p, around.centre));
            }
        }
        around_.push_back(around);
    }
    // From a tight start the limits of what it stands near hold, and these are at least kLeast_m.
    const auto fits = [&](const Pose2& pose) {
        return floor.check.is_free(field_, pose) && standing_slack_m(pose, 0) >= 0;
    };
    tight_ends_ = !fits(start) || !fits(goal);
    inner_radius_m_ = inner_radius(floor.body.pieces) + (tight_ends_ ? kLeast_m : clearance_m);
}

void ManoeuvreRoom::map_standing() {
    if (standing_in_field_) return;
    for (const StandingBody& other : standing_) field_.add(other.outline);
    standing_in_field_ = true;
    // The field is stricter than the exact distances that have passed the ends.
    tight_ends_ |= !floor_.check.is_free(field_, start_) || !floor_.check.is_free(field_, goal_);
}

double ManoeuvreRoom::standing_slack_m(const Pose2& pose, double enough_m) const {
    double least = enough_m;
    const double kept_m = floor_.body.clearance_m + kMargin_m;
    std::vector<Polygon> pieces;
    for (std::size_t i = 0; i < standing_.size(); ++i) {
        const double apart = geometry::distance(pose.position(), around_[i].centre) -
                             around_[i].radius_m - reach_m() - kept_m;
        if (apart >= least) continue;
        if (apart >= 0) {
            least = apart;
            continue;
        }
        if (pieces.empty()) pieces = placed(pose);
        least = std::min(least, distance_to(standing_[i], pieces, least + kept_m) - kept_m);
        if (least < 0) return least;
    }
    return least;
}

std::vector<Polygon> ManoeuvreRoom::placed(const Pose2& pose) const {
    std::vector<Polygon> pieces;
    for (const Polygon& piece : floor_.body.pieces)
        pieces.push_back(geometry::transformed(pose, piece));
    return pieces;
}

bool ManoeuvreRoom::near_an_end(const Pose2& pose) const {
    const double near_m = 2 * reach_m();
    return geometry::distance(pose.position(), start_.position()) < near_m ||
           geometry::distance(pose.position(), goal_.position()) < near_m;
}

double ManoeuvreRoom::slack_m(const Pose2& pose) const {
    ++work_;
    double slack = floor_.check.slack_m(field_, pose);
    if (slack >= 0 && !standing_in_field_) slack = standing_slack_m(pose, slack);
    if (slack >= 0 || !tight_ends_ || !near_an_end(pose)) return slack;
    work_ += 20;
    return conflict_at(pose) ? slack : 0;
}

bool ManoeuvreRoom::is_free(const Pose2& from, const Move& move) const {
    const double farthest_m = farthest_moved_m(move, reach_m());
    double done_m = 0;
    while (done_m < farthest_m) {
        const double slack = slack_m(moved(from, move, done_m / farthest_m));
        if (slack < 0) return false;
        done_m += std::max(slack, kLeastAdvance_m);
    }
    return is_free(moved(from, move));
}

bool ManoeuvreRoom::is_free(const Pose2& from, const Way& way) const {
    std::array<Pose2, 6> at{from};
    for (int i = 0; i < way.count; ++i) {  // the corners first: most blocked ways end here
        const auto k = static_cast<std::size_t>(i);
        at[k + 1] = moved(at[k], way.moves[k]);
        if (!is_free(moved(at[k], way.moves[k], 0.5)) || !is_free(at[k + 1])) return false;
    }
    for (int i = 0; i < way.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (!is_free(at[k], way.moves[k])) return false;
    }
    return true;
}

std::optional<ManoeuvreRoom::Conflict> ManoeuvreRoom::conflict(
    const std::vector<Polygon>& pieces) const {
    if (const auto by = floor_.obstacles.violation(pieces, limits_)) {
        return Conflict{*by, floor_.body.clearance_m};
    }
    for (std::size_t i = 0; i < standing_.size(); ++i) {
        const double d = distance_to(standing_[i], pieces, standing_limits_[i]);
        if (d >= standing_limits_[i] - kRounding_m) continue;
        return Conflict{{d, standing_[i].vehicle.str(), middle_of(standing_[i])},
                        floor_.body.clearance_m};
    }
    return std::nullopt;
}

std::optional<ManoeuvreRoom::Conflict> ManoeuvreRoom::conflict_at(const Pose2& pose) const {
    return conflict(placed(pose));
}

std::optional<ManoeuvreRoom::Conflict> ManoeuvreRoom::conflict_along(
    const std::vector<kinematics::Segment>& segments) const {
    for (const kinematics::Segment& segment : segments) {
        if (auto by = conflict_on(segment)) return by;
    }
    return std::nullopt;
}

/// The hull of a step joins the foremost corner after it with the rearmost one before it, and so
/// stands out on the inner side of a turn by half the body's length times half the step: 0.14 m for
/// a platform of 10.5 m. Where that is too much the turn is halved, and at last swept finely.
std::optional<ManoeuvreRoom::Conflict> ManoeuvreRoom::conflict_on(
    const kinematics::Segment& segment) const {
    constexpr kinematics::SweepDetail kCoarse;
    const auto by = conflict(kinematics::sweep(floor_.body.pieces, {segment}, kCoarse));
    if (!by || segment.turn_rad == 0) return by;
    if (std::abs(segment.turn_rad) <= kCoarse.step_rad) {
        const kinematics::SweepDetail fine{.step_rad = 2 * kStandOut_m / reach_m(),
                                           .excess_m = kStandOut_m};
        return conflict(kinematics::sweep(floor_.body.pieces, {segment}, fine));
    }
    for (const double share : {0.0, 0.5}) {
        kinematics::Segment half = segment;
        half.start = kinematics::pose_at(segment, share);
        half.end = kinematics::pose_at(segment, share + 0.5);
        half.turn_rad /= 2;
        half.length_m /= 2;
        if (auto still = conflict_on(half)) return still;
    }
    return std::nullopt;
}

}  // namespace pulseline::planning
