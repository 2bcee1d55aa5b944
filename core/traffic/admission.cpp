#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/traffic/traffic.hpp"

namespace pulseline::traffic {
namespace {

constexpr std::size_t kTimesKept = 32'000'000;  // floats of distance tables, 128 MB
constexpr std::size_t kFewRests = 8;
constexpr double kFresh_s = 5;  // predictions serve as long: they steer quality, not order

// Not by its floor: a turn on the spot may sweep no more tiles than it stands on.
bool is_stop(const PlannedMove& move) { return move.visit != kNoVisit; }

}  // namespace

GraphIndex Traffic::add_graph(const MoveGraph& graph) {
    graphs_.push_back(std::make_shared<const CompiledGraph>(compile(graph, tiles_)));
    return static_cast<GraphIndex>(graphs_.size() - 1);
}

Result<VehicleIndex> Traffic::add_vehicle(const VehicleSpec& spec, Time now) {
    const TileIndexes stand = spec.stand.empty() && spec.place != kNoPlace
                                  ? graphs_[spec.graph]->places[spec.place].stand
                                  : tiles_.indexes_of(spec.stand);
    for (const TileIndex tile : stand) {
        if (const auto other = joint_.holder(tile)) {
            return fail(Errc::kConflict, "floor_held", "Another vehicle holds floor there.", {},
                        {{"vehicle", name(*other)},
                         {"tile", static_cast<std::int64_t>(tiles_.id_of(tile))}});
        }
    }
    const VehicleIndex vehicle = joint_.add_vehicle(stand, spec.place, s(now));
    Vehicle entry;
    entry.name = spec.name;
    entry.graph = spec.graph;
    vehicles_.push_back(std::move(entry));
    predicted_ = false;
    tell({Change::Kind::kStand, vehicle, 0, tiles_.ids_of(stand), {}});
    note_touched();
    tell_touched();
    return vehicle;
}

void Traffic::predict(double now_s) {
    if (predicted_ && now_s < predicted_s_ + kFresh_s) return;
    joint_.predict(now_s);
    predicted_ = true;
    predicted_s_ = now_s;
}

Traffic::Times Traffic::times_to_places(GraphIndex graph, const std::vector<PlaceIndex>& goals) {
    const auto key = std::make_pair(graph, goals);
    if (const auto it = times_.find(key); it != times_.end()) return it->second;
    if (times_kept_ > kTimesKept) {
        times_.clear();
        times_kept_ = 0;
    }
    const CompiledGraph& g = *graphs_[graph];
    auto times =
        std::make_shared<const std::vector<float>>(times_to(g, goals.empty() ? g.resting : goals));
    times_kept_ += times->size();
    times_.emplace(key, times);
    return times;
}

Status Traffic::check(VehicleIndex vehicle, const Task& task) const {
    const Vehicle& v = vehicles_[vehicle];
    const std::size_t count = v.graph == kNoGraph ? 0 : graphs_[v.graph]->places.size();
    const auto unknown = [&](PlaceIndex place) -> Status {
        return fail(Errc::kNotFound, "unknown_place", "The vehicle's graph has no such place.", {},
                    {{"place", std::int64_t{place}}});
    };
    for (const Visit& visit : task.visits) {
        if (visit.place >= count && v.graph != kNoGraph) return unknown(visit.place);
    }
    for (const PlaceIndex place : task.resting) {
        if (place >= count) return unknown(place);
    }
    for (const Sequence& sequence : task.sequences) {
        if (sequence.ends_at != kNoPlace && sequence.ends_at >= count) {
            return unknown(sequence.ends_at);
        }
    }
    return {};
}

double Traffic::travel_s(VehicleIndex vehicle, PlaceIndex to) {
    const Vehicle& v = vehicles_[vehicle];
    const VehiclePlan& plan = joint_.plan(vehicle);
    const PlaceIndex from = plan.place_after(plan.released);
    if (v.graph == kNoGraph || from == kNoPlace) return std::numeric_limits<double>::infinity();
    return (*times_to_places(v.graph, {to}))[from];
}

/// Where the vehicle can end at all: on most resting places another one ends its plan. With few
/// left, the bound on the way home counts to these; one to the nearest of all would be far too low,
/// and the search would flood the floor around the last stop.
void Traffic::choose_rests(VehicleIndex vehicle, const Task& task, SearchTask& search) {
    const GraphIndex graph = vehicles_[vehicle].graph;
    const CompiledGraph& g = *graphs_[graph];
    search.resting = task.resting;
    std::vector<PlaceIndex> free;
    std::optional<Obstacle> taken;
    for (const PlaceIndex place : task.resting.empty() ? g.resting : task.resting) {
        const auto& stand = g.places[place].stand;
        const auto tile = std::find_if(stand.begin(), stand.end(), [&](TileIndex t) {
            const auto& uses = joint_.queue(t);
            return !uses.empty() && uses.back().last == kForever && uses.back().vehicle != vehicle;
        });
        if (tile == stand.end()) {
            free.push_back(place);
            if (free.size() > kFewRests) break;
        } else if (!taken) {
            taken =
                Obstacle{BlockCause::kVehicle, joint_.queue(*tile).back().vehicle, kForever, *tile};
        }
    }
    if (free.size() > kFewRests) {
        search.times_to_rest = times_to_places(graph, task.resting);
        return;
    }
    if (free.empty()) {
        if (task.sequences.empty()) search.hopeless = taken.value_or(Obstacle{});
        search.times_to_rest = times_to_places(graph, task.resting);
        return;
    }
    search.resting = free;
    search.times_to_rest = times_to_places(graph, {free.front()});
    if (free.size() == 1) return;
    std::vector<float> least = *search.times_to_rest;
    for (const PlaceIndex place : free) {
        const auto times = times_to_places(graph, {place});
        for (std::size_t i = 0; i < least.size(); ++i) least[i] = std::min(least[i], (*times)[i]);
    }
    search.times_to_rest = std::make_shared<const std::vector<float>>(std::move(least));
}

SearchTask Traffic::search_task(VehicleIndex vehicle, MoveNumber from_move, const Task& task,
                                VisitIndex first_visit, double now_s) {
    const VehiclePlan& plan = joint_.plan(vehicle);
    const Vehicle& v = vehicles_[vehicle];
    SearchTask search;
    search.vehicle = vehicle;
    search.start = plan.place_after(from_move);
    search.start_stand = plan.stand_after(from_move);
    search.start_s = from_move > plan.passed ? std::max(plan.at(from_move).end_s, now_s) : now_s;
    search.now_s = now_s;
    if (v.graph != kNoGraph) {
        search.graph = graphs_[v.graph].get();
        choose_rests(vehicle, task, search);
        for (std::size_t i = first_visit; i < task.visits.size(); ++i) {
            const Visit& visit = task.visits[i];
            search.stops.push_back({visit.place, visit.dwell_s, static_cast<VisitIndex>(i),
                                    times_to_places(v.graph, {visit.place})});
        }
    }
    for (const Sequence& sequence : task.sequences) {
        FixedSequence fixed;
        fixed.ends_at = sequence.ends_at;
        TileIndexes stand = search.start_stand;
        for (const Sequence::Step& step : sequence.steps) {
            const TileIndexes after = tiles_.indexes_of(step.stand);
            fixed.steps.push_back({make_shape(tiles_.indexes_of(step.swept), stand, after),
                                   step.duration_s, step.visit, step.place});
            stand = after;
        }
        if (!fixed.steps.empty()) search.sequences.push_back(std::move(fixed));
    }
    return search;
}

bool Traffic::merge_plan(VehicleIndex vehicle, std::vector<PlannedMove> moves, Placement placement,
                         double now_s, Undos* undos) {
    auto undo = joint_.replace(vehicle, std::move(moves), placement);
    note_touched();
    // The times that the plan was made with stay good for the next search at this instant.
    bool acyclic = joint_.times_agree(undo);
    if (!acyclic) {
        predicted_ = false;
        acyclic = joint_.predict_before(vehicle, now_s);
    }
    if (!acyclic) {
        joint_.undo(std::move(undo));
    } else if (undos) {
        undos->push_back(std::move(undo));
    }
    return acyclic;
}

void Traffic::roll_back(Undos& undos) {
    while (!undos.empty()) {
        joint_.undo(std::move(undos.back()));
        undos.pop_back();
    }
    predicted_ = false;
}

tl::expected<Admission, Block> Traffic::plan_from(VehicleIndex vehicle, MoveNumber from_move,
                                                  const Task& task, VisitIndex first_visit,
                                                  double now_s, bool before_others, Undos* undos) {
    predict(now_s);
    SearchTask search = search_task(vehicle, from_move, task, first_visit, now_s);
    search.only_lasting = before_others;
    SearchResult found = search_.find(joint_, search);
    if (!found.found) return tl::unexpected(block_of(found.obstacle));
    std::vector<PlannedMove> moves;
    const VehiclePlan& plan = joint_.plan(vehicle);
    for (MoveNumber n = plan.released + 1; n <= from_move; ++n) {
        if (!is_stop(plan.at(n))) moves.push_back(plan.at(n));  // the old task's are not made
    }
    for (PlannedMove& move : found.moves) moves.push_back(std::move(move));
    const auto old_blocked = before_others ? count_blocked(now_s) : 0;
    Undos own;
    if (!merge_plan(vehicle, std::move(moves),
                    before_others ? Placement::kFirst : Placement::kByTime, now_s, &own)) {
        return tl::unexpected(Block{Obstacle::Cause::kCycle, 0, 0, {}});
    }
    if (before_others) {
        // The search took for granted that all others can give way; now it shows.
        predict(now_s);
        const bool in_vain = is_blocked(vehicle, now_s) || !joint_.ends_last(vehicle) ||
                             count_blocked(now_s) > old_blocked;
        if (in_vain) {
            roll_back(own);
            return tl::unexpected(Block{Obstacle::Cause::kCycle, 0, 0, {}});
        }
    }
    if (undos) undos->insert(undos->end(), own.begin(), own.end());
    Admission admission;
    admission.finish_s = joint_.finish_s(vehicle);
    admission.behind_incumbent = from_move > plan.released;
    admission.delays_others = before_others;
    admission.labels = found.labels;
    return admission;
}

tl::expected<Admission, Block> Traffic::admit_any_way(VehicleIndex vehicle, const Task& task,
                                                      double now_s) {
    const VehiclePlan& plan = joint_.plan(vehicle);
    if (!task.asks_to_leave) return plan_from(vehicle, plan.released, task, 0, now_s, false);
    auto admission = plan_with_others_away(vehicle, task, 0, now_s);
    if (!admission && in_the_way(vehicle) && untangle(now_s)) {
        admission = plan_with_others_away(vehicle, task, 0, now_s);
    }
    const bool has_incumbent = plan.last() > plan.released;
    if (!admission && has_incumbent && task.sequences.empty()) {
        auto behind = plan_from(vehicle, plan.last(), task, 0, now_s, false);
        if (behind) admission = std::move(behind);
    }
    if (!admission && task.may_delay_others) {
        auto before = plan_from(vehicle, plan.released, task, 0, now_s, true);
        if (before) admission = std::move(before);
    }
    return admission;
}

tl::unexpected<Error> Traffic::refused(VehicleIndex vehicle, const Block& block) {
    vehicles_[vehicle].blocked_by = block;
    return fail(Error{Errc::kConflict,
                      reason_of(block),
                      "No plan leads there at present; the vehicle keeps the one it has.",
                      {}});
}

Result<Admission> Traffic::admit(VehicleIndex vehicle, const Task& task, Time now) {
    if (auto status = check(vehicle, task); !status) return fail(status.error());
    if (joint_.plan(vehicle).halted) {
        return refused(vehicle, {Obstacle::Cause::kHalted, vehicle, 0, {}});
    }
    const auto admission = admit_any_way(vehicle, task, s(now));
    if (!admission) return refused(vehicle, admission.error());
    note_moved_aside(vehicle, task, admission->made_way);
    Vehicle& v = vehicles_[vehicle];
    v.task = task;
    v.task.sequences.clear();
    v.next_visit = 0;
    v.admitted_s = task.since_s == kSinceAdmission ? s(now) : task.since_s;
    v.makes_way_for.reset();
    v.postponed = false;
    v.blocked_by.reset();
    joint_.forget_visits(vehicle);
    tell_plan(vehicle);
    return *admission;
}

/// First visit whose stop is neither passed nor granted.
VisitIndex Traffic::first_open_visit(VehicleIndex vehicle) const {
    const VehiclePlan& plan = joint_.plan(vehicle);
    VisitIndex visit = vehicles_[vehicle].next_visit;
    for (MoveNumber n = plan.passed + 1; n <= plan.released; ++n) {
        const VisitIndex granted = plan.at(n).visit;
        if (granted != kNoVisit) visit = std::max(visit, static_cast<VisitIndex>(granted + 1));
    }
    return visit;
}

Result<Admission> Traffic::reroute(VehicleIndex vehicle, Time now) {
    const VehiclePlan& plan = joint_.plan(vehicle);
    if (plan.halted) return refused(vehicle, {Obstacle::Cause::kHalted, vehicle, 0, {}});
    const auto admission = plan_from(vehicle, plan.released, vehicles_[vehicle].task,
                                     first_open_visit(vehicle), s(now), false);
    if (!admission) return refused(vehicle, admission.error());
    vehicles_[vehicle].postponed = false;
    vehicles_[vehicle].blocked_by.reset();
    tell_plan(vehicle);
    return *admission;
}

Result<Admission> Traffic::cancel(VehicleIndex vehicle, Time now, bool stay_anywhere) {
    const VehiclePlan& plan = joint_.plan(vehicle);
    Vehicle& v = vehicles_[vehicle];
    const auto drop_task = [&] {
        const auto purpose = v.task.purpose;  // whom it has asked to leave is not forgotten with it
        v.task = {};
        v.task.purpose = purpose;
        v.next_visit = 0;
        v.postponed = false;
        v.blocked_by.reset();
        joint_.forget_visits(vehicle);
    };
    predict(s(now));
    const PlaceIndex end = plan.place_after(plan.released);
    const bool may_stay = stay_anywhere || (end != kNoPlace && v.graph != kNoGraph &&
                                            graphs_[v.graph]->places[end].resting);
    if (may_stay && joint_.nobody_behind(vehicle)) {
        drop_task();
        merge_plan(vehicle, {}, Placement::kByTime, s(now));
        tell_plan(vehicle);
        return Admission{joint_.finish_s(vehicle), false, false, {}, 0};
    }
    if (end != kNoPlace && !plan.halted) {
        if (auto admission = plan_from(vehicle, plan.released, {}, 0, s(now), false)) {
            drop_task();
            tell_plan(vehicle);
            return *admission;
        }
    }
    // The old way to the resting place without its stops: what is left out holds up nobody.
    drop_task();
    std::vector<PlannedMove> moves;
    for (MoveNumber n = plan.released + 1; n <= plan.last(); ++n) {
        if (!is_stop(plan.at(n))) moves.push_back(plan.at(n));
    }
    merge_plan(vehicle, std::move(moves), Placement::kByTime, s(now));
    tell_plan(vehicle);
    return Admission{joint_.finish_s(vehicle), true, false, {}, 0};
}

}  // namespace pulseline::traffic
