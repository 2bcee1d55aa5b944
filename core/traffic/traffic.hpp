#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "core/traffic/joint_plan.hpp"
#include "core/traffic/record.hpp"
#include "core/traffic/window_search.hpp"

/// Traffic: who may drive where, and in which order. The one interface of this folder for
/// core/fleet.
///
/// Words. A *move* is driven without a need to stop: it sweeps a set of tiles and ends standing on
/// a smaller one. A *plan* is a sequence of moves up to the vehicle's own resting place; stops at
/// stations are moves that sweep only their stand. The *base* is the granted prefix (VDA 5050:
/// released nodes), the rest is *horizon* and may change at any time.
///
///     Traffic traffic;
///     const GraphIndex small = traffic.add_graph(graph_of(plant, small_type));  // once a class
///     const VehicleIndex v = *traffic.add_vehicle({"AGV-1", small, parking_3, {}}, now);
///     Task task;
///     task.visits = {{station_7, 30.0}};                  // then to any resting place
///     if (auto admitted = traffic.admit(v, task, now); !admitted) show(admitted.error().reason);
///     const MoveNumber base = traffic.extend(v, 3, now);  // at most three moves ahead
///     send_base(v, traffic.plan(v), base);                // moves passed + 1 .. base
///     traffic.passed(v, 1, now);                          // the vehicle's report, tail included
///     traffic.improve(now, 4);                            // a few bounded steps when idle
///
/// Invariant S (safety). Tiles of a vehicle's stand and of its base have no other holder. A tile's
/// queue lists its stays in order; a grant happens only when for every tile of the move nothing but
/// the vehicle's own stays comes before it, and it is one assignment, so it is whole or not at all.
/// A tile is left only when the move that sweeps it last is reported passed. No time enters.
///
/// Invariant D (no deadlock). The queues and the vehicles' own sequences are a precedence graph of
/// moves. Every change keeps it free of cycles: plans that fit into the predicted gaps carry times
/// that prove it, all others pass a depth-first test or are undone. Sketch of the proof: a graph
/// without cycle has a first move that is not passed; everything it waits for is passed, so it is
/// granted (or the first grantable one before it is); it takes finite time; so every move is passed
/// one day, and all vehicles end at their resting places, which nobody else's plan needs. Halted
/// vehicles and closed floor break "finite time": whoever waits for them is blocked, with a reason,
/// but not deadlocked, and goes on once they end. Where the layout is well-formed
/// (layout_check.hpp) a way behind all present plans always exists, so admission never fails but
/// for disturbances. (Hoenig et al., "Persistent and robust execution of MAPF schedules", RA-L
/// 2019; Cap et al., "Complete decentralized method for on-line multi-robot trajectory planning in
/// well-formed infrastructures", ICAPS 2015; Phillips, Likhachev, "SIPP", ICRA 2011.)
///
/// Its functions stand in a file a section: admission.cpp (tasks; making_way.cpp where others have
/// to leave for them), grants.cpp, disturbances.cpp, improvement.cpp and improvement_steps.cpp,
/// prediction.cpp and waits.cpp (views), rebuild.cpp (records).
///
/// Deterministic: the same calls give the same state. No clock, thread or random source inside.
/// Thread safety: none; one owner. Copyable.
namespace pulseline::traffic {

/// Moves outside the graph, in a fixed order, from the end of the vehicle's base.
struct Sequence {
    struct Step {
        TileSet swept;  // tail included
        TileSet stand;  // at its end
        double duration_s = 0;
        VisitIndex visit = kNoVisit;  // this step is the stop of that visit
        PlaceIndex place = kNoPlace;  // of the graph, when it ends at one; its stand is the place's
    };
    std::vector<Step> steps;
    /// Where in the graph it ends, and the search goes on; kNoPlace: it ends at a resting place and
    /// makes all visits itself.
    PlaceIndex ends_at = kNoPlace;
};

constexpr double kSinceAdmission = -1;

struct Task {
    std::vector<Visit> visits;        // in this order; empty: only to a resting place
    std::vector<PlaceIndex> resting;  // where it may end; empty: any resting place of the graph
    /// Alternatives to begin with instead of the graph's moves. REQUIRED when the base ends at no
    /// place.
    std::vector<Sequence> sequences;
    bool may_delay_others = false;  // go before what others have not been granted, if need be
    bool asks_to_leave = true;      // idle ones make way for it; else it goes only where it can
    std::vector<PlaceIndex> later;  // it goes there after this task: who makes way rests elsewhere
    /// What the task is part of; nobody is asked twice to make way for one purpose. 0: for nothing.
    std::uint64_t purpose = 0;
    double since_s = kSinceAdmission;  // its age: the oldest task's end is never put off
};

struct Admission {
    double finish_s = 0;            // predicted arrival at the resting place
    bool behind_incumbent = false;  // the old plan is driven to its end first
    bool delays_others = false;
    std::vector<VehicleIndex> made_way;  // idle vehicles that got a plan to leave
    std::size_t labels = 0;              // work of the search
};

/// One edge of the wait-for graph: `vehicle` cannot be granted `move` now.
struct Wait {
    VehicleIndex vehicle = 0;
    MoveNumber move = 0;
    Block block;
    double until_s = 0;  // predicted; infinity when nothing known ends it
};

struct Improvement {
    std::vector<VehicleIndex> changed;  // have a new plan behind their base
    std::vector<VehicleIndex> blocked;  // tried without success; see waits() and blocked_by()
};

struct VehicleSpec {
    std::string name;
    GraphIndex graph = kNoGraph;  // kNoGraph: its tasks come with sequences
    PlaceIndex place = kNoPlace;  // of the graph
    TileSet stand;                // tiles under it; empty: those of the place
};

class Traffic {
public:
    /// `report_changes`: keep changes for the monitor until take_changes.
    explicit Traffic(bool report_changes = false) : report_changes_(report_changes) {}

