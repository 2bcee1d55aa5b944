#include <algorithm>
#include <utility>

#include "core/traffic/traffic.hpp"

namespace pulseline::traffic {

void Traffic::halt(VehicleIndex vehicle, Time now) {
    if (joint_.plan(vehicle).halted) return;
    joint_.set_halted(vehicle, true, s(now));
    predicted_ = false;
    tell({Change::Kind::kHalted, vehicle, 0, {}, {}});
}

void Traffic::resume(VehicleIndex vehicle, Time now) {
    if (!joint_.plan(vehicle).halted) return;
    joint_.set_halted(vehicle, false, s(now));
    predicted_ = false;
    tell({Change::Kind::kResumed, vehicle, 0, {}, {}});
}

void Traffic::remove_vehicle(VehicleIndex vehicle, Time now) {
    vehicles_[vehicle].gone = true;
    vehicles_[vehicle].task = {};
    joint_.move_stand(vehicle, {}, kNoPlace, s(now));
    predicted_ = false;
    tell({Change::Kind::kStand, vehicle, joint_.plan(vehicle).passed, {}, {}});
    note_touched();
    tell_touched();
}

Status Traffic::found_at(VehicleIndex vehicle, const TileSet& stand, PlaceIndex place, Time now) {
    const TileIndexes tiles = tiles_.indexes_of(stand);
    for (const TileIndex tile : tiles) {
        const auto other = joint_.holder(tile);
        if (!other || *other == vehicle) continue;
        halt(vehicle, now);
        return fail(
            Errc::kConflict, "floor_held",
            "The vehicle stands on floor that another one holds; stop that one first.", {},
            {{"vehicle", name(*other)}, {"tile", static_cast<std::int64_t>(tiles_.id_of(tile))}});
    }
    Vehicle& v = vehicles_[vehicle];
    const auto purpose = v.task.purpose;  // whom it has asked to leave is not forgotten with it
    v.task = {};
    v.task.purpose = purpose;
    v.next_visit = 0;
    v.postponed = false;
    v.blocked_by.reset();
    joint_.move_stand(vehicle, tiles, place, s(now));
    predicted_ = false;
    tell({Change::Kind::kStand, vehicle, joint_.plan(vehicle).passed, stand, {}});
    note_touched();
    tell_touched();
    return {};
}

Status Traffic::found_at(VehicleIndex vehicle, GraphIndex graph, const TileSet& stand,
                         PlaceIndex place, Time now) {
    const GraphIndex before = std::exchange(vehicles_[vehicle].graph, graph);
    auto found = found_at(vehicle, stand, place, now);
    if (!found) vehicles_[vehicle].graph = before;
    return found;
}

ClosureIndex Traffic::close(const TileSet& tiles, Time) {
    // The place of one that was reopened: a plant closes and opens floor for years.
    const auto free = std::find_if(closures_.begin(), closures_.end(),
                                   [](const Closure& closure) { return closure.open; });
    const auto index = static_cast<ClosureIndex>(free - closures_.begin());
    if (free == closures_.end()) closures_.emplace_back();
    closures_[index] = {tiles_.indexes_of(tiles), false};
    joint_.close(closures_[index].tiles);
    predicted_ = false;
    tell({Change::Kind::kClosed, 0, 0, tiles, {}});
    return index;
}

void Traffic::reopen(ClosureIndex closure, Time) {
    Closure& c = closures_[closure];
    if (c.open) return;
    c.open = true;
    joint_.open(c.tiles);
    predicted_ = false;
    tell({Change::Kind::kReopened, 0, 0, tiles_.ids_of(c.tiles), {}});
    c.tiles = {};
}

}  // namespace pulseline::traffic
