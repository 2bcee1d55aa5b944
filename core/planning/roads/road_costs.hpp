#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "core/planning/roads/road_search.hpp"

namespace pulseline::planning {

/// What holds on one arc of the roadmap besides its geometry.
struct LaneRules {
    bool closed = false;
    bool too_narrow = false;                    // for the user's body
    double max_speed_mps = 0;                   // 0: none
    double max_speed_loaded_mps = 0;            // with a load, besides the other; 0: none
    std::uint64_t classes = ~std::uint64_t{0};  // vehicle classes that may drive it, as bits
    double sigma_m = 0;                         // expected uncertainty of the position on it
    friend bool operator==(const LaneRules&, const LaneRules&) = default;
};

/// Who drives.
struct RoadUser {
    std::uint64_t vehicle_class = 1;  // one bit
    bool loaded = false;
    double max_speed_mps = 0;                                // 0: none
    std::function<bool(int arc, int next)> may_follow = {};  // turns there is room for; none: all
};

/// What a route is to save. With the defaults of the last two it is the plant's cost exactly:
/// k_same x length + (k_diff - k_same) x reference step per change of direction, and what is
/// asked for driving where the position is uncertain.
struct RoadPreferences {
    plant::RoutingCost cost;
    // A lane that is driven slower than this costs as much as the length that this speed would have
    // covered in the same time; 0: speed does not count.
    double reference_speed_mps = 0;
    bool round_down = false;  // costs are never above the exact ones: bounds for other searches
};

/// Costs in thousandths of k.
using RoadCost = std::uint32_t;
constexpr RoadCost kNoWay = std::numeric_limits<RoadCost>::max();
constexpr RoadCost kMostRoadCost = 1u << 31;  // routes beyond count as none

/// What an arc costs a user, by reason.
struct ArcCost {
    RoadCost length = 0;
    RoadCost speed = 0;     // because of a limit below the reference speed
    RoadCost accuracy = 0;  // because the position is uncertain on it
    std::int64_t turn = 0;  // after a change of direction; never below minus the rest

    RoadCost straight() const { return length + speed + accuracy; }
    RoadCost turned() const { return static_cast<RoadCost>(straight() + turn); }
};
ArcCost arc_cost(const RoadPreferences& preferences, const RoadArc& arc, const LaneRules& rules,
                 const RoadUser& user);

enum class Bar : std::uint8_t { kNone, kClosed, kClass, kTooNarrow };
/// Why a user may not drive an arc.
Bar bar_of(const LaneRules& rules, const RoadUser& user);

}  // namespace pulseline::planning
