#include <algorithm>

#include "core/traffic/traffic.hpp"

// Snapshot and restart, and the reports to the monitor.
namespace pulseline::traffic {

TrafficRecord Traffic::record() const {
    TrafficRecord record;
    const auto ranks = joint_.ranks();
    for (VehicleIndex v = 0; v < joint_.vehicle_count(); ++v) {
        const VehiclePlan& plan = joint_.plan(v);
        const Vehicle& vehicle = vehicles_[v];
        StoredStand row;
        row.name = vehicle.name;
        row.graph = vehicle.graph;
        row.stand = tiles_.ids_of(plan.stand);
        row.place = plan.place;
        row.passed = plan.passed;
        row.released = plan.released;
        for (MoveNumber n = plan.passed + 1; n <= plan.last(); ++n) {
            const PlannedMove& move = plan.at(n);
            row.moves.push_back({tiles_.ids_of(move.shape->swept), tiles_.ids_of(move.shape->stand),
                                 move.place, move.visit, move.duration_s, move.start_s, move.end_s,
                                 ranks[v][n - plan.passed - 1]});
        }
        row.since_s = plan.since_s;
        row.halted = plan.halted;
        row.gone = vehicle.gone;
        row.leaves = vehicle.leaves;
        row.visits = vehicle.task.visits;
        row.resting = vehicle.task.resting;
        row.next_visit = vehicle.next_visit;
        row.admitted_s = vehicle.admitted_s;
        row.purpose = vehicle.task.purpose;
        row.later = vehicle.task.later;
        row.moved_aside = vehicle.moved_aside;
        row.makes_way_for = vehicle.makes_way_for;
        row.postponed = vehicle.postponed;
        row.tried_s = vehicle.tried_s;
        row.blocked_by = vehicle.blocked_by;
        record.vehicles.push_back(std::move(row));
    }
    record.predicted_s = predicted_ ? predicted_s_ : -1;
    for (TileIndex tile = 0; tile < tiles_.size(); ++tile) {
        record.tile_order.push_back(tiles_.id_of(tile));
    }
    for (const Closure& closure : closures_) {
        record.closures.push_back({tiles_.ids_of(closure.tiles), closure.open});
    }
    return record;
}

Result<Traffic> Traffic::rebuild(const TrafficRecord& record, const std::vector<MoveGraph>& graphs,
                                 bool report_changes) {
    Traffic empty(report_changes);
    for (const MoveGraph& graph : graphs) empty.add_graph(graph);
    return rebuild(record, std::move(empty));
}

Result<Traffic> Traffic::rebuild(const TrafficRecord& record, Traffic empty) {
    const auto broken = [](const char* why, const std::string& vehicle) {
        return fail(Errc::kInvalid, "traffic_record_broken",
                    "The stored traffic state contradicts itself.", {},
                    {{"why", std::string(why)}, {"vehicle", vehicle}});
    };
    Traffic traffic = std::move(empty);
    for (const TileId tile : record.tile_order) traffic.tiles_.index_of(tile);
    traffic.predicted_ = record.predicted_s >= 0;
    traffic.predicted_s_ = record.predicted_s;
    std::vector<VehiclePlan> plans;
    std::vector<std::vector<std::int64_t>> ranks;
    for (const StoredStand& row : record.vehicles) {
        if (row.graph != kNoGraph && row.graph >= traffic.graphs_.size())
            return broken("graph", row.name);
        if (row.released < row.passed || row.released - row.passed > row.moves.size()) {
            return broken("counters", row.name);
        }
        VehiclePlan plan;
        plan.stand = traffic.tiles_.indexes_of(row.stand);
        plan.place = row.place;
        plan.passed = plan.dropped = row.passed;
        plan.released = row.released;
        plan.since_s = row.since_s;
        plan.halted = row.halted;
        ranks.emplace_back();
        TileIndexes stand = plan.stand;
        for (const MoveRecord& move : row.moves) {
            PlannedMove planned;
            TileIndexes after = traffic.tiles_.indexes_of(move.stand);
            planned.shape = make_shape(traffic.tiles_.indexes_of(move.swept), stand, after);
            stand = std::move(after);
            planned.place = move.place;
            planned.visit = move.visit;
            planned.duration_s = move.duration_s;
            planned.start_s = move.start_s;
            planned.end_s = move.end_s;
            plan.moves.push_back(std::move(planned));
            ranks.back().push_back(move.rank);
        }
        plans.push_back(std::move(plan));
        Vehicle vehicle;
        vehicle.name = row.name;
        vehicle.graph = row.graph;
        vehicle.gone = row.gone;
        vehicle.leaves = row.leaves;
        vehicle.task.visits = row.visits;
        vehicle.task.resting = row.resting;
        vehicle.next_visit = row.next_visit;
        vehicle.admitted_s = row.admitted_s;
        vehicle.task.purpose = row.purpose;
        vehicle.task.later = row.later;
        vehicle.moved_aside = row.moved_aside;
        vehicle.makes_way_for = row.makes_way_for;
        vehicle.postponed = row.postponed;
        vehicle.tried_s = row.tried_s;
        vehicle.blocked_by = row.blocked_by;
        traffic.vehicles_.push_back(std::move(vehicle));
    }
    if (!traffic.joint_.restore(std::move(plans), ranks)) return broken("two_holders", {});
    if (!JointPlan(traffic.joint_).predict(0)) return broken("cycle", {});
    for (const ClosureRecord& closure : record.closures) {
        traffic.closures_.push_back({traffic.tiles_.indexes_of(closure.tiles), closure.open});
        if (!closure.open) traffic.joint_.close(traffic.closures_.back().tiles);
    }
    return traffic;
}

// --- monitor ------------------------------------------------------------------------------------

void Traffic::tell(Change change) {
    if (report_changes_) changes_.push_back(std::move(change));
}

std::vector<Change> Traffic::take_changes() { return std::exchange(changes_, {}); }

std::vector<VehicleIndex> Traffic::take_replanned() {
    auto replanned = std::exchange(replanned_, {});
    std::sort(replanned.begin(), replanned.end());
    replanned.erase(std::unique(replanned.begin(), replanned.end()), replanned.end());
    return replanned;
}

Change Traffic::plan_change(VehicleIndex vehicle) const {
    const VehiclePlan& plan = joint_.plan(vehicle);
    Change change{Change::Kind::kPlan, vehicle, plan.released, {}, {}};
    for (MoveNumber n = plan.released + 1; n <= plan.last(); ++n) {
        const PlannedMove& move = plan.at(n);
        change.moves.push_back({n, tiles_.ids_of(move.shape->swept),
                                tiles_.ids_of(move.shape->stand), move.waits_for});
    }
    return change;
}

/// REQUIRES: other plans that changed since the last call are told before.
void Traffic::tell_plan(VehicleIndex vehicle) {
    replanned_.push_back(vehicle);
    if (!report_changes_) return;
    tell(plan_change(vehicle));
    tell_touched();
}

void Traffic::note_touched() {
    if (!report_changes_) return;
    const auto& touched = joint_.touched_moves();
    untold_.insert(untold_.end(), touched.begin(), touched.end());
}

void Traffic::tell_touched() {
    for (const MoveRef& ref : std::exchange(untold_, {})) {
        const VehiclePlan& plan = joint_.plan(ref.vehicle);
        if (ref.move <= plan.released || ref.move > plan.last()) continue;
        Change change{Change::Kind::kWaits, ref.vehicle, 0, {}, {}};
        change.moves.push_back({ref.move, {}, {}, plan.at(ref.move).waits_for});
        tell(std::move(change));
    }
}

std::vector<Change> Traffic::all_as_changes() const {
    std::vector<Change> changes;
    for (VehicleIndex v = 0; v < joint_.vehicle_count(); ++v) {
        const VehiclePlan& plan = joint_.plan(v);
        changes.push_back({Change::Kind::kStand, v, plan.passed, tiles_.ids_of(plan.stand), {}});
        Change all{Change::Kind::kPlan, v, plan.passed, {}, {}};
        for (MoveNumber n = plan.passed + 1; n <= plan.last(); ++n) {
            const PlannedMove& move = plan.at(n);
            all.moves.push_back({n, tiles_.ids_of(move.shape->swept),
                                 tiles_.ids_of(move.shape->stand), move.waits_for});
        }
        changes.push_back(std::move(all));
    }
    for (VehicleIndex v = 0; v < joint_.vehicle_count(); ++v) {
        const VehiclePlan& plan = joint_.plan(v);
        if (plan.released > plan.passed) {
            changes.push_back({Change::Kind::kReleased, v, plan.released, {}, {}});
        }
        if (plan.halted) changes.push_back({Change::Kind::kHalted, v, 0, {}, {}});
    }
    for (const Closure& closure : closures_) {
        if (!closure.open) {
            changes.push_back({Change::Kind::kClosed, 0, 0, tiles_.ids_of(closure.tiles), {}});
        }
    }
    return changes;
}

}  // namespace pulseline::traffic
