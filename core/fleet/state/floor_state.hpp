#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/time.hpp"
#include "core/fleet/state/job_order.hpp"
#include "core/fleet/tables/floor_graph.hpp"
#include "core/traffic/monitor.hpp"
#include "core/traffic/traffic.hpp"

/// The floor that the fleet's vehicles share: its joint plan (core/traffic).
namespace pulseline::fleet {

/// What the fleet keeps of a vehicle about the floor; nothing of it is stored, all is rebuilt.
struct FloorStand {
    std::size_t of_class = 0;
    traffic::VehicleIndex vehicle = 0;
    /// Node k of the leg is reached when this many + k moves are passed.
    std::int64_t moves_before_leg = 0;
    bool leg_planned = false;           // the leg's moves are in the joint plan
    std::optional<Pose2> pose;          // where it was settled last; none: it holds no floor yet
    std::optional<Reason> conflict;     // it stands on another's floor
    std::optional<Time> next_try;       // of an admission that failed
    std::optional<Time> in_vain_since;  // its order has had no way since
    std::optional<Time> next_leave;     // of an idle vehicle that found no way to leave
    std::optional<Time> idle_since;
};

/// One on a hoist or on stands: those that carry something do not come there.
struct StandingLoad {
    plant::LoadId load;
    traffic::TileSet room;  // above the floor
    traffic::ClosureIndex in_traffic = 0;
};

struct Floor {
    explicit Floor(const std::vector<FloorClass>& of_plant) : classes(of_plant) {}

    traffic::Traffic traffic{true};  // reports its changes to the monitor
    traffic::Monitor monitor;
    const std::vector<FloorClass>& classes;  // of the plant's tables
    /// Set on the first violation that the monitor finds: nothing is granted any more.
    std::optional<Reason> stopped;
    std::optional<Time> improved;
    std::optional<Time> checked;
    std::map<plant::StationId, StandingLoad> standing_loads;
    bool loads_moved = true;  // `standing_loads` is to be brought up to date
};

}  // namespace pulseline::fleet
