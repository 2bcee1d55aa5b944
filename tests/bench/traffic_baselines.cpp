#include <algorithm>
#include <limits>
#include <unordered_map>

#include "tests/bench/traffic_grid.hpp"
#include "tests/bench/traffic_world.hpp"

// What the joint plan is compared with, on the same floor with the same orders. Neither looks at
// delays, faults or closures, which favours both.
namespace pulseline::bench {
namespace {

/// One vehicle per resource: a leg is driven when all its tiles are free at once, and frees them as
/// the vehicle passes, as openTCS users secure whole routes. Routes lead around resting places,
/// where there is a way, and ignore other vehicles.
class ExclusiveLegs {
public:
    explicit ExclusiveLegs(const World& world) : world_(world), orders_(world) {
        for (const auto& graph : world.graphs) {
            grids_.emplace_back(graph);
            auto& moves = moves_.emplace_back();
            for (const auto& move : graph.moves) moves[key(move.from, move.to)] = &move;
        }
        ways_.resize(world.graphs.size());
        vehicles_.resize(world.vehicles.size());
        for (std::size_t v = 0; v < vehicles_.size(); ++v) {
            const auto& vehicle = world.vehicles[v];
            vehicles_[v].place = vehicle.start;
            const auto& places = world.graphs[vehicle.graph].places;
            for (const auto tile : places[vehicle.start].stand) holder_[tile] = v;
        }
    }

    void step(double now_s) {
        for (std::size_t v = 0; v < vehicles_.size(); ++v) {
            Vehicle& vehicle = vehicles_[v];
            if (vehicle.busy_steps > 0 && --vehicle.busy_steps > 0) continue;
            if (!vehicle.leg.empty()) {
                arrive(v, now_s);
                continue;
            }
            if (vehicle.dwelling) {
                vehicle.dwelling = vehicle.to_goal = false;
                vehicle.wanted = traffic::kNoPlace;
                ++done;
                longest_done_s_ = std::max(longest_done_s_, now_s - vehicle.given_s);
            }
            choose_leg(v, now_s);
        }
    }

    int stuck(double now_s) const {
        return static_cast<int>(
            std::count_if(vehicles_.begin(), vehicles_.end(),
                          [&](const Vehicle& v) { return now_s - v.moved_s > kStuck_s; }));
    }

    double longest_order_s(double now_s) const {
        double longest_s = longest_done_s_;
        for (const Vehicle& vehicle : vehicles_) {
            if (vehicle.wanted == traffic::kNoPlace) continue;
            longest_s = std::max(longest_s, now_s - vehicle.given_s);
        }
        return longest_s;
    }

    std::uint64_t done = 0;

private:
    struct Vehicle {
        PlaceIndex place = 0;
        std::vector<PlaceIndex> leg;  // to come, the next one last
        int busy_steps = 0;           // left of the move or stop
        bool dwelling = false;
        bool to_goal = false;
        PlaceIndex wanted = traffic::kNoPlace;
        double moved_s = 0;
        double since_s = 0;  // it has this order
        double given_s = 0;  // to the zone
    };

    static std::uint64_t key(PlaceIndex from, PlaceIndex to) {
        return std::uint64_t{from} << 32 | to;
    }
    const traffic::Move& move(std::size_t v, PlaceIndex from, PlaceIndex to) const {
        return *moves_[world_.vehicles[v].graph].at(key(from, to));
    }

    const std::vector<PlaceIndex>& way(GraphIndex graph, PlaceIndex from, PlaceIndex to) {
        auto& leg = ways_[graph][key(from, to)];
        if (!leg.empty() || from == to) return leg;
        auto distance = grids_[graph].distances(to, false, from);
        const bool through_rests = distance[from] == std::numeric_limits<std::uint16_t>::max();
        if (through_rests) distance = grids_[graph].distances(to, true, from);
        if (distance[from] == std::numeric_limits<std::uint16_t>::max()) return leg;
        for (PlaceIndex place = from; place != to;) {
            PlaceIndex best = traffic::kNoPlace;
            for (const PlaceIndex other : grids_[graph].next(place)) {
                if (distance[other] < distance[place]) best = other;
            }
            leg.push_back(place = best);
        }
        std::reverse(leg.begin(), leg.end());
        return leg;
    }

    bool try_leg(std::size_t v, PlaceIndex to) {
        Vehicle& vehicle = vehicles_[v];
        const auto& leg = way(world_.vehicles[v].graph, vehicle.place, to);
        if (leg.empty()) return false;
        traffic::TileSet needed;
        PlaceIndex from = vehicle.place;
        for (auto it = leg.rbegin(); it != leg.rend(); from = *it++) {
            for (const auto tile : move(v, from, *it).swept) {
                const auto held = holder_.find(tile);
                if (held != holder_.end() && held->second != v) return false;
                needed.push_back(tile);
            }
        }
        for (const auto tile : needed) holder_[tile] = v;
        vehicle.leg = leg;
        vehicle.busy_steps = steps_to_next(v);
        return true;
    }