    // --- set-up
    GraphIndex add_graph(const MoveGraph& graph);
    /// Errors: floor_held {vehicle, tile}: another holds floor there.
    Result<VehicleIndex> add_vehicle(const VehicleSpec& spec, Time now);
    /// Out of traffic; its floor is free at once. For a vehicle carried away.
    void remove_vehicle(VehicleIndex vehicle, Time now);

    /// Whether it leaves where it stands idle for another's task. Who does not is waited for; by
    /// the layout's condition that can only be at a place where the other wants to go. Who stands
    /// beside resting places, or gave way and waits at one, is asked all the same.
    void set_leaves(VehicleIndex vehicle, Leaves leaves) { vehicles_[vehicle].leaves = leaves; }
    /// For whose task its plan was made when it was last asked to make way; none since its own.
    std::optional<VehicleIndex> makes_way_for(VehicleIndex vehicle) const {
        return vehicles_[vehicle].makes_way_for;
    }
    /// Others that come behind it where it stands, before the next stop that they make.
    std::vector<VehicleIndex> waiting_behind(VehicleIndex vehicle) const;

    /// Its plan ends at a resting place, or without one it stands at one. The layout's condition is
    /// for those only: who stands elsewhere without a plan, as after a restart, may be in the way.
    bool is_resting(VehicleIndex vehicle) const;

    // --- plans
    /// A new task instead of the present one, behind the base. Tries in turn: the soonest plan that
    /// delays nobody (SIPP over the others' predicted stays); the same with idle vehicles out of
    /// the way; the present plan to its end and the task behind it; before others, when the task
    /// may. Errors leave the present plan: traffic_blocked {by, vehicle?, move?, tile_x_m?,
    /// tile_y_m?}; unknown_place {place}.
    Result<Admission> admit(VehicleIndex vehicle, const Task& task, Time now);
    /// The remaining visits of the present task on the soonest way from the end of the base.
    Result<Admission> reroute(VehicleIndex vehicle, Time now);
    /// The task is dropped: the plan ends where the base ends when nobody has to pass there (the
    /// place is a resting one or `stay_anywhere`), else at a resting place.
    Result<Admission> cancel(VehicleIndex vehicle, Time now, bool stay_anywhere = false);

