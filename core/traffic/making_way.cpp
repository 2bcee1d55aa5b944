#include <algorithm>
#include <tuple>

#include "core/traffic/traffic.hpp"

// Idle vehicles leave the floor that a task needs. Nobody is sent off unless the task gets its plan
// by it, and nobody twice for one purpose: two that are barred by a third would send each other to
// and fro for ever.
namespace pulseline::traffic {
namespace {

constexpr std::size_t kMostMakeWay = 3;     // idle vehicles sent off for one task
constexpr std::size_t kMostRestsTried = 8;  // for one of them
constexpr std::size_t kMostRestsLookedAt = 32;

/// It stands idle, and what it is predicted to stand for is no task.
bool stands_at_work(const VehiclePlan& plan, Leaves leaves) {
    return leaves != Leaves::kNever && plan.released == plan.passed && plan.last() > plan.passed &&
           plan.at(plan.passed + 1).visit != kNoVisit;
}

}  // namespace

bool Traffic::was_moved_for(VehicleIndex vehicle, VehicleIndex moved, const Task& task) const {
    const Vehicle& v = vehicles_[vehicle];
    if (task.purpose == 0 || v.task.purpose != task.purpose) return false;
    if (!vehicles_[moved].makes_way_for) return false;  // it has had a task of its own since
    return std::find(v.moved_aside.begin(), v.moved_aside.end(), moved) != v.moved_aside.end();
}

void Traffic::note_moved_aside(VehicleIndex vehicle, const Task& task,
                               const std::vector<VehicleIndex>& moved) {
    Vehicle& v = vehicles_[vehicle];
    if (task.purpose == 0 || v.task.purpose != task.purpose) v.moved_aside.clear();
    v.moved_aside.insert(v.moved_aside.end(), moved.begin(), moved.end());
}

/// The nearest other resting place at which the vehicle is out of the task's way, first of those on
/// which nobody stands and where nobody is going to stop.
bool Traffic::rest_elsewhere(VehicleIndex resting, Clearing& clearing) {
    const double now_s = clearing.now_s;
    const GraphIndex number = vehicles_[resting].graph;
    const CompiledGraph& graph = *graphs_[number];
    const VehiclePlan& plan = joint_.plan(resting);
    const TileIndexes& here = graph.places[plan.place].stand;
    // Where somebody is going to stop: there it would soon be in the way again.
    std::vector<const TileIndexes*> goals;
    const auto add_goals = [&](GraphIndex of, const Task& task, VisitIndex next) {
        if (of == kNoGraph) return;
        const auto& places = graphs_[of]->places;
        for (std::size_t i = next; i < task.visits.size(); ++i)
            goals.push_back(&places[task.visits[i].place].stand);
        for (const PlaceIndex place : task.later) goals.push_back(&places[place].stand);
    };
    add_goals(vehicles_[clearing.vehicle].graph, clearing.task, clearing.first_visit);
    for (VehicleIndex other = 0; other < vehicles_.size(); ++other) {
        const Vehicle& o = vehicles_[other];
        if (other != resting && other != clearing.vehicle) add_goals(o.graph, o.task, o.next_visit);
    }
    struct Rest {
        bool held;
        float away_s;
        PlaceIndex place;
    };
    std::vector<Rest> others;
    for (PlaceIndex p = 0; p < graph.places.size(); ++p) {
        const TileIndexes& stand = graph.places[p].stand;
        if (!graph.places[p].resting || meet(stand, here)) continue;
        const float away_s = (*times_to_places(number, {p}))[plan.place];
        if (std::isinf(away_s)) continue;
        const bool held = std::any_of(stand.begin(), stand.end(), [&](TileIndex tile) {
            return joint_.holder(tile).has_value();
        });
        others.push_back({held, away_s, p});
    }
    std::sort(others.begin(), others.end(), [](const Rest& a, const Rest& b) {
        return std::tie(a.held, a.away_s, a.place) < std::tie(b.held, b.away_s, b.place);
    });
    if (others.size() > kMostRestsLookedAt) others.resize(kMostRestsLookedAt);
    std::stable_partition(others.begin(), others.end(), [&](const Rest& rest) {
        return std::none_of(goals.begin(), goals.end(), [&](const TileIndexes* goal) {
            return meet(graph.places[rest.place].stand, *goal);
        });
    });
    if (others.size() > kMostRestsTried) others.resize(kMostRestsTried);
    for (const Rest& rest : others) {
        Undos undos;
        Task elsewhere;
        elsewhere.resting = {rest.place};
        if (!plan_from(resting, plan.released, elsewhere, 0, now_s, false, &undos)) continue;
        Undos trial;
        const MoveNumber from = joint_.plan(clearing.vehicle).released;
        const auto through = plan_from(clearing.vehicle, from, clearing.task, clearing.first_visit,
                                       now_s, false, &trial);
        const bool helps = through || through.error().cause != BlockCause::kVehicle ||
                           through.error().vehicle != resting;
        roll_back(trial);
        if (helps) {
            clearing.undos.insert(clearing.undos.end(), undos.begin(), undos.end());
            return true;
        }
        roll_back(undos);
    }
    return false;
}

bool Traffic::make_way(const Block& block, Clearing& clearing) {
    if (block.cause != Obstacle::Cause::kVehicle) return false;
    const VehiclePlan& other = joint_.plan(block.vehicle);
    const Vehicle& v = vehicles_[block.vehicle];
    const bool stands = other.released == other.passed && !other.halted && !v.gone;
    const bool has_plan = other.last() > other.passed;
    if (!stands || (has_plan && !stands_at_work(other, v.leaves)) || v.graph == kNoGraph ||
        other.place == kNoPlace)
        return false;
    const bool resting = is_resting(block.vehicle);
    Leaves leaves = v.leaves;
    if (leaves == Leaves::kNever) {
        // Off the resting places the layout's condition does not hold: who stands there has to
        // leave. Who gave way may rest where the other wants to go, each of two at the other's
        // goal: it waits for a way in any case, and can wait elsewhere.
        if (!resting) {
            leaves = Leaves::kFirst;
        } else if (v.postponed) {
            leaves = Leaves::kLast;
        }
    }
    if (leaves < clearing.least || leaves == Leaves::kNever) return false;
    if (was_moved_for(clearing.vehicle, block.vehicle, clearing.task)) return false;
    const bool away = rest_elsewhere(block.vehicle, clearing) ||
                      (!resting && plan_from(block.vehicle, other.released, {}, 0, clearing.now_s,
                                             false, &clearing.undos));
    if (away) clearing.made_way.push_back(block.vehicle);
    return away;
}

/// A plan for the task, with those out of its way that have to be; all or nothing. Whoever calls
/// tells the vehicle's plan: what others wait for can only be told once all plans are known.
tl::expected<Admission, Block> Traffic::plan_clearing(Clearing& clearing) {
    Undos own;
    const auto plan = [&] {
        own.clear();
        return plan_from(clearing.vehicle, joint_.plan(clearing.vehicle).released, clearing.task,
                         clearing.first_visit, clearing.now_s, false, &own);
    };
    // Whoever stands at work where the vehicle has to pass before its next stop.
    const auto at_work_before = [&]() -> std::optional<VehicleIndex> {
        const VehiclePlan& mine = joint_.plan(clearing.vehicle);
        for (MoveNumber n = mine.released + 1; n <= mine.last(); ++n) {
            for (const MoveRef& ref : mine.at(n).waits_for) {
                if (stands_at_work(joint_.plan(ref.vehicle), vehicles_[ref.vehicle].leaves))
                    return ref.vehicle;
            }
            if (mine.at(n).visit != kNoVisit) break;
        }
        return std::nullopt;
    };
    auto admission = plan();
    // Who is worked on leaves as soon as somebody has to pass: by a way that suits the task.
    for (std::size_t tried = 0; admission && tried < kMostMakeWay; ++tried) {
        const auto at_work = at_work_before();
        if (!at_work || was_moved_for(clearing.vehicle, *at_work, clearing.task)) break;
        roll_back(own);
        clearing.least = Leaves::kLast;
        const bool away = make_way({BlockCause::kVehicle, *at_work, kForever, {}}, clearing);
        admission = plan();
        if (!away) break;
    }
    while (!admission && clearing.made_way.size() < kMostMakeWay &&
           make_way(admission.error(), clearing)) {
        admission = plan();
    }
    if (!admission) {
        roll_back(clearing.undos);
        return admission;
    }
    for (const VehicleIndex away : clearing.made_way) {
        Vehicle& v = vehicles_[away];
        v.makes_way_for = clearing.vehicle;
        // Else it has a task to go back to; to work that it has left nobody goes back.
        if (v.leaves != Leaves::kNever || first_open_visit(away) == v.task.visits.size()) {
            v.postponed = false;
            // There and nowhere else it is out of the way.
            v.task.resting = {joint_.plan(away).place_after(joint_.plan(away).last())};
            v.next_visit = static_cast<VisitIndex>(v.task.visits.size());
        }
        replanned_.push_back(away);
        if (report_changes_) tell(plan_change(away));
    }
    admission->made_way = std::move(clearing.made_way);
    return admission;
}

tl::expected<Admission, Block> Traffic::plan_with_others_away(VehicleIndex vehicle,
                                                              const Task& task,
                                                              VisitIndex first_visit,
                                                              double now_s) {
    Clearing clearing{vehicle, task, first_visit, Leaves::kFirst, now_s, {}, {}};
    auto admission = plan_clearing(clearing);
    if (admission || admission.error().cause != BlockCause::kVehicle) return admission;
    Clearing all{vehicle, task, first_visit, Leaves::kLast, now_s, {}, {}};
    return plan_clearing(all);
}

std::vector<VehicleIndex> Traffic::waiting_behind(VehicleIndex vehicle) const {
    std::vector<VehicleIndex> waiting;
    for (const TileIndex tile : joint_.plan(vehicle).stand) {
        bool behind = false;
        for (const Use& use : joint_.queue(tile)) {
            if (use.vehicle == vehicle) {
                behind = true;
                continue;
            }
            if (!behind) continue;
            const VehiclePlan& plan = joint_.plan(use.vehicle);
            bool stops_before = false;
            for (MoveNumber n = plan.passed + 1; n < use.first && n <= plan.last(); ++n) {
                stops_before |= plan.at(n).visit != kNoVisit;
            }
            if (!stops_before) waiting.push_back(use.vehicle);
        }
    }
    std::sort(waiting.begin(), waiting.end());
    waiting.erase(std::unique(waiting.begin(), waiting.end()), waiting.end());
    return waiting;
}

}  // namespace pulseline::traffic
