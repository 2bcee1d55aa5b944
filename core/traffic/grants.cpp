#include <algorithm>

#include "core/traffic/traffic.hpp"

// Whether a move may be granted now, and so whether a vehicle has to wait for floor (invariant S of
// traffic.hpp).
namespace pulseline::traffic {

std::optional<TileIndex> JointPlan::closed_tile(const TileIndexes& stand,
                                                const Shape& shape) const {
    if (closed_now_ == 0) return {};
    const auto closed = [&](TileIndex tile) { return is_closed(tile); };
    const auto it = std::find_if(shape.swept.begin(), shape.swept.end(), closed);
    if (it == shape.swept.end()) return {};
    // Leaving never gets it deeper in: else a long body would drive through, piece after piece.
    const auto before = std::count_if(stand.begin(), stand.end(), closed);
    const auto after = std::count_if(shape.stand.begin(), shape.stand.end(), closed);
    if (before > 0 && after <= before) return {};
    return *it;
}

std::optional<TileIndex> JointPlan::obstacle(VehicleIndex vehicle, MoveNumber n) const {
    const VehiclePlan& plan = vehicles_[vehicle];
    const Shape& shape = *plan.at(n).shape;
    for (const TileIndex tile : shape.swept) {
        for (const Use& use : queues_[tile]) {
            if (use.vehicle == vehicle && use.first <= n) {
                if (use.last >= n) break;
                continue;  // an earlier stay of its own that it has not passed yet
            }
            return tile;
        }
    }
    return closed_tile(plan.stand_after(n - 1), shape);
}

MoveNumber Traffic::grantable(VehicleIndex vehicle, MoveNumber wanted_moves) const {
    const VehiclePlan& plan = joint_.plan(vehicle);
    MoveNumber n = plan.released;
    if (plan.halted) return n;
    const MoveNumber most = std::min(plan.last(), plan.passed + wanted_moves);
    // Granting a move changes nothing that the next one's test reads: its own stays count as free.
    while (n < most && !joint_.obstacle(vehicle, n + 1)) ++n;
    return n;
}

MoveNumber Traffic::extend(VehicleIndex vehicle, MoveNumber wanted_moves, Time now) {
    const MoveNumber granted = grantable(vehicle, wanted_moves);
    if (granted > joint_.plan(vehicle).released) {
        joint_.set_released(vehicle, granted, s(now));
        tell({Change::Kind::kReleased, vehicle, granted, {}, {}});
    }
    return granted;
}

Status Traffic::passed(VehicleIndex vehicle, MoveNumber move, Time now) {
    const VehiclePlan& plan = joint_.plan(vehicle);
    if (move > plan.released) {
        return fail(Errc::kConflict, "not_granted",
                    "The vehicle reports floor behind it that it was not granted.", {},
                    {{"move", std::int64_t{move}}, {"granted", std::int64_t{plan.released}}});
    }
    if (move <= plan.passed) return {};
    for (MoveNumber n = plan.passed + 1; n <= move; ++n) {
        const VisitIndex visit = plan.at(n).visit;
        if (visit != kNoVisit) {
            vehicles_[vehicle].next_visit = static_cast<VisitIndex>(visit + 1);
        }
    }
    joint_.pass(vehicle, move, s(now));  // less to wait for: the predicted times still agree
    tell({Change::Kind::kPassed, vehicle, move, {}, {}});
    return {};
}

TileSet Traffic::held_tiles(VehicleIndex vehicle) const {
    return tiles_.ids_of(joint_.held_tiles(vehicle));
}

std::optional<VehicleIndex> Traffic::holder(TileId tile) const {
    const auto index = tiles_.find(tile);
    return index ? joint_.holder(*index) : std::nullopt;
}

}  // namespace pulseline::traffic