    // --- grants
    /// Grants moves until `wanted_moves` lie ahead of the last passed one or the first that may not
    /// be granted; returns the number of the last granted move.
    MoveNumber extend(VehicleIndex vehicle, MoveNumber wanted_moves, Time now);
    /// How far `extend` would go.
    MoveNumber grantable(VehicleIndex vehicle, MoveNumber wanted_moves) const;
    /// The vehicle, tail included, is behind moves up to `move`. A report told again changes
    /// nothing. Errors: not_granted {move, granted}.
    Status passed(VehicleIndex vehicle, MoveNumber move, Time now);

    // --- disturbances
    /// Breakdown: no grants, its floor stays held, whoever waits for it is replanned by improve().
    void halt(VehicleIndex vehicle, Time now);
    void resume(VehicleIndex vehicle, Time now);
    /// The vehicle stands still on `stand` (at `place`, if it is one); its base and plan are void,
    /// its task too. Give it a task next (with sequences when it stands at no place). Errors:
    /// floor_held {vehicle, tile} when another holds floor there: nothing is changed but that the
    /// vehicle is halted; stop the other one first.
    Status found_at(VehicleIndex vehicle, const TileSet& stand, PlaceIndex place, Time now);
    /// The same with another body, which drives by `graph` from now on.
    Status found_at(VehicleIndex vehicle, GraphIndex graph, const TileSet& stand, PlaceIndex place,
                    Time now);
    /// No grants into the tiles any more; who stands on closed floor may leave it, on any way that
    /// ends with no more of its body on closed floor.
    ClosureIndex close(const TileSet& tiles, Time now);
    void reopen(ClosureIndex closure, Time now);

    // --- quality
    /// Call it about once a second: it also brings the predicted times up to date, which admission
    /// then need not do. Up to `steps` searches: blocked vehicles first (a way round, else out of
    /// the way to a resting place with the visits postponed), then those that lose most time, alone
    /// and in pairs with the one they wait for. Accepted only when acyclic, sooner, and the oldest
    /// task's finish does not move back. When a vehicle without a plan stands in the way and cannot
    /// leave, all that are blocked give up their horizons; those without a graph, and those whose
    /// base ends at no place, then need sequences again.
    Improvement improve(Time now, int steps);

    /// Vehicles whose horizon changed since the last call, by whatever call: send it to them.
    std::vector<VehicleIndex> take_replanned();

    // --- views
    const VehiclePlan& plan(VehicleIndex vehicle) const { return joint_.plan(vehicle); }
    std::size_t vehicle_count() const { return joint_.vehicle_count(); }
    const std::string& name(VehicleIndex vehicle) const { return vehicles_[vehicle].name; }
    TileSet held_tiles(VehicleIndex vehicle) const;
    TileSet tiles_of(const TileIndexes& tiles) const { return tiles_.ids_of(tiles); }
    std::optional<VehicleIndex> holder(TileId tile) const;
    /// Visits of the task passed so far; equal to their number when all are done.
    VisitIndex visits_done(VehicleIndex vehicle) const { return vehicles_[vehicle].next_visit; }
    bool postponed(VehicleIndex vehicle) const { return vehicles_[vehicle].postponed; }
    /// Predicted end of the plan. Blocked: more than kBlocked_s / 2 from now.
    double finish_s(VehicleIndex vehicle) const { return joint_.finish_s(vehicle); }
    /// Why the vehicle's last search found nothing; none after a success.
    std::optional<Block> blocked_by(VehicleIndex vehicle) const {
        return vehicles_[vehicle].blocked_by;
    }
    /// Every vehicle whose next move may not be granted, with everybody it waits for.
    std::vector<Wait> waits() const;
    /// Those of one vehicle; empty: its next move may be granted, or there is none.
    std::vector<Wait> waits_of(VehicleIndex vehicle) const;
    /// Exact time in seconds on an empty floor from where the vehicle's plan ends to a place of its
    /// graph, turns included; infinity: no way, or it ends at no place. A table read after the
    /// first time.
    double travel_s(VehicleIndex vehicle, PlaceIndex to);
    double travel_between_s(GraphIndex graph, PlaceIndex from, PlaceIndex to) {
        return (*times_to_places(graph, {to}))[from];
    }
    /// {code: traffic_blocked, by, vehicle?, move?, tile_x_m?, tile_y_m?}
    Reason reason_of(const Block& block) const;

