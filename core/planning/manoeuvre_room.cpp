#include "core/planning/manoeuvre_room.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Polygon;
using geometry::Pose2;

// What a found way is checked with stands out by up to 5 mm (kinematics::SweepDetail), and between
// two tested places a body may come nearer by (step / 2)^2 / (2 clearance).
constexpr double kMargin_m = 0.012;
constexpr double kLeastStep_m = 0.08;
// As for obstacles (Obstacles::limits_from): a start is measured again, nearer nothing drives.
constexpr double kLeaving_m = 0.010;
constexpr double kLeast_m = 0.10;
constexpr double kRounding_m = 1e-9;

double distance_to(const StandingBody& other, const std::vector<Polygon>& pieces, double stop_m) {
    double least = stop_m;
    for (const Polygon& outline : other.outline) {
        const auto box = geometry::bounding_box(outline);
        for (const Polygon& piece : pieces) {
            const auto own = geometry::bounding_box(piece);
            const double dx = std::max(box.min.x_m - own.max.x_m, own.min.x_m - box.max.x_m);
            const double dy = std::max(box.min.y_m - own.max.y_m, own.min.y_m - box.max.y_m);
            if (std::max(dx, dy) >= least) continue;
            least = std::min(least, geometry::distance(piece, outline));
        }
    }
    return least;
}

FloorField with(FloorField field, const std::vector<StandingBody>& standing) {
    for (const StandingBody& other : standing) field.add(other.outline);
    return field;
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

ManoeuvreRoom::ManoeuvreRoom(const Floor& floor, std::vector<Polygon> body, double clearance_m,
                             const std::vector<StandingBody>& standing, const Pose2& start,
                             const Pose2& goal)
    : obstacles_(floor.obstacles),
      standing_(standing),
      body_(std::move(body)),
      clearance_m_(clearance_m),
      start_(start),
      goal_(goal),
      field_(with(floor.field, standing)),
      check_(body_, clearance_m + kMargin_m, field_),
      limits_(floor.obstacles.limits_from(placed(start), clearance_m)) {
    const auto at_start = placed(start);
    for (const StandingBody& other : standing_) {
        const double d = distance_to(other, at_start, clearance_m);
        standing_limits_.push_back(d < clearance_m ? std::max(kLeast_m, d - kLeaving_m)
                                                   : clearance_m);
    }
    // From a tight start the limits of what it stands near hold, and these are at least kLeast_m.
    tight_ends_ = !check_.is_free(field_, start) || !check_.is_free(field_, goal);
    inner_radius_m_ = inner_radius(body_) + (tight_ends_ ? kLeast_m : clearance_m);
}

std::vector<Polygon> ManoeuvreRoom::placed(const Pose2& pose) const {
    std::vector<Polygon> pieces;
    for (const Polygon& piece : body_) pieces.push_back(geometry::transformed(pose, piece));
    return pieces;
}

bool ManoeuvreRoom::near_an_end(const Pose2& pose) const {
    const double near_m = 2 * check_.reach_m();
    return geometry::distance(pose.position(), start_.position()) < near_m ||
           geometry::distance(pose.position(), goal_.position()) < near_m;
}

double ManoeuvreRoom::slack_m(const Pose2& pose) const {
    ++work_;
    const double slack = check_.slack_m(field_, pose);
    if (slack >= 0 || !tight_ends_ || !near_an_end(pose)) return slack;
    work_ += 20;
    return conflict_at(pose) ? slack : 0;
}

bool ManoeuvreRoom::is_free(const Pose2& from, const Move& move) const {
    const double farthest_m = farthest_moved_m(move, check_.reach_m());
    double done_m = 0;
    while (done_m < farthest_m) {
        const double slack = slack_m(moved(from, move, done_m / farthest_m));
        if (slack < 0) return false;
        done_m += std::max(slack, kLeastStep_m);
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
    if (const auto by = obstacles_.violation(pieces, limits_)) return Conflict{*by, clearance_m_};
    for (std::size_t i = 0; i < standing_.size(); ++i) {
        const double d = distance_to(standing_[i], pieces, standing_limits_[i]);
        if (d >= standing_limits_[i] - kRounding_m) continue;
        Point2 middle;
        const auto& outline = standing_[i].outline.front();
        for (const Point2& p : outline) {
            middle = middle + (1.0 / static_cast<double>(outline.size())) * p;
        }
        return Conflict{{d, standing_[i].vehicle.str(), middle}, clearance_m_};
    }
    return std::nullopt;
}

std::optional<ManoeuvreRoom::Conflict> ManoeuvreRoom::conflict_at(const Pose2& pose) const {
    return conflict(placed(pose));
}

std::optional<ManoeuvreRoom::Conflict> ManoeuvreRoom::conflict_along(
    const std::vector<kinematics::Segment>& segments) const {
    return conflict(kinematics::sweep(body_, segments));
}

}  // namespace pulseline::planning
