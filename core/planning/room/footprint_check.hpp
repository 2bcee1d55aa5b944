#pragma once

#include <vector>

#include "core/planning/room/floor_field.hpp"

namespace pulseline::planning {

/// Fast test whether a body at a pose keeps its clearance to everything in a FloorField.
///
/// The body, and the floor nearer to it than the clearance, is covered by discs; a place is free
/// when each disc's centre is as far from everything as the disc's radius. Most poses are decided
/// by a few large discs, each of which stands for many.
/// Conservative: free here is free by `Obstacles` and by the exact distance of polygons. A body
/// that truly keeps clearance + excess_m(), to the border of the hall's map as well, is free here.
/// Thread safety: an unchanging check may be used by any number of threads.
class FootprintCheck {
public:
    /// `pieces`: convex, body frame. For places of `field` and of its copies.
    /// REQUIRES: the field reaches 0.5 m farther than the clearance, or nothing is ever free.
    FootprintCheck(const std::vector<geometry::Polygon>& pieces, double clearance_m,
                   const FloorField& field);

    /// >= 0: free, and any movement is free that takes no point of the body farther than this.
    /// < 0: not known to be free. Tells up to `enough_m` only.
    double slack_m(const FloorField& field, const geometry::Pose2& pose,
                   double enough_m = 1.0) const;
    bool is_free(const FloorField& field, const geometry::Pose2& pose) const {
        return slack_m(field, pose, 0) >= 0;
    }

    double clearance_m() const { return clearance_m_; }
    /// Greatest distance of a point of the body from its origin.
    double reach_m() const { return reach_m_; }
    /// How much farther than the clearance a body must stay at most to be found free: 10 mm (up to
    /// 80 mm for clearances below 70 mm) and what the field's lattice adds: 15 mm in all with half
    /// a metre of clearance and nodes 0.1 m apart.
    double excess_m() const { return edge_needed_m_ - clearance_m_; }

private:
    struct Disc {
        geometry::Point2 centre;  // body frame
        double radius_m = 0;
        double needed_m = 0;  // of the field at its centre
    };
    struct Group {
        Disc around;  // holds all of its discs
        std::vector<Disc> discs;
    };

    std::vector<Disc> cover(const geometry::Polygon& piece, double largest_m) const;
    void group(std::vector<Disc> discs, const FloorField& field);

    double clearance_m_;
    double edge_radius_m_;  // of the discs along the body's edges
    double edge_needed_m_;
    double reach_m_ = 0;
    std::vector<Group> groups_;
};

}  // namespace pulseline::planning