    // --- restart and monitor
    TrafficRecord record() const;
    /// `empty` has the same graphs, in the same order, and nothing else; a copy shares them, and
    /// to compile them costs more than the rest. Errors: traffic_record_broken {why}.
    static Result<Traffic> rebuild(const TrafficRecord& record, Traffic empty);
    static Result<Traffic> rebuild(const TrafficRecord& record,
                                   const std::vector<MoveGraph>& graphs,
                                   bool report_changes = false);
    std::vector<Change> take_changes();
    /// The whole state as changes: what a new monitor has to be told first.
    std::vector<Change> all_as_changes() const;

    /// Shows a visitor all that counts, for snapshots. Graphs come from the plant: a visitor that
    /// reads needs them added before, in the same order. Changes for the monitor are left out, a
    /// new monitor is told everything; the searches' memory and tables are worked out again.
    template <class V, class Self>
    static void members(V& visit, Self& self) {
        auto& [report_changes, tiles, graphs, joint, vehicles, closures, changes, replanned, untold,
               predicted, predicted_s, search, times, times_kept] = self;
        visit(tiles, joint, vehicles, closures, replanned, untold, predicted, predicted_s);
    }
    /// Tiles as they became known.
    const std::vector<TileId>& tile_order() const { return tiles_.ids(); }

private:
    struct Vehicle {
        std::string name;
        GraphIndex graph = kNoGraph;
        bool gone = false;
        Leaves leaves = Leaves::kNever;
        Task task;  // sequences are used up by the admission
        VisitIndex next_visit = 0;
        double admitted_s = 0;
        std::vector<VehicleIndex> moved_aside;  // for the task's purpose
        std::optional<VehicleIndex> makes_way_for;
        bool postponed = false;
        std::optional<Block> blocked_by;
        double tried_s = -1e9;  // the last search by improve()
        template <class V, class Self>
        static void members(V& visit, Self& self) {
            auto& [its_name, its_graph, is_gone, its_leaves, its_task, its_visit, admitted, moved,
                   its_cause, is_postponed, blocked, tried] = self;
            visit(its_name, its_graph, is_gone, its_leaves, its_task, its_visit, admitted, moved,
                  its_cause, is_postponed, blocked, tried);
        }
    };
    struct Closure {
        TileIndexes tiles;
        bool open = false;
        template <class V, class Self>
        static void members(V& visit, Self& self) {
            auto& [its_tiles, is_open] = self;
            visit(its_tiles, is_open);
        }
    };
    using Undos = std::vector<JointPlan::Undo>;
    using Times = std::shared_ptr<const std::vector<float>>;

