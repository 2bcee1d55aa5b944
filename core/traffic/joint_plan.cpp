#include "core/traffic/joint_plan.hpp"

#include <algorithm>

namespace pulseline::traffic {
namespace {

bool has(const TileIndexes& tiles, TileIndex tile) {
    return std::binary_search(tiles.begin(), tiles.end(), tile);
}

bool by_vehicle_and_move(const MoveRef& a, const MoveRef& b) {
    return a.vehicle != b.vehicle ? a.vehicle < b.vehicle : a.move < b.move;
}

}  // namespace

std::vector<Use>& JointPlan::queue_for(TileIndex tile) {
    if (tile >= queues_.size()) queues_.resize(tile + 1);
    return queues_[tile];
}

std::optional<VehicleIndex> JointPlan::holder(TileIndex tile) const {
    const auto& uses = queue(tile);
    if (uses.empty() || uses.front().first > vehicles_[uses.front().vehicle].released) return {};
    return uses.front().vehicle;
}

TileIndexes JointPlan::held_tiles(VehicleIndex vehicle) const {
    const VehiclePlan& plan = vehicles_[vehicle];
    TileIndexes held = plan.stand;
    for (MoveNumber n = plan.passed + 1; n <= plan.released; ++n) {
        held = merge(held, plan.at(n).shape->swept);
    }
    return held;
}

double JointPlan::finish_s(VehicleIndex vehicle) const {
    const VehiclePlan& plan = vehicles_[vehicle];
    return plan.last() == plan.passed ? plan.since_s : plan.at(plan.last()).end_s;
}

// --- uses ---------------------------------------------------------------------------------------

std::vector<JointPlan::OpenUse> JointPlan::uses_of(VehicleIndex vehicle) const {
    const VehiclePlan& plan = vehicles_[vehicle];
    std::vector<OpenUse> done;
    std::vector<OpenUse> open;
    for (const TileIndex tile : plan.stand)
        open.push_back({tile, {vehicle, plan.passed, kForever}});
    for (MoveNumber n = plan.passed + 1; n <= plan.last(); ++n) {
        const Shape& shape = *plan.at(n).shape;
        const TileIndexes& stand_before = plan.stand_after(n - 1);
        for (const TileIndex tile : shape.swept) {
            if (!has(stand_before, tile)) open.push_back({tile, {vehicle, n, kForever}});
        }
        std::vector<OpenUse> still_open;
        for (OpenUse& use : open) {
            if (has(shape.stand, use.tile)) {
                still_open.push_back(use);
                continue;
            }
            use.use.last = n;
            done.push_back(use);
        }
        open = std::move(still_open);
    }
    done.insert(done.end(), open.begin(), open.end());
    return done;
}

std::vector<TileIndex> JointPlan::tiles_of(VehicleIndex vehicle) const {
    const VehiclePlan& plan = vehicles_[vehicle];
    std::vector<TileIndex> tiles = plan.stand;
    for (MoveNumber n = plan.passed + 1; n <= plan.last(); ++n) {
        const auto& swept = plan.at(n).shape->swept;
        tiles.insert(tiles.end(), swept.begin(), swept.end());
    }
    std::sort(tiles.begin(), tiles.end());
    tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
    return tiles;
}

void JointPlan::insert(TileIndex tile, const Use& use, Placement placement) {
    auto& uses = queue_for(tile);
    const VehiclePlan& plan = vehicles_[use.vehicle];
    const auto is_held = [&](const Use& other) {
        return other.first <= vehicles_[other.vehicle].released;
    };
    auto it = uses.begin();
    if (use.first <= plan.released) {
        while (it != uses.end() && it->vehicle == use.vehicle) ++it;
    } else if (placement == Placement::kFirst) {
        while (it != uses.end() &&
               (use.last == kForever || it->vehicle == use.vehicle || is_held(*it))) {
            ++it;
        }
    } else {
        const double start_s = start_of(use);
        while (it != uses.end() &&
               (it->vehicle == use.vehicle ? it->first < use.first : start_of(*it) < start_s)) {
            ++it;
        }
    }
    uses.insert(it, use);
}

void JointPlan::remove_uses(VehicleIndex vehicle, const std::vector<TileIndex>& tiles) {
    for (const TileIndex tile : tiles) {
        std::erase_if(queue_for(tile), [&](const Use& use) { return use.vehicle == vehicle; });
    }
}

void JointPlan::add_uses(VehicleIndex vehicle, Placement placement) {
    for (const OpenUse& use : uses_of(vehicle)) insert(use.tile, use.use, placement);
}

/// Others that come right behind a use of the vehicle.
void JointPlan::note_successors(VehicleIndex vehicle, const std::vector<TileIndex>& tiles) {
    for (const TileIndex tile : tiles) {
        const auto& uses = queue(tile);
        for (std::size_t i = 1; i < uses.size(); ++i) {
            if (uses[i - 1].vehicle == vehicle && uses[i].vehicle != vehicle) {
                touched_moves_.push_back({uses[i].vehicle, uses[i].first});
            }
        }
    }
}

void JointPlan::rebuild_waits(MoveRef ref) {
    VehiclePlan& plan = vehicles_[ref.vehicle];
    PlannedMove& move = plan.at(ref.move);
    move.waits_for.clear();
    const TileIndexes& stand_before = plan.stand_after(ref.move - 1);
    for (const TileIndex tile : move.shape->swept) {
        if (has(stand_before, tile)) continue;
        const auto& uses = queues_[tile];
        for (std::size_t i = 1; i < uses.size(); ++i) {
            if (uses[i].vehicle != ref.vehicle || uses[i].first != ref.move) continue;
            const Use& before = uses[i - 1];
            if (before.vehicle == ref.vehicle) break;
            const auto same =
                std::find_if(move.waits_for.begin(), move.waits_for.end(),
                             [&](const MoveRef& other) { return other.vehicle == before.vehicle; });
            if (same == move.waits_for.end()) {
                move.waits_for.push_back({before.vehicle, before.last});
            } else {
                same->move = std::max(same->move, before.last);
            }
            break;
        }
    }
    std::sort(move.waits_for.begin(), move.waits_for.end(), by_vehicle_and_move);
}

// --- changes ------------------------------------------------------------------------------------

void JointPlan::compact(VehiclePlan& plan) {
    const MoveNumber behind = plan.passed - plan.dropped;
    plan.moves.erase(plan.moves.begin(), plan.moves.begin() + behind);
    plan.dropped = plan.passed;
}

VehicleIndex JointPlan::add_vehicle(const TileIndexes& stand, PlaceIndex place, double now_s) {
    const auto vehicle = static_cast<VehicleIndex>(vehicles_.size());
    vehicles_.emplace_back();
    move_stand(vehicle, stand, place, now_s);
    return vehicle;
}

void JointPlan::remove_vehicle(VehicleIndex vehicle) {
    move_stand(vehicle, {}, kNoPlace, vehicles_[vehicle].since_s);
}

void JointPlan::move_stand(VehicleIndex vehicle, const TileIndexes& stand, PlaceIndex place,
                           double now_s) {
    VehiclePlan& plan = vehicles_[vehicle];
    auto tiles = tiles_of(vehicle);
    touched_moves_.clear();
    note_successors(vehicle, tiles);
    remove_uses(vehicle, tiles);
    // Numbers never repeat: what others still wait for counts as passed.
    plan.passed = plan.released = plan.dropped = plan.last();
    plan.moves.clear();
    plan.stand = stand;
    plan.place = place;
    plan.since_s = now_s;
    add_uses(vehicle, Placement::kFirst);
    note_successors(vehicle, stand);
    std::sort(touched_moves_.begin(), touched_moves_.end(), by_vehicle_and_move);
    touched_moves_.erase(std::unique(touched_moves_.begin(), touched_moves_.end()),
                         touched_moves_.end());
    for (const MoveRef& ref : touched_moves_) rebuild_waits(ref);
}

/// Who was found at a place may stand on more floor than the graph says. Its first move has to
/// leave all of it; a stop there stays on it.
void JointPlan::begin_on_stands(VehiclePlan& plan) {
    for (MoveNumber n = plan.released + 1; n <= plan.last(); ++n) {
        const TileIndexes& before = plan.stand_after(n - 1);
        const Shape& shape = *plan.at(n).shape;
        if (std::includes(shape.swept.begin(), shape.swept.end(), before.begin(), before.end())) {
            continue;
        }
        const bool stop = shape.swept == shape.stand;
        plan.at(n).shape =
            make_shape(shape.swept, before, stop ? merge(before, shape.stand) : shape.stand);
    }
}

JointPlan::Undo JointPlan::replace(VehicleIndex vehicle, std::vector<PlannedMove> moves,
                                   Placement placement) {
    VehiclePlan& plan = vehicles_[vehicle];
    compact(plan);
    Undo undo{vehicle, plan, {}, {}};
    auto tiles = tiles_of(vehicle);
    touched_moves_.clear();
    note_successors(vehicle, tiles);
    const auto kept = static_cast<std::ptrdiff_t>(plan.released - plan.dropped);
    const auto old_tiles = tiles;
    plan.moves.erase(plan.moves.begin() + kept, plan.moves.end());
    for (PlannedMove& move : moves) plan.moves.push_back(std::move(move));
    begin_on_stands(plan);
    const auto new_tiles = tiles_of(vehicle);
    tiles = merge(tiles, new_tiles);
    for (const TileIndex tile : tiles) undo.queues.emplace_back(tile, queue_for(tile));
    remove_uses(vehicle, old_tiles);
    add_uses(vehicle, placement);
    note_successors(vehicle, new_tiles);
    std::sort(touched_moves_.begin(), touched_moves_.end(), by_vehicle_and_move);
    touched_moves_.erase(std::unique(touched_moves_.begin(), touched_moves_.end()),
                         touched_moves_.end());
    for (const MoveRef& ref : touched_moves_) {
        undo.waits.emplace_back(ref, vehicles_[ref.vehicle].at(ref.move).waits_for);
        rebuild_waits(ref);
    }
    for (MoveNumber n = plan.released + 1; n <= plan.last(); ++n) rebuild_waits({vehicle, n});
    return undo;
}

void JointPlan::undo(Undo undo) {
    vehicles_[undo.vehicle] = std::move(undo.plan);
    for (auto& [ref, waits] : undo.waits) {
        vehicles_[ref.vehicle].at(ref.move).waits_for = std::move(waits);
    }
    for (auto& [tile, uses] : undo.queues) queues_[tile] = std::move(uses);
}

void JointPlan::forget_visits(VehicleIndex vehicle) {
    VehiclePlan& plan = vehicles_[vehicle];
    for (MoveNumber n = plan.passed + 1; n <= plan.released; ++n) plan.at(n).visit = kNoVisit;
}

bool JointPlan::nobody_behind(VehicleIndex vehicle) const {
    const VehiclePlan& plan = vehicles_[vehicle];
    const TileIndexes& stand = plan.stand_after(plan.released);
    return std::all_of(stand.begin(), stand.end(), [&](TileIndex tile) {
        const auto& uses = queue(tile);
        return std::all_of(uses.begin(), uses.end(),
                           [&](const Use& use) { return use.vehicle == vehicle; });
    });
}

bool JointPlan::ends_last(VehicleIndex vehicle) const {
    const VehiclePlan& plan = vehicles_[vehicle];
    const TileIndexes& stand = plan.stand_after(plan.last());
    return std::all_of(stand.begin(), stand.end(),
                       [&](TileIndex tile) { return queue(tile).back().vehicle == vehicle; });
}

bool JointPlan::restore(std::vector<VehiclePlan> plans,
                        const std::vector<std::vector<std::int64_t>>& ranks) {
    vehicles_ = std::move(plans);
    queues_.assign(queues_.size(), {});
    const auto rank = [&](const Use& use) {
        const VehiclePlan& plan = vehicles_[use.vehicle];
        if (use.first <= plan.released) return std::int64_t{-1};
        return ranks[use.vehicle][use.first - plan.passed - 1];
    };
    for (VehicleIndex v = 0; v < vehicles_.size(); ++v) {
        for (const OpenUse& use : uses_of(v)) queue_for(use.tile).push_back(use.use);
    }
    for (auto& uses : queues_) {
        std::stable_sort(uses.begin(), uses.end(),
                         [&](const Use& a, const Use& b) { return rank(a) < rank(b); });
        for (std::size_t i = 1; i < uses.size(); ++i) {
            if (rank(uses[i]) < 0 && uses[i].vehicle != uses[0].vehicle) return false;
        }
    }
    for (VehicleIndex v = 0; v < vehicles_.size(); ++v) {
        const VehiclePlan& plan = vehicles_[v];
        for (MoveNumber n = plan.released + 1; n <= plan.last(); ++n) rebuild_waits({v, n});
    }
    return true;
}

// --- grants -------------------------------------------------------------------------------------

void JointPlan::set_released(VehicleIndex vehicle, MoveNumber n, double now_s) {
    VehiclePlan& plan = vehicles_[vehicle];
    if (plan.released == plan.passed) plan.since_s = now_s;  // it stood and waited until now
    plan.released = n;
}

void JointPlan::pass(VehicleIndex vehicle, MoveNumber n, double now_s) {
    VehiclePlan& plan = vehicles_[vehicle];
    while (plan.passed < n) {
        const MoveNumber done = plan.passed + 1;
        const Shape& shape = *plan.at(done).shape;
        for (const TileIndex tile : shape.swept) {
            std::erase_if(queues_[tile], [&](const Use& use) {
                return use.vehicle == vehicle && use.last <= done;
            });
        }
        plan.stand = shape.stand;
        plan.place = plan.at(done).place;
        plan.passed = done;
        plan.since_s = now_s;
    }
}

void JointPlan::set_halted(VehicleIndex vehicle, bool halted, double now_s) {
    vehicles_[vehicle].halted = halted;
    if (!halted) vehicles_[vehicle].since_s = now_s;
}

void JointPlan::close(const TileIndexes& tiles) {
    for (const TileIndex tile : tiles) {
        if (tile >= closed_.size()) closed_.resize(tile + 1, 0);
        if (++closed_[tile] == 1) ++closed_now_;
    }
}

void JointPlan::open(const TileIndexes& tiles) {
    for (const TileIndex tile : tiles) {
        if (closed_[tile] > 0 && --closed_[tile] == 0) --closed_now_;
    }
}

}  // namespace pulseline::traffic
