#include <algorithm>

#include "tests/simulation/judge_world.hpp"

// What goes wrong in the judge's hall.
namespace pulseline::judge {

void World::disturb() {
    for (VehicleIndex v = 0; v < bodies_.size(); ++v) {
        Body& body = bodies_[v];
        if (!body.dead || now_s_ < body.returns_s) continue;
        body.dead = false;
        if (body.strays) {
            found(v);
        } else {
            traffic_.resume(v, now());
            settle();
        }
    }
    for (std::size_t i = 0; i < closed_.size();) {
        if (now_s_ < closed_[i].until_s) {
            ++i;
            continue;
        }
        traffic_.reopen(closed_[i].closure, now());
        closed_.erase(closed_.begin() + static_cast<std::ptrdiff_t>(i));
        settle();
    }
    if (!disturbed_ || !chance(fault_rate_)) return;
    const auto v = static_cast<VehicleIndex>(pick(0, static_cast<int>(bodies_.size()) - 1));
    Body& body = bodies_[v];
    switch (pick(0, 9)) {
        case 0:
        case 1:
        case 2:
            body.stands_until_s = now_s_ + pick(5, 600);
            ++outcome_.events["vehicle stands still"];
            break;
        case 3:
        case 4:
            if (body.dead) break;
            body.dead = true;
            body.returns_s = now_s_ + pick(30, 900);
            body.strays = false;
            traffic_.halt(v, now());
            settle();
            ++outcome_.events["vehicle dies and returns"];
            break;
        case 5:
            if (body.dead) break;
            // It stops for good in mid-move; a person looks where it is.
            body.dead = true;
            body.returns_s = now_s_ + pick(10, 300);
            body.strays = true;
            traffic_.halt(v, now());
            settle();
            ++outcome_.events["vehicle found between places"];
            break;
        case 6:
        case 7:
            close_some();
            break;
        case 8:
            change_plan();
            break;
        default:
            restart();
            break;
    }
}

void World::end_disturbances() {
    disturbed_ = false;
    for (Body& body : bodies_) {
        body.returns_s = std::min(body.returns_s, now_s_);
        body.stands_until_s = std::min(body.stands_until_s, now_s_);
    }
    for (Closed& closed : closed_) closed.until_s = std::min(closed.until_s, now_s_);
}

void World::found(VehicleIndex v) {
    Body& body = bodies_[v];
    const VehicleClass& c = class_of(v);
    // It may have driven a part of a move; what it reported before is not news any more.
    body.reports.clear();
    const bool on_its_way = body.in_move_s > 0 && !body.base.empty() && !body.base.front().stop;
    // Found again before it came to a place, it stands between the same two still.
    const bool from_a_place = body.from == c.points[body.from_place];
    if (from_a_place) {
        body.stray_from = body.from_place;
        body.stray_to = on_its_way ? body.base.front().place : body.from_place;
    }
    const PlaceIndex place = on_its_way || !from_a_place ? traffic::kNoPlace : body.from_place;
    body.base.clear();
    body.in_move_s = 0;
    body.from = body.at;
    const auto status = traffic_.found_at(v, floor_at(c, body.at, kMargin_m), place, now());
    if (!status) violate("no floor where " + traffic_.name(v) + " stands");
    body.last_reported = traffic_.plan(v).passed;
    traffic_.resume(v, now());
    settle();
    if (body.order) body.retry_s = now_s_;
}

void World::close_some() {
    const auto& graph = plant_.classes[static_cast<std::size_t>(pick(0, 1))].graph;
    const auto& move =
        graph.moves[static_cast<std::size_t>(pick(0, static_cast<int>(graph.moves.size()) - 1))];
    closed_.push_back({traffic_.close(move.swept, now()), now_s_ + pick(30, 600)});
    settle();
    ++outcome_.events["floor closed"];
}

void World::change_plan() {
    const auto v = static_cast<VehicleIndex>(pick(0, static_cast<int>(bodies_.size()) - 1));
    Body& body = bodies_[v];
    const auto& plan = traffic_.plan(v);
    if (plan.halted || plan.place_after(plan.released) == traffic::kNoPlace) return;
    switch (pick(0, 2)) {
        case 0:
            if (traffic_.reroute(v, now())) ++outcome_.events["rerouted"];
            break;
        case 1:
            if (!traffic_.cancel(v, now(), chance(0.5))) violate("a cancel failed");
            if (body.order) body.retry_s = now_s_ + pick(0, 60);
            ++outcome_.events["cancelled and given again"];
            break;
        default:
            if (body.order) admit(v);
            ++outcome_.events["task given again on the way"];
            break;
    }
    settle();
}

void World::restart() {
    const auto record = traffic_.record();
    auto rebuilt = traffic::Traffic::rebuild(record, graphs_, true);
    ++outcome_.events["restart"];
    if (!rebuilt) {
        violate("the record cannot be rebuilt: " + rebuilt.error().reason.code);
        return;
    }
    traffic_ = std::move(*rebuilt);
    if (!(traffic_.record() == record)) violate("a restart changed the state");
    // The monitor lives on: what it knows must be what the rebuilt traffic says.
    traffic::Monitor fresh;
    for (const auto& violation : fresh.apply(traffic_.all_as_changes())) {
        violate("after a restart " + to_string(violation));
    }
    for (const auto& violation : fresh.check_all()) {
        violate("after a restart " + to_string(violation));
    }
}

}  // namespace pulseline::judge
