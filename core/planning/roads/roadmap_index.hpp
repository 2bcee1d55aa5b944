#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/planning/roads/lane_lines.hpp"
#include "core/planning/roads/road_search.hpp"
#include "core/planning/room/obstacles.hpp"

/// The plant's roadmap made ready for searches: numbers instead of keys, each lane forwards and
/// backwards, and for every vehicle type which lanes and which turns at nodes its body fits.
namespace pulseline::planning {

/// A body on the roadmap: convex pieces in the body frame, and the distance it keeps.
struct Body {
    std::vector<geometry::Polygon> pieces;
    double clearance_m = 0;
    friend bool operator==(const Body&, const Body&) = default;
};
Body body_of(const plant::VehicleType& type, bool loaded);

/// What one body may drive on. An arc is closed when its lane is too narrow or not for the type.
struct Passage {
    Body body;
    std::vector<char> arc_free;                // by arc: the body fits
    std::vector<char> arc_allowed;             // by arc: the lane is for this type
    std::vector<std::vector<char>> turn_free;  // by node: (heading, heading) at the node
    /// By arc, CodeReach::mean_sigma_m; empty: the plant does not say what that costs.
    std::vector<double> arc_sigma_m;

    double sigma_m(int arc) const {
        return arc_sigma_m.empty() ? 0 : arc_sigma_m[static_cast<std::size_t>(arc)];
    }
};

class RoadmapIndex {
public:
    explicit RoadmapIndex(const plant::Plant& plant);

    const RoadGraph& graph() const { return graph_; }
    int node(const plant::NodeId& id) const;  // -1: none
    const plant::RoadmapNode& node(int index) const;
    const plant::RoadmapEdge& edge_of_arc(int arc) const;
    const LaneLines& lines() const { return lines_; }
    const Obstacles* obstacles(const plant::HallId& hall) const;
    const Obstacles* obstacles_of_node(int node) const;

    Passage passage(const plant::VehicleType& type, bool loaded) const;
    bool usable(const Passage& passage, int arc) const;
    /// Whether the body may drive `next` after `arc`: the turn on the spot between them is free.
    bool may_follow(const Passage& passage, int arc, int next) const;
    /// Floor that the body sweeps on an arc, in convex pieces.
    std::vector<geometry::Polygon> swept(const Body& body, int arc) const;
    /// How near the body comes to something on an arc that is too narrow for it.
    std::optional<Approach> narrow_place(const Passage& passage, int arc) const;

private:
    struct ArcEnds {
        int at_from = 0;  // number of the body's heading among the headings of that node
        int at_to = 0;
    };
    int heading_number(int node, double heading_rad);
    std::vector<char> headings_in_use(const Passage& passage, int node) const;
    std::vector<char> free_turns(const Passage& passage, int node) const;
    std::vector<double> sigmas(const plant::VehicleType& type, bool loaded) const;

    const plant::Plant& plant_;
    LaneLines lines_;
    RoadGraph graph_;
    std::unordered_map<plant::NodeId, int> node_by_id_;
    std::vector<int> edge_by_arc_;
    std::vector<ArcEnds> ends_;
    std::vector<std::vector<double>> headings_;  // by node: the body's headings there
    std::map<plant::HallId, Obstacles> obstacles_;
};

}  // namespace pulseline::planning