    static double s(Time now) { return seconds(now.time_since_epoch()); }
    void predict(double now_s);
    /// Search from `from_move`'s end (>= released) through visits to rest, and merge.
    tl::expected<Admission, Block> plan_from(VehicleIndex vehicle, MoveNumber from_move,
                                             const Task& task, VisitIndex first_visit, double now_s,
                                             bool before_others, Undos* undos = nullptr);
    SearchTask search_task(VehicleIndex vehicle, MoveNumber from_move, const Task& task,
                           VisitIndex first_visit, double now_s);
    void choose_rests(VehicleIndex vehicle, const Task& task, SearchTask& search);
    bool merge_plan(VehicleIndex vehicle, std::vector<PlannedMove> moves, Placement placement,
                    double now_s, Undos* undos = nullptr);
    void roll_back(Undos& undos);
    tl::expected<Admission, Block> admit_any_way(VehicleIndex vehicle, const Task& task,
                                                 double now_s);
    /// A task whose way is being cleared.
    struct Clearing {
        VehicleIndex vehicle;
        const Task& task;
        VisitIndex first_visit;
        Leaves least;  // of those that are asked
        double now_s;
        std::vector<VehicleIndex> made_way;
        Undos undos;
    };
    tl::expected<Admission, Block> plan_clearing(Clearing& clearing);
    tl::expected<Admission, Block> plan_with_others_away(VehicleIndex vehicle, const Task& task,
                                                         VisitIndex first_visit, double now_s);
    bool make_way(const Block& block, Clearing& clearing);
    bool rest_elsewhere(VehicleIndex resting, Clearing& clearing);
    bool was_moved_for(VehicleIndex vehicle, VehicleIndex moved, const Task& task) const;
    void note_moved_aside(VehicleIndex vehicle, const Task& task,
                          const std::vector<VehicleIndex>& moved);
    VisitIndex first_open_visit(VehicleIndex vehicle) const;
    bool is_blocked(VehicleIndex vehicle, double now_s) const;
    std::size_t count_blocked(double now_s) const;
    double oldest_finish_s() const;
    /// Why a vehicle has a turn of improve(), the least urgent first.
    enum class Urgency { kSlow, kPostponed, kBlocked, kInTheWay };
    struct Candidate {
        VehicleIndex vehicle;
        Urgency urgency;
        double loss_s;
    };
    /// A gain below this is not worth a message to the vehicle.
    static constexpr double kWorthwhile_s = 1.0;
    std::vector<Candidate> improvement_candidates(double now_s) const;
    bool improve_candidate(const Candidate& candidate, double now_s, Improvement& result);
    std::optional<VehicleIndex> whom_to_overtake(VehicleIndex vehicle, double now_s) const;
    bool move_idle_away(VehicleIndex vehicle, double now_s, Improvement& result);
    bool improve_one(VehicleIndex vehicle, double now_s);
    bool improve_pair(VehicleIndex vehicle, VehicleIndex before, double now_s);
    bool retreat(VehicleIndex vehicle, double now_s);
    bool in_the_way(VehicleIndex vehicle) const;
    bool untangle(double now_s);
    Times times_to_places(GraphIndex graph, const std::vector<PlaceIndex>& goals);
    Block block_of(const Obstacle& obstacle) const;
    tl::unexpected<Error> refused(VehicleIndex vehicle, const Block& block);
    Status check(VehicleIndex vehicle, const Task& task) const;
    void tell(Change change);
    void tell_plan(VehicleIndex vehicle);
    Change plan_change(VehicleIndex vehicle) const;
    void note_touched();
    void tell_touched();

    bool report_changes_ = false;
    TileTable tiles_;
    std::vector<std::shared_ptr<const CompiledGraph>> graphs_;
    JointPlan joint_;
    std::vector<Vehicle> vehicles_;
    std::vector<Closure> closures_;
    std::vector<Change> changes_;
    std::vector<VehicleIndex> replanned_;
    std::vector<MoveRef> untold_;  // moves of others whose waits_for a merge changed
    bool predicted_ = false;       // times are those of predicted_s_
    double predicted_s_ = 0;
    WindowSearch search_;
    std::map<std::pair<GraphIndex, std::vector<PlaceIndex>>, Times> times_;
    std::size_t times_kept_ = 0;
};

}  // namespace pulseline::traffic
