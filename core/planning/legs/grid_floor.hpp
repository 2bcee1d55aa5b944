#pragma once

#include <vector>

#include "core/kinematics/motion.hpp"
#include "core/planning/grid/grid_map.hpp"
#include "core/planning/roads/closed_floor.hpp"
#include "core/planning/room/floor_field.hpp"
#include "core/planning/room/footprint_check.hpp"

namespace pulseline::planning {

/// The free floor of a hall as one body has it: cells for the grid search, with a layer for each
/// heading and one for turning, and the tests for ways between them. Cells stand 0.25 m apart, more
/// in a hall of which there would be too many.
///
/// A cell is free for a heading when the body there keeps its clearance, from half a cell before to
/// half a cell behind along that heading; it may turn where the circle around the body does. What
/// is free here is free by `Obstacles`.
/// Thread safety: an unchanging one may be read by any number of threads.
class GridFloor {
public:
    /// Costs some 0.1 s for a hall of 120 m x 60 m.
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
    bool may_turn_at(geometry::Point2 at) const {
        return turning_.is_free(field_, {at.x_m, at.y_m, 0});
    }
    bool is_free(const geometry::Pose2& pose) const { return body_.is_free(field_, pose); }
    /// Whether the body may go straight from `from` to `to`, its heading unchanged.
    bool is_free(const geometry::Pose2& from, geometry::Point2 to) const;
    double reach_m() const { return body_.reach_m(); }

private:
    GridLayers all_layers() const;
    void look_at(Cell cell, GridLayers& layers) const;
    void close(const geometry::Polygon& piece, GridLayers& layers);
    bool fits_along(geometry::Point2 at, int heading) const;

    FloorField field_;
    FootprintCheck body_;
    FootprintCheck turning_;  // the circle around the body
    std::vector<ClosedFloor> closed_;
    double cell_m_;
    int width_;
    int height_;
    GridMap map_;
};

}  // namespace pulseline::planning
