#include "core/planning/roads/lane_lines.hpp"

#include <algorithm>
#include <map>

#include "core/planning/roads/motion_graph.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;

struct Stretch {
    double from_m = 0;
    double to_m = 0;
};

bool cover(std::vector<Stretch> stretches, double length_m) {
    std::sort(stretches.begin(), stretches.end(),
              [](const Stretch& a, const Stretch& b) { return a.from_m < b.from_m; });
    double until_m = 0;
    for (const Stretch& stretch : stretches) {
        if (stretch.from_m > until_m + kAtPlace_m) return false;
        until_m = std::max(until_m, stretch.to_m);
    }
    return until_m >= length_m - kAtPlace_m;
}

}  // namespace

LaneLines::LaneLines(const plant::Plant& plant) {
    std::map<plant::NodeId, const plant::RoadmapNode*> nodes;
    for (const auto& node : plant.nodes) nodes.emplace(node.id, &node);
    for (const auto& edge : plant.edges) {
        if (!edge.corridor && !(edge.max_speed_mps > 0)) continue;
        const auto from = nodes.find(edge.from);
        const auto to = nodes.find(edge.to);
        if (from == nodes.end() || to == nodes.end()) continue;  // validate() says so
        const Point2 start = from->second->position;
        const double length_m = geometry::distance(start, to->second->position);
        if (length_m < kAtPlace_m) continue;
        lines_.push_back({from->second->hall,
                          start,
                          (1 / length_m) * (to->second->position - start),
                          length_m,
                          {edge.max_speed_mps, edge.corridor}});
    }
}

LaneTerms LaneLines::along(const plant::HallId& hall, const kinematics::Segment& way) const {
    LaneTerms terms;
    const double length_m = std::abs(way.length_m);
    if (way.kind != kinematics::Segment::Kind::kStraight || length_m < kAtPlace_m) return terms;
    std::vector<Stretch> with_room;
    for (const Line& line : lines_) {
        if (line.hall != hall) continue;
        const Point2 start = way.start.position() - line.from;
        const Point2 end = way.end.position() - line.from;
        const double begins_m = dot(line.ahead, start);
        const double ends_m = dot(line.ahead, end);
        const double aside_m =
            std::max(std::abs(cross(line.ahead, start)), std::abs(cross(line.ahead, end)));
        // Shorter along the lane than it is: driven against it, or askew.
        if (aside_m > kAtPlace_m || ends_m - begins_m < length_m - kAtPlace_m) continue;
        const Stretch common{std::max(begins_m, 0.0) - begins_m,
                             std::min(ends_m, line.length_m) - begins_m};
        if (common.to_m - common.from_m < kAtPlace_m) continue;
        if (const double limit = line.terms.max_speed_mps; limit > 0) {
            terms.max_speed_mps =
                terms.max_speed_mps > 0 ? std::min(terms.max_speed_mps, limit) : limit;
        }
        if (const auto& room = line.terms.corridor) {
            with_room.push_back(common);
            auto& narrowest = terms.corridor;
            if (!narrowest) narrowest = room;
            narrowest->left_m = std::min(narrowest->left_m, room->left_m);
            narrowest->right_m = std::min(narrowest->right_m, room->right_m);
        }
    }
    if (!cover(std::move(with_room), length_m)) terms.corridor.reset();
    return terms;
}

}  // namespace pulseline::planning
