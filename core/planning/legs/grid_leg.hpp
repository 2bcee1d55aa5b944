#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "core/planning/grid/grid_search.hpp"
#include "core/planning/legs/free_leg.hpp"
#include "core/planning/legs/grid_floor.hpp"

namespace pulseline::planning {

/// Whether a vehicle may leave the lanes for free floor: its type lists free manoeuvres, and linear
/// motion, of which such a leg consists.
bool may_drive_on_free_floor(const plant::VehicleType& type);

/// Legs over free floor, found by the turn-aware search over the hall's cells (Li 2022, eq. 10) and
/// made drivable: straights with turns on the spot between them, without needless corners. What
/// depends on hall, body and closed floor alone is kept.
/// Thread safety: none.
class GridLegs {
public:
    /// REQUIRES: `halls` outlives it.
    explicit GridLegs(FreeLegs& halls) : halls_(halls) {}
    /// Another one, of the same plant, that knows what `other` has looked at.
    GridLegs(const GridLegs& other, FreeLegs& halls) : halls_(halls), known_(other.known_) {}

    /// From where the vehicle stands to the station: round closed floor where there is room, else
    /// over it. Errors (Errc::kUnreachable): no_floor_way {from, to, blocked_by: start | goal |
    /// obstacles}; routing_cost_invalid, unknown_hall.
    Result<LegDraft> draft(const LegTask& task);

private:
    struct Known {
        plant::HallId hall;
        Body body;
        std::string closed;  // in words; empty: nothing
        std::shared_ptr<const GridFloor> floor;
    };
    std::shared_ptr<const GridFloor> find(const plant::HallId& hall, const Body& body,
                                          const std::string& closed);
    void keep(Known known);
    std::shared_ptr<const GridFloor> open_floor(const FreeFloor& hall, const Body& body);
    std::shared_ptr<const GridFloor> floor_with(const std::shared_ptr<const GridFloor>& open,
                                                const FreeFloor& hall, const Body& body,
                                                std::vector<ClosedFloor> closed);
    Result<LegDraft> draft_on(const LegTask& task, const GridFloor& floor);

    FreeLegs& halls_;
    std::deque<Known> known_;  // last used first
    GridSearch search_;
    GridRoute route_;
};

}  // namespace pulseline::planning
