#include <algorithm>

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

/// Nobody leaves twice for one step of an order, but for having driven itself or a person's having
/// let the order go on meanwhile; to go on to the same place after something stopped it is no
/// second time. Nor does anybody leave for an order that does not go: said of orders that nothing
/// has interrupted, the others go when their vehicles can.
void World::check_making_way(const fleet::Event& event) {
    const auto param = [&](const char* name) -> std::string {
        for (const auto& [key, value] : event.params) {
            const auto* text = std::get_if<std::string>(&value);
            if (key == name && text) return *text;
        }
        return {};
    };
    Patience& order = patience_[event.order];
    if (event.type == "job_order.state") {
        if (param("to") == "Running") order.moved_aside.clear();
        if (param("to") == "Interrupted") order.interrupted = true;
    }
    if (event.type == "step.started") {
        order.on_leg_s = now_s_;
        order.moved_aside.clear();
        for (auto& [id, patience] : patience_) patience.moved_aside.erase(event.vehicle);
    }
    if (event.type == "vehicle.needs_resume") {  // it did not come to where it was sent
        for (auto& [id, patience] : patience_) patience.moved_aside.erase(event.vehicle);
    }
    if (event.type != "vehicle.makes_way" || event.order.empty()) return;
    const auto [before, first] = order.moved_aside.try_emplace(event.vehicle, param("station"));
    if (!first && before->second != param("station"))
        violate(event.vehicle.str() + " makes way twice for order " + event.order.str());
    if (!order.interrupted && now_s_ - order.on_leg_s > kLeave_s)
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
            patience = {now_s_, patience.on_leg_s, 0, patience.interrupted, patience.moved_aside};
    }
}

/// A fleet that has begun anew knows nothing of whom it has asked to leave.
void World::forget_patience() {
    for (auto& [id, patience] : patience_) patience.moved_aside.clear();
}

}  // namespace pulseline::fleet_judge
