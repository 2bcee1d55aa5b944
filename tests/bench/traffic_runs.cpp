#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <unordered_map>

#include "core/traffic/monitor.hpp"
#include "tests/bench/traffic_world.hpp"

// The three ways of running the same floor: each gives a vehicle a new order of its zone as soon as
// the stop of the last one is made.
namespace pulseline::bench {
namespace {

using traffic::MoveNumber;
using traffic::VehicleIndex;
using Timer = std::chrono::steady_clock;

constexpr double kStuck_s = 600;

/// CPU time of this thread: the claim is one core, and other programs must not count. Too slow to
/// read for release decisions, which take less than a microsecond.
double cpu_us() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e6 + static_cast<double>(t.tv_nsec) * 1e-3;
}

double us_since(Timer::time_point begin) {
    return std::chrono::duration<double, std::micro>(Timer::now() - begin).count();
}

Time at(double t_s) { return time_from_ns(static_cast<std::int64_t>(t_s * 1e9)); }

/// Orders: for each vehicle an endless list of goals in its zone, the same for all runs.
class Orders {
public:
    explicit Orders(const World& world) : world_(world) {
        for (const PlaceIndex goal : world.goals) {
            const auto zone = world.zone[goal];
            if (zone >= by_zone_.size()) by_zone_.resize(zone + 1);
            by_zone_[zone].push_back(goal);
        }
        for (std::size_t v = 0; v < world.starts.size(); ++v) random_.emplace_back(1000 + v);
    }
    PlaceIndex next(std::size_t vehicle) {
        const auto& goals = by_zone_[world_.zone[world_.starts[vehicle]]];
        return goals[random_[vehicle]() % goals.size()];
    }

private:
    const World& world_;
    std::vector<std::vector<PlaceIndex>> by_zone_;
    std::vector<std::mt19937_64> random_;
};

/// Neighbours and distances in moves for the baselines.
class Grid {
public:
    explicit Grid(const World& world) : world_(world), next_(world.graph.places.size()) {
        for (const auto& move : world.graph.moves) next_[move.from].push_back(move.to);
    }
    const std::vector<PlaceIndex>& next(PlaceIndex place) const { return next_[place]; }

    /// Moves from every place to the goal; `rests` that are crossed count as walls but for `own`.
    std::vector<std::uint16_t> distances(PlaceIndex goal, bool cross_rests, PlaceIndex own) const {
        std::vector<std::uint16_t> distance(next_.size(),
                                            std::numeric_limits<std::uint16_t>::max());
        std::vector<PlaceIndex> open{goal};
        distance[goal] = 0;
        for (std::size_t i = 0; i < open.size(); ++i) {
            const PlaceIndex place = open[i];
            if (!cross_rests && place != goal && world_.graph.places[place].resting) continue;
            for (const PlaceIndex other : next_[place]) {
                if (distance[other] != std::numeric_limits<std::uint16_t>::max()) continue;
                const bool wall =
                    !cross_rests && world_.graph.places[other].resting && other != own;
                if (wall) continue;
                distance[other] = static_cast<std::uint16_t>(distance[place] + 1);
                open.push_back(other);
            }
        }
        return distance;
    }

    const std::vector<std::uint16_t>& to(PlaceIndex goal) {
        auto& table = tables_[goal];
        if (table.empty()) table = distances(goal, true, traffic::kNoPlace);
        return table;
    }

private:
    const World& world_;
    std::vector<std::vector<PlaceIndex>> next_;
    std::unordered_map<PlaceIndex, std::vector<std::uint16_t>> tables_;
};

int dwell_steps(const World& world) { return static_cast<int>(world.dwell_s / world.step_s); }

}  // namespace

