#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/traffic/move_graph.hpp"
#include "core/traffic/record.hpp"

/// The one complete joint plan (invariant D): every vehicle's moves up to its resting place and,
/// for every tile, the order in which vehicles use it.
namespace pulseline::traffic {

/// What "for ever" costs in a prediction: a halted vehicle's move, an entry into closed floor.
/// Finite, so that times behind it still order the moves; a plan that ends later than
/// kBlocked_s / 2 from now is blocked.
constexpr double kBlocked_s = 1e7;

struct PlannedMove {
    ShapePtr shape;
    PlaceIndex place = kNoPlace;  // where it ends, in the vehicle's graph
    VisitIndex visit = kNoVisit;  // set on the stop that fulfils a visit of the task
    double duration_s = 0;
    double start_s = 0;  // predicted
    double end_s = 0;
    std::vector<MoveRef> waits_for;  // moves of others that must be passed before this one's grant
    std::uint32_t stamp = 0;         // of the prediction that reached it last
    bool open = false;               // while a prediction works on it (a cycle shows here)
};

struct VehiclePlan {
    TileIndexes stand;  // where the last passed move ended
    PlaceIndex place = kNoPlace;
    MoveNumber passed = 0;
    MoveNumber released = 0;  // passed <= released
    MoveNumber dropped = 0;   // moves[0] has number dropped + 1
    std::vector<PlannedMove> moves;
    double since_s = 0;   // when the move under way could begin
    bool halted = false;  // broken down, or found at an unexpected place

    MoveNumber last() const { return dropped + static_cast<MoveNumber>(moves.size()); }
    PlannedMove& at(MoveNumber n) { return moves[n - dropped - 1]; }
    const PlannedMove& at(MoveNumber n) const { return moves[n - dropped - 1]; }
    const TileIndexes& stand_after(MoveNumber n) const {
        return n <= passed ? stand : at(n).shape->stand;
    }
    PlaceIndex place_after(MoveNumber n) const { return n <= passed ? place : at(n).place; }
};

/// One stay of a vehicle on a tile: from the grant of move `first` until move `last` is passed;
/// kForever when it ends its plan there.
struct Use {
    VehicleIndex vehicle = 0;
    MoveNumber first = 0;
    MoveNumber last = 0;
    friend bool operator==(const Use&, const Use&) = default;
};

/// Where new uses go in the order of a tile.
enum class Placement {
    kByTime,  // into the gaps that the predicted times of the new moves fall into
    kFirst,   // before all that is not granted yet; what lasts for ever goes last
};

/// Queues over tiles plus plans. The front of a tile's queue holds it as soon as its first move is
/// granted; a move may be granted when all its tiles have only the vehicle's own uses before it.
/// The edges of the precedence graph are "last move of one use is passed before the first move of
/// the next use is granted" for neighbours in a queue, and each vehicle's own sequence. The graph
/// without cycle + finite moves => some vehicle can always go on (Hoenig et al., RA-L 2019).
class JointPlan {
public:
    /// Undoes one `replace`: the queues and plans that it touched.
    struct Undo {
        VehicleIndex vehicle = 0;
        VehiclePlan plan;
        std::vector<std::pair<TileIndex, std::vector<Use>>> queues;
        std::vector<std::pair<MoveRef, std::vector<MoveRef>>> waits;
    };

    /// REQUIRES: nobody holds a tile of `stand` (see holder()).
    VehicleIndex add_vehicle(const TileIndexes& stand, PlaceIndex place, double now_s);
    /// Takes a vehicle out; its floor becomes free.
    void remove_vehicle(VehicleIndex vehicle);
    /// All moves behind the released ones give way to `moves`.
    Undo replace(VehicleIndex vehicle, std::vector<PlannedMove> moves, Placement placement);
    void undo(Undo undo);
    /// The granted moves fulfil no visits any more: their task is over.
    void forget_visits(VehicleIndex vehicle);
    /// True when no other has a stay behind the vehicle where its base ends.
    bool nobody_behind(VehicleIndex vehicle) const;
    /// True when no other has a stay behind the vehicle where its plan ends.
    bool ends_last(VehicleIndex vehicle) const;
    /// The vehicle stands elsewhere and has no plan any more. REQUIRES: no other holds the tiles.
    void move_stand(VehicleIndex vehicle, const TileIndexes& stand, PlaceIndex place, double now_s);
    /// Puts back plans as a record says. `ranks` orders the moves, per vehicle from passed + 1 on.
    /// False when two vehicles hold one tile.
    bool restore(std::vector<VehiclePlan> plans,
                 const std::vector<std::vector<std::int64_t>>& ranks);
    /// One order of all moves that agrees with every tile's order, as `restore` takes it.
    std::vector<std::vector<std::int64_t>> ranks() const;

