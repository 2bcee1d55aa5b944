#include "tests/simulation/fleet_judge_world.hpp"

// How vehicles treat each other: not what keeps the floor safe, but what people can live with.
namespace pulseline::fleet_judge {
namespace {

constexpr double kPatience_s = 900;  // waiting for others' floor
constexpr int kMostOvertaking = 3;   // younger orders at the station it waits for, after that
constexpr double kLeave_s = 30;      // from a plan that needs another away to that one's leaving

bool waits_for_floor(const fleet::JobOrder& order) {
    return order.state == fleet::JobState::kRunning &&
           (order.reason.code == "floor_held" || order.reason.code == "goes_first");
}

bool goes_before(const fleet::JobOrder& a, const fleet::JobOrder& b) {
    return a.priority >= b.priority && a.number < b.number;
}

}  // namespace

/// Nobody leaves twice for one order, but for having driven itself meanwhile, nor for one that does
/// not go.
void World::check_making_way(const fleet::Event& event) {
    if (event.type == "step.started") {
        patience_[event.order].on_leg_s = now_s_;
        for (auto& [id, patience] : patience_) patience.moved_aside.erase(event.vehicle);
    }
    if (event.type != "vehicle.makes_way" || event.order.empty()) return;
    Patience& order = patience_[event.order];
    if (!order.moved_aside.insert(event.vehicle).second)
        violate(event.vehicle.str() + " makes way twice for order " + event.order.str());
    if (now_s_ - order.on_leg_s > kLeave_s)
        violate(event.vehicle.str() + " makes way for order " + event.order.str() +
                ", which does not go");
}

/// Younger orders do not take it in turn at the station that an elder waits for.
void World::check_overtaking(const fleet::StopRecord& stop) {
    const auto passing = store_.orders.find(stop.order);
    if (passing == store_.orders.end() || !stop.inside) return;
    for (auto& [id, patience] : patience_) {
        const auto found = store_.orders.find(id);
        if (found == store_.orders.end()) continue;
        const auto& elder = found->second;
        if (elder.current_step >= elder.steps.size() || !waits_for_floor(elder) ||
            !goes_before(elder, passing->second) ||
            elder.steps[elder.current_step].station != stop.station ||
            now_s_ - patience.waits_since_s < kPatience_s) {
            continue;
        }
        if (++patience.overtaken > kMostOvertaking)
            violate("order " + id.str() + " waits and waits, younger ones have their turn at " +
                    stop.station.str());
    }
}

void World::note_patience() {
    for (const auto& [id, order] : store_.orders) {
        if (fleet::is_final(order.state)) continue;
        Patience& patience = patience_[id];
        const auto record = store_.vehicles.find(order.assigned_vehicle);
        const bool drives = record != store_.vehicles.end() && record->second.has_leg &&
                            record->second.leg_data.order == id;
        if (drives) patience.on_leg_s = now_s_;
        if (!waits_for_floor(order))
            patience = {now_s_, patience.on_leg_s, 0, patience.moved_aside};
    }
}

/// A fleet that has begun anew knows nothing of whom it has asked to leave.
void World::forget_patience() {
    for (auto& [id, patience] : patience_) patience.moved_aside.clear();
}

}  // namespace pulseline::fleet_judge
