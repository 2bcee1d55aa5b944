#include <algorithm>

#include "tests/simulation/judge_world.hpp"

// The owner of traffic: a small fleet.
namespace pulseline::judge {

void World::make_orders() {
    const int count = pick(30, 60);
    for (int i = 0; i < count; ++i) {
        Order order;
        order.of_class = chance(0.2) ? 1 : 0;
        const auto& stations = plant_.classes[order.of_class].stations;
        const int stops = pick(1, 3);
        for (int k = 0; k < stops; ++k) {
            const auto place =
                stations[static_cast<std::size_t>(pick(0, static_cast<int>(stations.size()) - 1))];
            order.visits.push_back({place, static_cast<double>(pick(5, 60))});
        }
        order.from_s = pick(0, static_cast<int>(options_.disturbed_s * 0.8));
        order.may_delay_others = chance(0.25);
        orders_.push_back(std::move(order));
    }
    std::stable_sort(orders_.begin(), orders_.end(),
                     [](const Order& a, const Order& b) { return a.from_s < b.from_s; });
    outcome_.orders = count;
}

bool World::all_done() const {
    return std::all_of(orders_.begin(), orders_.end(),
                       [](const Order& o) { return o.done == o.visits.size(); });
}

void World::finish_orders() {
    for (VehicleIndex v = 0; v < bodies_.size(); ++v) {
        Body& body = bodies_[v];
        if (body.order && orders_[*body.order].done == orders_[*body.order].visits.size()) {
            body.order.reset();
            continue;
        }
        if (!body.order || body.retry_s > 0 || traffic_.postponed(v)) continue;
        const auto& plan = traffic_.plan(v);
        if (plan.last() == plan.passed && !plan.halted) {
            violate("the plan of " + traffic_.name(v) + " ended without its stops");
        }
    }
}

/// What is left of the vehicle's order; from where it stands between places, both ways out.
traffic::Task World::task_of(VehicleIndex v) const {
    const Body& body = bodies_[v];
    traffic::Task task;
    if (body.order) {
        const Order& order = orders_[*body.order];
        // A stop already granted will be made; it must not be asked for twice.
        std::size_t first = order.done;
        for (const Granted& move : body.base) first += move.stop ? 1 : 0;
        first = std::min(first, order.visits.size());
        task.visits.assign(order.visits.begin() + static_cast<std::ptrdiff_t>(first),
                           order.visits.end());
        task.may_delay_others = order.may_delay_others;
    }
    const auto& plan = traffic_.plan(v);
    if (plan.place_after(plan.released) == traffic::kNoPlace) task.sequences = ways_back(v);
    return task;
}

std::vector<traffic::Sequence> World::ways_back(VehicleIndex v) const {
    const Body& body = bodies_[v];
    const VehicleClass& c = class_of(v);
    std::vector<traffic::Sequence> ways;
    for (const PlaceIndex place : {body.stray_to, body.stray_from}) {
        const Point to = c.points[place];
        traffic::Sequence way;
        way.steps.push_back({floor_between(c, body.at, to, kMargin_m), floor_at(c, to, kMargin_m),
                             drive_time_s(c, body.at, to), traffic::kNoVisit});
        way.ends_at = place;
        ways.push_back(std::move(way));
    }
    return ways;
}

void World::admit(VehicleIndex v) {
    Body& body = bodies_[v];
    traffic::Task task = task_of(v);
    const auto admission = traffic_.admit(v, task, now());
    if (!admission && !task.sequences.empty() && !task.visits.empty()) {
        // It stands in everybody's way: to a place first, its order another time.
        task.visits.clear();
        if (traffic_.admit(v, std::move(task), now())) ++outcome_.events["only out of the way"];
    }
    settle();
    if (admission) {
        body.retry_s = 0;
        ++outcome_.events[admission->behind_incumbent ? "admitted behind the incumbent"
                          : admission->delays_others  ? "admitted before others"
                                                      : "admitted"];
        if (!admission->made_way.empty()) ++outcome_.events["idle vehicle made way"];
    } else {
        body.retry_s = now_s_ + pick(10, 40);
        ++outcome_.events["admission refused"];
    }
}

void World::assign() {
    for (VehicleIndex v = 0; v < bodies_.size(); ++v) {
        Body& body = bodies_[v];
        if (body.dead || traffic_.plan(v).halted) continue;
        if (body.retry_s > 0) {
            if (now_s_ >= body.retry_s) admit(v);
            continue;
        }
        const auto& plan = traffic_.plan(v);
        const bool between = plan.place_after(plan.released) == traffic::kNoPlace;
        if (between && plan.last() == plan.passed) {
            // Its way from between two places was given up: only its owner knows another.
            body.retry_s = now_s_;
            continue;
        }
        if (body.order) continue;
        // Some orders come while the vehicle is still on its way to rest.
        if (plan.last() > plan.passed && !chance(0.02)) continue;
        for (std::size_t i = 0; i < orders_.size(); ++i) {
            Order& order = orders_[i];
            if (order.vehicle || order.of_class != body.of_class || order.from_s > now_s_) continue;
            order.vehicle = v;
            body.order = i;
            admit(v);
            break;
        }
    }
}

void World::grant() {
    for (VehicleIndex v = 0; v < bodies_.size(); ++v) {
        if (chance(0.2)) continue;  // the fleet looks at it later
        const MoveNumber wanted = static_cast<MoveNumber>(pick(1, 4));
        const MoveNumber granted = traffic_.extend(v, wanted, now());
        take_grants(v, granted);
    }
    settle();
}

}  // namespace pulseline::judge