Run run_traffic(const World& world, double seconds, std::uint64_t releases) {
    Run run;
    traffic::Traffic traffic(true);
    traffic::Monitor monitor;
    traffic.add_graph(world.graph);
    Orders orders(world);
    struct Vehicle {
        int busy_steps = 0;  // left of a stop
        bool has_order = false;
        double retry_s = 0;
        double moved_s = 0;
    };
    std::vector<Vehicle> vehicles(world.starts.size());
    std::vector<PlaceIndex> goals(world.starts.size(), traffic::kNoPlace);
    const auto settle = [&] { run.violations += monitor.apply(traffic.take_changes()).size(); };
    double now_s = 0;
    for (std::size_t v = 0; v < vehicles.size(); ++v) {
        traffic.add_vehicle({"V" + std::to_string(v), 0, world.starts[v], {}}, at(now_s)).value();
    }
    settle();
    std::size_t steps = 0;
    for (; now_s < seconds || run.releases < releases; ++steps, now_s += world.step_s) {
        for (VehicleIndex v = 0; v < vehicles.size(); ++v) {
            Vehicle& vehicle = vehicles[v];
            const auto& plan = traffic.plan(v);
            if (plan.released > plan.passed && --vehicle.busy_steps <= 0) {
                if (!traffic.passed(v, plan.passed + 1, at(now_s))) ++run.violations;
                vehicle.moved_s = now_s;
                if (vehicle.has_order && traffic.visits_done(v) == 1) {
                    vehicle.has_order = false;
                    goals[v] = traffic::kNoPlace;
                    ++run.orders;
                }
                if (plan.released > plan.passed) {
                    vehicle.busy_steps = plan.at(plan.passed + 1).visit == traffic::kNoVisit
                                             ? 1
                                             : dwell_steps(world);
                }
            }
            if (!vehicle.has_order && now_s >= vehicle.retry_s) {
                if (goals[v] == traffic::kNoPlace) goals[v] = orders.next(v);
                traffic::Task task;
                task.visits = {{goals[v], world.dwell_s}};
                const double begin_us = cpu_us();
                const bool admitted = traffic.admit(v, task, at(now_s)).has_value();
                run.admission_us.push_back(cpu_us() - begin_us);
                vehicle.has_order = admitted;
                vehicle.moved_s = now_s;
                if (!admitted) {
                    ++run.refused;
                    vehicle.retry_s = now_s + 30;
                }
                settle();
            }
            const MoveNumber before = plan.released;
            const auto begin = Timer::now();
            const MoveNumber granted = traffic.extend(v, 2, at(now_s));
            run.release_us.push_back(us_since(begin));
            run.releases += granted - before;
            if (before == plan.passed && granted > before) {
                vehicle.busy_steps =
                    plan.at(before + 1).visit == traffic::kNoVisit ? 1 : dwell_steps(world);
            }
        }
        settle();
        const double begin_us = cpu_us();
        traffic.improve(at(now_s),
                        1);  // what the fleet does when idle; also brings times up to date
        run.improve_us.push_back(cpu_us() - begin_us);
        settle();
        if (steps % 200 == 0) run.violations += monitor.check_all().size();
    }
    run.violations += monitor.check_all().size();
    run.simulated_s = now_s;
    for (const Vehicle& vehicle : vehicles) {
        run.stuck += vehicle.has_order && now_s - vehicle.moved_s > kStuck_s ? 1 : 0;
    }
    const auto before = mallinfo2().uordblks;
    const auto copy = std::make_unique<traffic::Traffic>(traffic);
    run.bytes_per_vehicle =
        static_cast<double>(mallinfo2().uordblks - before) / static_cast<double>(vehicles.size());
    return run;
}

