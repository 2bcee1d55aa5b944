#pragma once

#include <optional>
#include <vector>

#include "core/kinematics/motion.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::planning {

/// What the lanes that a way follows ask of it and give it.
struct LaneTerms {
    double max_speed_mps = 0;  // the least of them; 0: none
    /// Room to go round something, the narrowest; none unless all of the way has it.
    std::optional<plant::Corridor> corridor;
};

/// The lanes of a plant as lines on the floor: what holds on a lane holds for every straight way
/// along it, whether it was planned along lanes or not.
/// Thread safety: any number of threads may ask the same one.
class LaneLines {
public:
    explicit LaneLines(const plant::Plant& plant);

    /// Of the lanes in the direction driven whose line is within kAtPlace_m of the straight `way`.
    LaneTerms along(const plant::HallId& hall, const kinematics::Segment& way) const;

private:
    struct Line {
        plant::HallId hall;
        geometry::Point2 from;
        geometry::Point2 ahead;  // unit vector
        double length_m = 0;
        LaneTerms terms;
    };
    std::vector<Line> lines_;  // that ask or give anything
};

}  // namespace pulseline::planning
