#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/traffic/tiles.hpp"

/// Plain data about traffic: what a snapshot keeps and what the monitor is told.
namespace pulseline::traffic {

using VehicleIndex = std::uint32_t;
using PlaceIndex = std::uint32_t;  // dense handle of a place, within one graph
using GraphIndex = std::uint32_t;
using ClosureIndex = std::uint32_t;
using VisitIndex = std::uint16_t;
/// Counts a vehicle's moves since it joined: the first has number 1, and numbers never repeat.
using MoveNumber = std::uint32_t;

constexpr PlaceIndex kNoPlace = std::numeric_limits<PlaceIndex>::max();
constexpr GraphIndex kNoGraph = std::numeric_limits<GraphIndex>::max();
constexpr MoveNumber kForever = std::numeric_limits<MoveNumber>::max();
constexpr VisitIndex kNoVisit = std::numeric_limits<VisitIndex>::max();

/// A move of a vehicle; as an edge of the precedence graph: "once that move is passed".
struct MoveRef {
    VehicleIndex vehicle = 0;
    MoveNumber move = 0;  // kForever: the vehicle stands there at the end of its plan
    friend bool operator==(const MoveRef&, const MoveRef&) = default;
};

/// Whether an idle vehicle leaves where it stands when another's task needs the floor: those that
/// have nothing to do first, those that had better stay only where nobody else can help.
enum class Leaves { kNever, kLast, kFirst };

/// A stop to make on the way, in the vehicle's graph.
struct Visit {
    PlaceIndex place = kNoPlace;
    double dwell_s = 0;
    friend bool operator==(const Visit&, const Visit&) = default;
};

enum class BlockCause {
    kVehicle,      // another vehicle holds the tile or comes first
    kClosed,       // the tile is closed
    kNoRoute,      // the graph has no way
    kSearchLimit,  // the search was cut off
    kCycle,        // the plan would have closed a circle of waits
    kHalted,       // the vehicle itself is halted
};

/// Who or what keeps a vehicle from a plan or from its next grant.
struct Block {
    BlockCause cause = BlockCause::kNoRoute;
    VehicleIndex vehicle = 0;    // kVehicle
    MoveNumber move = 0;         // of that vehicle; kForever: it stands there with no plan to leave
    std::optional<TileId> tile;  // kVehicle, kClosed
    friend bool operator==(const Block&, const Block&) = default;
};

struct MoveRecord {
    TileSet swept;
    TileSet stand;
    PlaceIndex place = kNoPlace;
    VisitIndex visit = kNoVisit;
    double duration_s = 0;
    double start_s = 0;
    double end_s = 0;
    std::int64_t rank = 0;  // place in one order of all moves that agrees with all tiles' orders
    friend bool operator==(const MoveRecord&, const MoveRecord&) = default;
};

struct StoredStand {
    std::string name;
    GraphIndex graph = kNoGraph;
    TileSet stand;
    PlaceIndex place = kNoPlace;
    MoveNumber passed = 0;
    MoveNumber released = 0;
    std::vector<MoveRecord> moves;  // behind `passed`; the first released - passed are the base
    double since_s = 0;
    bool halted = false;
    bool gone = false;
    Leaves leaves = Leaves::kNever;
    std::vector<Visit> visits;  // of its task
    std::vector<PlaceIndex> resting;
    VisitIndex next_visit = 0;
    double admitted_s = 0;
    std::uint64_t purpose = 0;              // of its task
    std::vector<PlaceIndex> later;          // of its task
    std::vector<VehicleIndex> moved_aside;  // for that purpose
    std::optional<VehicleIndex> makes_way_for;
    bool postponed = false;  // it gives way: its plan leaves out visits or way to rest for now
    double tried_s = -1e9;   // last search by improve()
    std::optional<Block> blocked_by;
    friend bool operator==(const StoredStand&, const StoredStand&) = default;
};

struct ClosureRecord {
    TileSet tiles;
    bool open = false;  // reopened; the handle is not given again
    friend bool operator==(const ClosureRecord&, const ClosureRecord&) = default;
};

/// All that traffic knows, without handles of its own: enough to rebuild it after a restart. Move
/// graphs are not in it; they come from the plant and are added again in the same order.
struct TrafficRecord {
    std::vector<StoredStand> vehicles;
    std::vector<ClosureRecord> closures;
    double predicted_s = -1;         // time of the predictions in the moves; -1: out of date
    std::vector<TileId> tile_order;  // as the tiles became known; decides between equals
    friend bool operator==(const TrafficRecord&, const TrafficRecord&) = default;
};

/// One change of traffic, as the monitor is told it.
struct Change {
    enum class Kind {
        kStand,     // the vehicle stands on `tiles` and has no moves any more (joined, found, gone)
        kPlan,      // behind `number` released moves its plan is now `moves`
        kWaits,     // moves[i] have new waits_for; nothing else of them changed
        kReleased,  // moves up to `number` are granted
        kPassed,    // moves up to `number` are behind it
        kHalted,
        kResumed,
        kClosed,    // `tiles`
        kReopened,  // `tiles`
    };
    struct PlanMove {
        MoveNumber number = 0;
        TileSet swept;
        TileSet stand;
        std::vector<MoveRef> waits_for;
    };
    Kind kind = Kind::kStand;
    VehicleIndex vehicle = 0;
    MoveNumber number = 0;
    TileSet tiles;
    std::vector<PlanMove> moves;
};

}  // namespace pulseline::traffic