    /// First tile that keeps move `n` from its grant now; none: it may be granted.
    std::optional<TileIndex> obstacle(VehicleIndex vehicle, MoveNumber n) const;
    void set_released(VehicleIndex vehicle, MoveNumber n, double now_s);
    /// Moves up to n are behind the vehicle, tail included. REQUIRES: n <= released.
    void pass(VehicleIndex vehicle, MoveNumber n, double now_s);
    void set_halted(VehicleIndex vehicle, bool halted, double now_s);

    void close(const TileIndexes& tiles);
    void open(const TileIndexes& tiles);
    bool is_closed(TileIndex tile) const { return tile < closed_.size() && closed_[tile] != 0; }
    /// First closed tile that keeps a vehicle from a move; none when it stands on closed floor,
    /// which it may leave.
    std::optional<TileIndex> closed_tile(const TileIndexes& stand, const Shape& shape) const;

    /// Predicts all moves from now on. False: the graph has a cycle.
    bool predict(double now_s);
    /// Predicts only what comes before the vehicle's last move, which finds every cycle that the
    /// vehicle's plan is part of.
    bool predict_before(VehicleIndex vehicle, double now_s);
    /// True when the present times prove that the plan of `undo.vehicle` closed no cycle: every
    /// edge at its moves goes forward in time.
    bool times_agree(const Undo& undo) const;

    std::size_t vehicle_count() const { return vehicles_.size(); }
    const VehiclePlan& plan(VehicleIndex vehicle) const { return vehicles_[vehicle]; }
    const std::vector<Use>& queue(TileIndex tile) const {
        static const std::vector<Use> kNobody;
        return tile < queues_.size() ? queues_[tile] : kNobody;
    }
    std::size_t tile_count() const { return queues_.size(); }
    std::optional<VehicleIndex> holder(TileIndex tile) const;
    TileIndexes held_tiles(VehicleIndex vehicle) const;
    /// Predicted time at which the vehicle has reached its resting place.
    double finish_s(VehicleIndex vehicle) const;
    // In the header, because searches ask them more than anything else.
    double start_of(const Use& use) const {
        const VehiclePlan& plan = vehicles_[use.vehicle];
        return use.first <= plan.released ? -std::numeric_limits<double>::infinity()
                                          : plan.at(use.first).start_s;
    }
    double end_of(const Use& use) const {
        return use.last == kForever ? std::numeric_limits<double>::infinity()
                                    : vehicles_[use.vehicle].at(use.last).end_s;
    }
    /// Plan changes of others that the last `replace` brought: moves with new waits_for.
    const std::vector<MoveRef>& touched_moves() const { return touched_moves_; }

    /// Shows a visitor all that counts, for snapshots. The stamp only tells one prediction's work
    /// from the next one's.
    template <class V, class Self>
    static void members(V& visit, Self& self) {
        auto& [vehicles, queues, closed, closed_now, touched_moves, stamp] = self;
        visit(vehicles, queues, closed, closed_now, touched_moves);
    }

private:
    struct OpenUse {
        TileIndex tile;
        Use use;
    };
    std::vector<OpenUse> uses_of(VehicleIndex vehicle) const;
    std::vector<TileIndex> tiles_of(VehicleIndex vehicle) const;
    void insert(TileIndex tile, const Use& use, Placement placement);
    void remove_uses(VehicleIndex vehicle, const std::vector<TileIndex>& tiles);
    void add_uses(VehicleIndex vehicle, Placement placement);
    void note_successors(VehicleIndex vehicle, const std::vector<TileIndex>& tiles);
    void rebuild_waits(MoveRef ref);
    void compact(VehiclePlan& plan);
    void begin_on_stands(VehiclePlan& plan);
    bool reach(MoveRef root, double now_s);
    bool work_out(MoveRef ref, double now_s, std::vector<MoveRef>& stack);
    void set_times(VehicleIndex vehicle, MoveNumber n, double now_s);
    std::vector<Use>& queue_for(TileIndex tile);

    std::vector<VehiclePlan> vehicles_;
    std::vector<std::vector<Use>> queues_;  // by tile
    std::vector<std::uint16_t> closed_;     // how many closed areas hold the tile
    std::size_t closed_now_ = 0;            // tiles that are closed
    std::vector<MoveRef> touched_moves_;
    std::uint32_t stamp_ = 0;
};

}  // namespace pulseline::traffic
