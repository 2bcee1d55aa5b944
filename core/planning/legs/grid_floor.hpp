#pragma once

#include <vector>

#include "core/kinematics/motion.hpp"
#include "core/planning/grid/grid_map.hpp"
#include "core/planning/roads/closed_floor.hpp"
#include "core/planning/room/floor_field.hpp"
#include "core/planning/room/footprint_check.hpp"

namespace pulseline::planning {

/// The free floor of a hall as one body has it: cells for the grid search, with a layer for each
/// heading and one for turning, and the tests for ways between them. Cells stand 0.3 m apart, more
/// in a hall of which there would be too many.
///
/// A cell is free for a heading when the body there keeps its clearance, from half a cell before to
/// half a cell behind along that heading; it may turn where the circle around the body does. What
/// is free here is free by `Obstacles`.
/// Thread safety: an unchanging one may be read by any number of threads.
class GridFloor {
public:
    /// Costs some 50 ms for a hall of 120 m x 60 m.
    GridFloor(const FloorField& field, const Body& body);
    /// The same floor with some of it closed, of this hall. Looks at what is near that only.
    GridFloor with(std::vector<ClosedFloor> closed) const;
    const std::vector<ClosedFloor>& closed() const { return closed_; }

    const GridMap& map() const { return map_; }
    double cell_m() const { return cell_m_; }
    /// That holds the place; perhaps outside the map.
    Cell cell_at(geometry::Point2 at) const;
    geometry::Point2 centre_of(Cell cell) const;

    /// Whether the cell is free whatever the body does there.
    bool is_roomy(Cell cell) const {
        return map_.inside(cell) && !map_.layers().no_turn.test(cell);
    }
    /// False: no way leads from one cell to the other, so that no search has to find that out.
    /// REQUIRES: both are inside the map.
    bool may_join(Cell a, Cell b) const { return part_of(a) == part_of(b); }
    bool may_turn_at(geometry::Point2 at) const {
        return turning_slack_m(at) >= 0 || turning_.is_free(field_, {at.x_m, at.y_m, 0});
    }
    bool is_free(const geometry::Pose2& pose) const {
        return turning_slack_m(pose.position()) >= 0 || body_.is_free(field_, pose);
    }
    /// Whether the body may go straight from `from` to `to`, its heading unchanged.
    bool is_free(const geometry::Pose2& from, geometry::Point2 to) const;
    /// True: the body may turn there from one heading by `turn_rad`, and the swept area keeps
    /// clear, too. False: the fast test does not know.
    bool may_turn_by(const geometry::Pose2& from, double turn_rad) const;
    double reach_m() const { return body_.reach_m(); }

private:
    /// >= 0: the circle around the body is free, and so it is as far away. One read, which knows
    /// nothing of circles that are larger than what the field tells of.
    double turning_slack_m(geometry::Point2 at) const {
        return field_.distance_m(at) - turning_needed_m_;
    }
    bool is_band_free(const geometry::Pose2& from, geometry::Point2 to) const;
    GridLayers all_layers() const;
    void look_at(Cell cell, GridLayers& layers) const;
    void close(const geometry::Polygon& piece, GridLayers& layers);
    int& part_of(Cell cell) { return parts_[map_.layers().index(cell)]; }
    int part_of(Cell cell) const { return parts_[map_.layers().index(cell)]; }
    void find_parts();
    void fill_part(Cell first, int number);
    bool fits_along(geometry::Point2 at, int heading) const;

    FloorField field_;
    std::vector<geometry::Polygon> pieces_;  // of the body
    FootprintCheck body_;
    FootprintCheck turning_;   // the circle around the body
    FootprintCheck swinging_;  // the body, with what the hulls of a turn stand out
    double turning_needed_m_;
    std::vector<ClosedFloor> closed_;
    double cell_m_;
    int width_;
    int height_;
    GridMap map_;
    std::vector<int> parts_;  // by cell, of the floor whatever the heading; 0: never free
};

}  // namespace pulseline::planning