Run run_exclusive_legs(const World& world, double seconds) {
    Run run;
    Grid grid(world);
    Orders orders(world);
    std::unordered_map<traffic::TileId, std::size_t> holder;
    std::unordered_map<std::uint64_t, const traffic::Move*> moves;
    for (const auto& move : world.graph.moves) {
        moves[std::uint64_t{move.from} << 32 | move.to] = &move;
    }
    struct Vehicle {
        PlaceIndex place = 0;
        std::vector<PlaceIndex> leg;  // to come, the next one last
        int dwell = 0;
        bool to_goal = false;
        PlaceIndex wanted = traffic::kNoPlace;
        double moved_s = 0;
    };
    std::vector<Vehicle> vehicles(world.starts.size());
    for (std::size_t v = 0; v < vehicles.size(); ++v) {
        vehicles[v].place = world.starts[v];
        for (const auto tile : world.graph.places[world.starts[v]].stand) holder[tile] = v;
    }
    std::unordered_map<std::uint64_t, std::vector<PlaceIndex>>
        ways;  // from, to: routes ignore others
    const auto way = [&](PlaceIndex from, PlaceIndex to) -> const std::vector<PlaceIndex>& {
        auto& leg = ways[std::uint64_t{from} << 32 | to];
        if (!leg.empty() || from == to) return leg;
        const auto distance = grid.distances(to, false, from);
        for (PlaceIndex place = from; place != to;) {
            PlaceIndex best = traffic::kNoPlace;
            for (const PlaceIndex other : grid.next(place)) {
                if (distance[other] < distance[place]) best = other;
            }
            if (best == traffic::kNoPlace) break;
            leg.push_back(place = best);
        }
        std::reverse(leg.begin(), leg.end());
        return leg;
    };
    const auto try_leg = [&](std::size_t v, PlaceIndex to) {
        Vehicle& vehicle = vehicles[v];
        const auto& leg = way(vehicle.place, to);
        if (leg.empty()) return false;
        traffic::TileSet needed;
        PlaceIndex from = vehicle.place;
        for (auto it = leg.rbegin(); it != leg.rend(); ++it) {
            const auto& swept = moves[std::uint64_t{from} << 32 | *it]->swept;
            for (const auto tile : swept) {
                const auto held = holder.find(tile);
                if (held != holder.end() && held->second != v) return false;
            }
            needed.insert(needed.end(), swept.begin(), swept.end());
            from = *it;
        }
        for (const auto tile : needed) holder[tile] = v;
        vehicle.leg = leg;
        return true;
    };
    double now_s = 0;
    for (; now_s < seconds; now_s += world.step_s) {
        for (std::size_t v = 0; v < vehicles.size(); ++v) {
            Vehicle& vehicle = vehicles[v];
            if (!vehicle.leg.empty()) {
                const PlaceIndex to = vehicle.leg.back();
                vehicle.leg.pop_back();
                const auto& swept = moves[std::uint64_t{vehicle.place} << 32 | to]->swept;
                traffic::TileSet kept = world.graph.places[to].stand;
                if (!vehicle.leg
                         .empty()) {  // a shortest way meets floor behind it in one move only
                    const auto next = std::uint64_t{to} << 32 | vehicle.leg.back();
                    kept = traffic::merge(kept, moves[next]->swept);
                }
                for (const auto tile : swept) {
                    if (!std::binary_search(kept.begin(), kept.end(), tile)) holder.erase(tile);
                }
                vehicle.place = to;
                vehicle.moved_s = now_s;
                if (vehicle.leg.empty() && vehicle.to_goal) vehicle.dwell = dwell_steps(world);
                continue;
            }
            if (vehicle.dwell > 0) {
                if (--vehicle.dwell > 0) continue;
                ++run.orders;
                vehicle.to_goal = false;
                vehicle.wanted = traffic::kNoPlace;
            }
            // From a stop straight to the next one when that leg is free, else home.
            if (vehicle.wanted == traffic::kNoPlace) vehicle.wanted = orders.next(v);
            if (vehicle.wanted == vehicle.place) {
                vehicle.dwell = dwell_steps(world);
                continue;
            }
            if (try_leg(v, vehicle.wanted)) {
                vehicle.to_goal = true;
            } else if (vehicle.place != world.starts[v]) {
                try_leg(v, world.starts[v]);
            }
        }
    }
    run.simulated_s = now_s;
    for (const Vehicle& v : vehicles) run.stuck += now_s - v.moved_s > kStuck_s ? 1 : 0;
    return run;
}

