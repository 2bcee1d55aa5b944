#include "core/planning/legs/route_chain.hpp"

#include <cmath>

#include "core/kinematics/primitives.hpp"
#include "core/planning/legs/blind_way.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Pose2;

/// Lanes straight from node to node with turns on the spot between them, as legs drive them.
class RouteDrive {
public:
    explicit RouteDrive(const Pose2& start) : pose_(start) {}

    void go_to(Point2 target, bool backwards) {
        const Point2 way = target - pose_.position();
        if (norm(way) < kinematics::kNothing) return;
        turn_to(wrap(std::atan2(way.y_m, way.x_m) + (backwards ? kPi : 0)));
        kinematics::append_straight(segments_, pose_, target);
        pose_ = {target.x_m, target.y_m, pose_.heading_rad};
    }
    void turn_to(double heading_rad) {
        const double turn_rad = kinematics::shortest_turn_rad(pose_.heading_rad, heading_rad);
        kinematics::append_turn(segments_, pose_, turn_rad);
        pose_.heading_rad = heading_rad;
    }
    const std::vector<kinematics::Segment>& segments() const { return segments_; }

private:
    Pose2 pose_;
    std::vector<kinematics::Segment> segments_;
};

}  // namespace

std::optional<Result<LegChain>> route_chain(const plant::Plant& plant, const WhatIf& question,
                                            const WhatIfRoute& route) {
    const auto* type = plant::find_vehicle_type(plant, question.vehicle_type);
    const auto* from = plant::find_station(plant, question.from);
    const auto* to = plant::find_station(plant, question.to);
    if (!type || !from || !to) return std::nullopt;
    RouteDrive drive(from->pose);
    bool backwards = false;
    for (const WhatIfLeg& leg : route.legs) {
        const auto* node = plant::find_node(plant, leg.to);
        if (!node) return std::nullopt;
        backwards = leg.backwards;
        drive.go_to(node->position, backwards);
    }
    drive.go_to(to->pose.position(), backwards);
    drive.turn_to(to->pose.heading_rad);
    return leg_chain(plant, from->hall, CodeReach(*type, question.loaded), to, drive.segments());
}

}  // namespace pulseline::planning
