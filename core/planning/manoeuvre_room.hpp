#pragma once

#include <optional>
#include <vector>

#include "core/planning/footprint_check.hpp"
#include "core/planning/leg_planner.hpp"
#include "core/planning/obstacles.hpp"
#include "core/planning/steering.hpp"

namespace pulseline::planning {

/// The room that one body has for one manoeuvre: fast tests for the search, exact ones for its
/// ends and for what is found. Counts its work, which bounds every search the same on any machine.
class ManoeuvreRoom {
public:
    struct Floor {  // of the hall, built once
        const Obstacles& obstacles;
        const FloorField& field;
    };
    /// `body`: convex pieces, body frame.
    ManoeuvreRoom(const Floor& floor, std::vector<geometry::Polygon> body, double clearance_m,
                  const std::vector<StandingBody>& standing, const geometry::Pose2& start,
                  const geometry::Pose2& goal);

    /// >= 0: free, and so is every place to which no point of the body moves farther than that.
    double slack_m(const geometry::Pose2& pose) const;
    bool is_free(const geometry::Pose2& pose) const { return slack_m(pose) >= 0; }
    bool is_free(const geometry::Pose2& from, const Move& move) const;
    bool is_free(const geometry::Pose2& from, const Way& way) const;

    /// What comes too near, by the exact distances of polygons. An obstacle or vehicle that the
    /// body already stands nearer to at the start may stay as near (see Obstacles::limits_from).
    struct Conflict {
        Approach by;
        double limit_m = 0;
    };
    std::optional<Conflict> conflict(const std::vector<geometry::Polygon>& pieces) const;
    std::optional<Conflict> conflict_at(const geometry::Pose2& pose) const;
    std::optional<Conflict> conflict_along(const std::vector<kinematics::Segment>& segments) const;

    const FloorField& field() const { return field_; }
    /// Greatest disc about the body's origin that lies in the body, with the clearance.
    double inner_radius_m() const { return inner_radius_m_; }
    double reach_m() const { return check_.reach_m(); }
    long work() const { return work_; }

private:
    bool near_an_end(const geometry::Pose2& pose) const;
    std::vector<geometry::Polygon> placed(const geometry::Pose2& pose) const;

    const Obstacles& obstacles_;
    const std::vector<StandingBody>& standing_;
    std::vector<geometry::Polygon> body_;
    double clearance_m_;
    geometry::Pose2 start_;
    geometry::Pose2 goal_;
    FloorField field_;
    FootprintCheck check_;
    double inner_radius_m_ = 0;
    Obstacles::Limits limits_;
    std::vector<double> standing_limits_;  // one per body
    bool tight_ends_ = false;              // the fast test finds no room at an end
    mutable long work_ = 0;
};

}  // namespace pulseline::planning
