#include <algorithm>
#include <limits>

#include "core/traffic/traffic.hpp"

namespace pulseline::traffic {

Block Traffic::block_of(const Obstacle& obstacle) const {
    Block block{obstacle.cause, obstacle.vehicle, obstacle.move, {}};
    if (obstacle.tile) block.tile = tiles_.id_of(*obstacle.tile);
    return block;
}

Reason Traffic::reason_of(const Block& block) const {
    static const char* const kCauses[] = {"vehicle",      "closed_floor",   "no_route",
                                          "search_limit", "circular_waits", "halted"};
    Reason reason{"traffic_blocked", {{"by", kCauses[static_cast<int>(block.cause)]}}};
    if (block.cause == Obstacle::Cause::kVehicle) {
        reason.params.push_back({"vehicle", name(block.vehicle)});
        if (block.move != kForever) reason.params.push_back({"move", std::int64_t{block.move}});
    }
    if (block.tile) {
        const auto box = tile_box(*block.tile);
        reason.params.push_back({"tile_x_m", (box.min.x_m + box.max.x_m) / 2});
        reason.params.push_back({"tile_y_m", (box.min.y_m + box.max.y_m) / 2});
    }
    return reason;
}

bool Traffic::is_resting(VehicleIndex vehicle) const {
    const VehiclePlan& plan = joint_.plan(vehicle);
    const PlaceIndex end = plan.place_after(plan.released);
    const Vehicle& v = vehicles_[vehicle];
    return end != kNoPlace && v.graph != kNoGraph && graphs_[v.graph]->places[end].resting;
}

bool Traffic::is_blocked(VehicleIndex vehicle, double now_s) const {
    return joint_.finish_s(vehicle) > now_s + kBlocked_s / 2;
}

std::size_t Traffic::count_blocked(double now_s) const {
    std::size_t count = 0;
    for (VehicleIndex v = 0; v < vehicles_.size(); ++v) count += is_blocked(v, now_s) ? 1 : 0;
    return count;
}

/// Planned finish of the task that was admitted first of those not ended; blocked ones cannot be
/// helped and do not count.
double Traffic::oldest_finish_s() const {
    double admitted_s = std::numeric_limits<double>::infinity();
    double finish_s = std::numeric_limits<double>::infinity();
    for (VehicleIndex v = 0; v < vehicles_.size(); ++v) {
        const VehiclePlan& plan = joint_.plan(v);
        const double end_s = joint_.finish_s(v);
        if (plan.last() == plan.passed || end_s > predicted_s_ + kBlocked_s / 2) continue;
        if (vehicles_[v].admitted_s < admitted_s) {
            admitted_s = vehicles_[v].admitted_s;
            finish_s = end_s;
        }
    }
    return finish_s;
}

/// It has no plan and others wait for it to leave.
bool Traffic::in_the_way(VehicleIndex vehicle) const {
    const VehiclePlan& plan = joint_.plan(vehicle);
    return plan.last() == plan.released && !joint_.nobody_behind(vehicle);
}

std::vector<Wait> Traffic::waits() const {
    std::vector<Wait> waits;
    for (VehicleIndex v = 0; v < joint_.vehicle_count(); ++v) {
        for (Wait& wait : waits_of(v)) waits.push_back(std::move(wait));
    }
    return waits;
}

std::vector<Wait> Traffic::waits_of(VehicleIndex v) const {
    constexpr double kEver_s = std::numeric_limits<double>::infinity();
    const VehiclePlan& plan = joint_.plan(v);
    if (plan.released == plan.last()) return {};
    const MoveNumber n = plan.released + 1;
    if (plan.halted) return {{v, n, {Obstacle::Cause::kHalted, v, 0, {}}, kEver_s}};
    if (!joint_.obstacle(v, n)) return {};
    std::vector<Wait> waits;
    const Shape& shape = *plan.at(n).shape;
    for (const TileIndex tile : shape.swept) {
        for (const Use& use : joint_.queue(tile)) {
            if (use.vehicle == v) {
                if (use.first <= n && use.last >= n) break;
                continue;
            }
            const auto same = std::find_if(waits.begin(), waits.end(), [&](const Wait& w) {
                return w.block.vehicle == use.vehicle;
            });
            if (same == waits.end()) {
                waits.push_back(
                    {v,
                     n,
                     {Obstacle::Cause::kVehicle, use.vehicle, use.last, tiles_.id_of(tile)},
                     joint_.end_of(use)});
            } else if (use.last > same->block.move) {
                same->block.move = use.last;
                same->block.tile = tiles_.id_of(tile);
                same->until_s = joint_.end_of(use);
            }
        }
    }
    if (const auto tile = joint_.closed_tile(plan.stand_after(n - 1), shape)) {
        waits.push_back({v, n, {Obstacle::Cause::kClosed, 0, 0, tiles_.id_of(*tile)}, kEver_s});
    }
    return waits;
}

}  // namespace pulseline::traffic
