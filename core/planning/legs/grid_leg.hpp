#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <string>

#include "core/planning/grid/grid_search.hpp"
#include "core/planning/legs/free_leg.hpp"
#include "core/planning/legs/grid_floor.hpp"

namespace pulseline::planning {

/// Floors that were looked at before, for all planners of a plant. What is kept is what would be
/// worked out again, so no answer depends on it.
/// Thread safety: every function.
class GridFloors {
public:
    struct Of {
        plant::HallId hall;
        Body body;
        std::string closed;  // in words; empty: nothing is
        bool operator==(const Of&) const = default;
    };
    std::shared_ptr<const GridFloor> find(const Of& of);
    void keep(Of of, std::shared_ptr<const GridFloor> floor);

private:
    struct Known {
        Of of;
        std::shared_ptr<const GridFloor> floor;
    };
    std::mutex mutex_;
    std::deque<Known> known_;  // last used first
};

/// Legs over free floor, found by the turn-aware search over the hall's cells (Li 2022, eq. 10) and
/// made drivable: straights with turns on the spot between them, without needless corners.
/// Thread safety: none.
class GridLegs {
public:
    /// REQUIRES: `halls` outlives it.
    explicit GridLegs(FreeLegs& halls) : halls_(halls), floors_(std::make_shared<GridFloors>()) {}
    /// Shares the floors of `other`, which is of the same plant.
    GridLegs(FreeLegs& halls, const GridLegs& other) : halls_(halls), floors_(other.floors_) {}

    /// From where the vehicle stands to the station: round closed floor where there is room, else
    /// over it. Errors (Errc::kUnreachable): no_floor_way {from, to, blocked_by: start | goal |
    /// obstacles}; routing_cost_invalid, unknown_hall.
    Result<LegDraft> draft(const LegTask& task);

private:
    std::shared_ptr<const GridFloor> open_floor(const FreeFloor& hall, const Body& body);
    Result<LegDraft> draft_on(const LegTask& task, const GridFloor& floor);

    FreeLegs& halls_;
    std::shared_ptr<GridFloors> floors_;
    GridSearch search_;
    GridRoute route_;
};

}  // namespace pulseline::planning
