#pragma once

#include <map>
#include <vector>

#include "core/localisation/odometry_noise.hpp"
#include "core/planning/legs/road_leg.hpp"

namespace pulseline::planning {

/// How far a body drives without a code so that it still catches the next one, as its machine comes
/// from assembly.
class CodeReach {
public:
    CodeReach(const plant::VehicleType& type, bool loaded);
    const std::vector<plant::Camera>& cameras() const { return cameras_; }
    /// By localisation::blind_way_m, of its best camera. Kept once worked out: no const thread
    /// safety.
    double at_most_m(double size_m) const;

private:
    std::vector<plant::Camera> cameras_;
    localisation::OdometryNoise noise_;
    mutable std::map<double, double> at_most_m_;  // by size
};

/// Of a leg that drives these segments: the gap between codes that exceeds most, or falls short
/// least, what may lie between them. Without cameras or codes there is nothing to miss.
BlindWay blind_way(const LegTask& task, const std::vector<kinematics::Segment>& segments);

}  // namespace pulseline::planning
