#pragma once

#include <vector>

#include "core/planning/roads/closed_floor.hpp"
#include "core/planning/roads/road_router.hpp"
#include "core/planning/roads/roadmap_index.hpp"

namespace pulseline::planning {

/// The roadmap as the legs of one body search it: which arcs lead over closed floor, and exact
/// costs of what is left to a node. Tables are built when a node is first driven to and follow
/// closures when they are next used, so a query expands little more than its path.
///
/// Thread safety: none; left() builds tables.
class LegRoads {
public:
    /// REQUIRES: `roads` and `passage` outlive it unchanged.
    LegRoads(const RoadmapIndex& roads, const Passage& passage, const plant::RoutingCost& cost);
    LegRoads(const LegRoads&) = delete;
    LegRoads& operator=(const LegRoads&) = delete;

    void set_closures(const std::vector<ClosedFloor>& closures);
    bool closed(int arc) const { return router_.rules(arc).closed; }
    /// Closures that the arc leads over.
    const std::vector<std::size_t>& closures_on(int arc) const {
        return over_[static_cast<std::size_t>(arc)];
    }

    /// Costs of what is left to a node, in units of k: exact but for rounding, never above. Valid
    /// until closures change.
    class Left {
    public:
        /// After an arc; infinite when no way leads there.
        double after(int arc) const;

    private:
        friend class LegRoads;
        const CostTable* table_ = nullptr;
        double unit_ = 1;
    };
    Left left(int goal);

    RoadRouter& router() { return router_; }
    int user() const { return user_; }
    /// Cost in units of k as the router counts it.
    RoadCost counted(double cost_k) const;

private:
    const RoadmapIndex& roads_;
    const Passage& passage_;
    double unit_;  // k that one of the router's stands for: keeps any plant's k inside its range
    RoadRouter router_;
    int user_;
    std::vector<std::vector<std::size_t>> over_;  // by arc
};

}  // namespace pulseline::planning