    int steps_to_next(std::size_t v) const {
        const Vehicle& vehicle = vehicles_[v];
        return world_.steps_of(move(v, vehicle.place, vehicle.leg.back()).duration_s);
    }

    void arrive(std::size_t v, double now_s) {
        Vehicle& vehicle = vehicles_[v];
        const PlaceIndex to = vehicle.leg.back();
        vehicle.leg.pop_back();
        traffic::TileSet kept = world_.graphs[world_.vehicles[v].graph].places[to].stand;
        PlaceIndex from = to;
        for (auto it = vehicle.leg.rbegin(); it != vehicle.leg.rend(); from = *it++) {
            kept = traffic::merge(kept, move(v, from, *it).swept);
        }
        for (const auto tile : move(v, vehicle.place, to).swept) {
            if (!std::binary_search(kept.begin(), kept.end(), tile)) holder_.erase(tile);
        }
        vehicle.place = to;
        vehicle.moved_s = now_s;
        if (!vehicle.leg.empty()) {
            vehicle.busy_steps = steps_to_next(v);
        } else if (vehicle.to_goal) {
            dwell(vehicle);
        }
    }

    void dwell(Vehicle& vehicle) {
        vehicle.dwelling = true;
        vehicle.busy_steps = world_.steps_of(world_.dwell_s);
    }

    /// From a stop straight to the next one when that leg is free, else home.
    void choose_leg(std::size_t v, double now_s) {
        Vehicle& vehicle = vehicles_[v];
        if (vehicle.wanted == traffic::kNoPlace) {
            vehicle.wanted = orders_.next(v);
            vehicle.since_s = vehicle.given_s = now_s;
        }
        if (vehicle.wanted == vehicle.place) {
            dwell(vehicle);
        } else if (try_leg(v, vehicle.wanted)) {
            vehicle.to_goal = true;
        } else {
            if (vehicle.place != world_.vehicles[v].start) try_leg(v, world_.vehicles[v].start);
            const bool waits = vehicle.leg.empty() && now_s - vehicle.since_s >= kHandOver_s;
            if (waits && world_.real_plant) hand_over(v, now_s);
        }
    }

    /// As in the joint plan's run.
    void hand_over(std::size_t v, double now_s) {
        const std::size_t count = vehicles_.size();
        for (std::size_t i = 1; i < count; ++i) {
            const std::size_t u = (v + 1 + (i + handed_over_) % (count - 1)) % count;
            Vehicle& other = vehicles_[u];
            const bool free = other.leg.empty() && !other.dwelling && other.busy_steps == 0;
            if (world_.vehicles[u].zone != world_.vehicles[v].zone || !free) continue;
            std::swap(other.wanted, vehicles_[v].wanted);
            std::swap(other.given_s, vehicles_[v].given_s);
            other.since_s = vehicles_[v].since_s = now_s;
            ++handed_over_;
            return;
        }
    }

    const World& world_;
    Orders orders_;
    std::vector<Grid> grids_;
    std::vector<std::unordered_map<std::uint64_t, const traffic::Move*>> moves_;
    std::vector<std::unordered_map<std::uint64_t, std::vector<PlaceIndex>>> ways_;
    std::unordered_map<traffic::TileId, std::size_t> holder_;
    std::vector<Vehicle> vehicles_;
    std::size_t handed_over_ = 0;
    double longest_done_s_ = 0;
};

}  // namespace

Run run_alone(const World& world, double seconds) {
    traffic::Traffic traffic;
    for (const auto& graph : world.graphs) traffic.add_graph(graph);
    Orders orders(world);
    Run run;
    run.simulated_s = seconds;
    for (std::size_t v = 0; v < world.vehicles.size(); ++v) {
        const auto& vehicle = world.vehicles[v];
        if (!vehicle.busy) continue;
        PlaceIndex place = vehicle.start;
        for (double now_s = 0;;) {
            const PlaceIndex goal = orders.next(v);
            const double takes_s =
                traffic.travel_between_s(vehicle.graph, place, goal) + world.dwell_s;
            if (now_s + takes_s > seconds) break;
            now_s += takes_s;
            place = goal;
            ++run.orders;
            run.longest_order_s = std::max(run.longest_order_s, takes_s);
            run.sum_order_s += takes_s;
        }
    }
    return run;
}

Run run_exclusive_legs(const World& world, double seconds) {
    ExclusiveLegs legs(world);
    Run run;
    for (; run.simulated_s < seconds; run.simulated_s += world.step_s) legs.step(run.simulated_s);
    run.orders = legs.done;
    run.longest_order_s = legs.longest_order_s(run.simulated_s);
    run.stuck = legs.stuck(run.simulated_s);
    return run;
}

}  // namespace pulseline::bench
