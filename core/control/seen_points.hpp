#pragma once

#include <set>
#include <utility>
#include <vector>

#include "core/control/scan.hpp"

namespace pulseline::control {

/// What scanners have seen, in cells of the hall frame: more than one scan shows, since a thing
/// hides its own back and leaves the field of view beside the vehicle. A cell through which a later
/// scan sees is forgotten, so that what has walked on leaves no wall behind.
/// Thread safety: none.
class SeenPoints {
public:
    static constexpr double kCell_m = 0.025;

    /// `hall_from_body`: where the vehicle takes itself to be when it scans.
    void take(const Scan& scan, const geometry::Pose2& hall_from_body);
    void forget() { cells_.clear(); }
    bool empty() const { return cells_.empty(); }
    /// Middles of the cells, in an order that depends on them alone.
    std::vector<geometry::Point2> points() const;

private:
    using Cell = std::pair<int, int>;
    std::set<Cell> cells_;
};

}  // namespace pulseline::control