namespace {

/// Priority inheritance with backtracking (Okumura et al., IJCAI 2019): one step of all vehicles.
/// Vehicles count as one place each; the sweep between places is not looked at, which favours it.
class Pibt {
public:
    Pibt(const World& world, Grid& grid)
        : grid_(grid),
          now_(world.graph.places.size(), kNobody),
          next_(world.graph.places.size(), kNobody) {}

    static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

    std::vector<PlaceIndex> at;      // by vehicle
    std::vector<PlaceIndex> target;  // by vehicle
    std::vector<PlaceIndex> to;      // result
    std::vector<double> priority;
    std::mt19937_64 random{7};

    void step() {
        std::fill(now_.begin(), now_.end(), kNobody);
        std::fill(next_.begin(), next_.end(), kNobody);
        to.assign(at.size(), traffic::kNoPlace);
        for (std::uint32_t v = 0; v < at.size(); ++v) now_[at[v]] = v;
        std::vector<std::uint32_t> order(at.size());
        std::iota(order.begin(), order.end(), 0U);
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return priority[a] != priority[b] ? priority[a] > priority[b] : a < b;
        });
        for (const auto v : order) {
            if (to[v] == traffic::kNoPlace) choose(v);
        }
        at = to;
    }

private:
    bool choose(std::uint32_t v) {
        const auto& distance = grid_.to(target[v]);
        std::vector<std::pair<std::uint32_t, PlaceIndex>> options;
        for (const PlaceIndex p : grid_.next(at[v])) {
            options.emplace_back(std::uint32_t{distance[p]} << 8 | (random() & 0xff), p);
        }
        options.emplace_back(std::uint32_t{distance[at[v]]} << 8, at[v]);
        std::sort(options.begin(), options.end());
        for (const auto& [cost, place] : options) {
            if (next_[place] != kNobody) continue;
            const std::uint32_t other = now_[place];
            if (other != kNobody && other != v && to[other] == at[v]) continue;  // no swaps
            next_[place] = v;
            to[v] = place;
            if (other != kNobody && other != v && to[other] == traffic::kNoPlace &&
                !choose(other)) {
                continue;
            }
            return true;
        }
        next_[at[v]] = v;
        to[v] = at[v];
        return false;
    }

    Grid& grid_;
    std::vector<std::uint32_t> now_;
    std::vector<std::uint32_t> next_;
};

}  // namespace

Run run_pibt(const World& world, double seconds) {
    Run run;
    Grid grid(world);
    Orders orders(world);
    Pibt pibt(world, grid);
    pibt.at = world.starts;
    const std::size_t count = world.starts.size();
    std::vector<int> dwell(count, 0);
    std::vector<double> order_s(count, 0);
    for (std::size_t v = 0; v < count; ++v) {
        pibt.target.push_back(orders.next(v));
        pibt.priority.push_back(0);
    }
    double now_s = 0;
    for (; now_s < seconds; now_s += world.step_s) {
        pibt.step();
        for (std::size_t v = 0; v < count; ++v) {
            pibt.priority[v] += 1 + static_cast<double>(v) * 1e-6;
            if (pibt.at[v] != pibt.target[v]) {
                dwell[v] = 0;
                continue;
            }
            pibt.priority[v] = static_cast<double>(v) * 1e-6;
            if (++dwell[v] <= dwell_steps(world)) continue;
            dwell[v] = 0;
            ++run.orders;
            order_s[v] = now_s;
            pibt.target[v] = orders.next(v);
        }
    }
    run.simulated_s = now_s;
    for (std::size_t v = 0; v < count; ++v) run.stuck += now_s - order_s[v] > kStuck_s ? 1 : 0;
    return run;
}

}  // namespace pulseline::bench
