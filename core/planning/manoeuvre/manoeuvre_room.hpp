#pragma once

#include <optional>
#include <vector>

#include "core/planning/manoeuvre/steering.hpp"
#include "core/planning/roads/roadmap_index.hpp"
#include "core/planning/room/footprint_check.hpp"
#include "core/planning/room/obstacles.hpp"
#include "core/planning/room/standing_body.hpp"

namespace pulseline::planning {

/// The room that one body has for one manoeuvre: fast tests for the search, exact ones for its
/// ends and for what is found. Counts its work, which bounds every search the same on any machine.
/// Thread safety: none, not even for const methods: they count. One room a request.
class ManoeuvreRoom {
public:
    /// Of the hall and the vehicle type, built once. All of it outlives the room.
    struct Floor {
        const Obstacles& obstacles;
        const FloorField& field;
        const Body& body;
        const FootprintCheck& check;  // of the body, with at least kMargin_m over its clearance
    };
    /// What a found way is checked with stands out by up to 8 mm (conflict_along), and
    /// between two tested places a body may come nearer by (step / 2)^2 / (2 clearance).
    static constexpr double kMargin_m = 0.012;

    ManoeuvreRoom(const Floor& floor, const std::vector<StandingBody>& standing,
                  const geometry::Pose2& start, const geometry::Pose2& goal);
    /// Makes the standing bodies part of the field: worth its 0.1 ms for each body before thousands
    /// of tests.
    void map_standing();

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

    /// With the standing bodies once they are mapped.
    const FloorField& field() const { return field_; }
    /// Greatest disc about the body's origin that lies in the body, with the clearance.
    double inner_radius_m() const { return inner_radius_m_; }
    double reach_m() const { return floor_.check.reach_m(); }
    /// Work done so far, in tests of the body; others add theirs.
    long work() const { return work_; }
    void add_work(long tests) const { work_ += tests; }

private:
    bool near_an_end(const geometry::Pose2& pose) const;
    std::vector<geometry::Polygon> placed(const geometry::Pose2& pose) const;

    std::optional<Conflict> conflict_on(const kinematics::Segment& segment) const;
    double standing_slack_m(const geometry::Pose2& pose, double enough_m) const;

    struct Circle {
        geometry::Point2 centre;
        double radius_m = 0;
    };
    Floor floor_;
    const std::vector<StandingBody>& standing_;
    geometry::Pose2 start_;
    geometry::Pose2 goal_;
    FloorField field_;
    bool standing_in_field_ = false;
    std::vector<Circle> around_;  // one per standing body
    double inner_radius_m_ = 0;
    Obstacles::Limits limits_;
    std::vector<double> standing_limits_;  // one per body
    bool tight_ends_ = false;              // the fast test finds no room at an end
    mutable long work_ = 0;
};

}  // namespace pulseline::planning
