#include <algorithm>
#include <numeric>
#include <random>
#include <utility>

#include "tests/bench/traffic_grid.hpp"
#include "tests/bench/traffic_world.hpp"

namespace pulseline::bench {
namespace {

/// Priority inheritance with backtracking (Okumura et al., IJCAI 2019): one step of all vehicles.
/// Vehicles count as one place each; the sweep between places is not looked at, which favours it.
/// As published a vehicle enters a place in the very step in which another leaves it, so both hold
/// it for a while. Where `one_holder`, it enters a place that was free before the step, as all
/// vehicles of this project have to: it pushes who stands there and follows a step later.
class Pibt {
public:
    Pibt(const World& world, Grid& grid, bool one_holder)
        : grid_(grid),
          one_holder_(one_holder),
          now_(world.graphs[0].places.size(), kNobody),
          next_(world.graphs[0].places.size(), kNobody) {}

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
            if (to[v] != traffic::kNoPlace) continue;
            if (one_holder_) {
                choose_free(v, false);
            } else {
                choose(v);
            }
        }
        at = to;
    }

private:
    std::vector<std::pair<std::uint32_t, PlaceIndex>> options_of(std::uint32_t v) {
        const auto& distance = grid_.to(target[v]);
        std::vector<std::pair<std::uint32_t, PlaceIndex>> options;
        for (const PlaceIndex p : grid_.next(at[v])) {
            options.emplace_back(std::uint32_t{distance[p]} << 8 | (random() & 0xff), p);
        }
        options.emplace_back(std::uint32_t{distance[at[v]]} << 8, at[v]);
        std::sort(options.begin(), options.end());
        return options;
    }

    /// Nobody else can take the place where it stands, so who waits hinders nobody's step.
    void choose_free(std::uint32_t v, bool pushed) {
        const auto options = options_of(v);
        const auto is_free = [&](PlaceIndex place) {
            return next_[place] == kNobody && now_[place] == kNobody;
        };
        const auto free = std::find_if(options.begin(), options.end(), [&](const auto& option) {
            return is_free(option.second) || (!pushed && option.second == at[v]);
        });
        to[v] = free == options.end() ? at[v] : free->second;
        next_[to[v]] = v;
        // What is better than that and taken: who stands there is asked to leave.
        for (auto option = options.begin(); option != free; ++option) {
            const std::uint32_t other = now_[option->second];
            if (other == kNobody || other == v || to[other] != traffic::kNoPlace) continue;
            if (to[v] != at[v] && !pushed) {
                next_[to[v]] = kNobody;  // it waits for that place rather than go round
                to[v] = at[v];
                next_[at[v]] = v;
            }
            choose_free(other, true);
            break;
        }
    }

    bool choose(std::uint32_t v) {
        for (const auto& [cost, place] : options_of(v)) {
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
    bool one_holder_;
    std::vector<std::uint32_t> now_;
    std::vector<std::uint32_t> next_;
};

}  // namespace

std::optional<Run> run_pibt(const World& world, double seconds, bool one_holder) {
    const auto more_than_a_step = [&](const auto& m) { return world.steps_of(m.duration_s) != 1; };
    const auto& moves = world.graphs[0].moves;
    if (world.graphs.size() > 1 || std::any_of(moves.begin(), moves.end(), more_than_a_step)) {
        return {};
    }
    Run run;
    Grid grid(world.graphs[0]);
    Orders orders(world);
    Pibt pibt(world, grid, one_holder);
    const std::size_t count = world.vehicles.size();
    std::vector<int> dwell(count, 0);
    std::vector<double> order_s(count, 0);
    for (std::size_t v = 0; v < count; ++v) {
        pibt.at.push_back(world.vehicles[v].start);
        pibt.target.push_back(orders.next(v));
        pibt.priority.push_back(0);
    }
    for (; run.simulated_s < seconds; run.simulated_s += world.step_s) {
        pibt.step();
        for (std::size_t v = 0; v < count; ++v) {
            const double first_come = static_cast<double>(v) * 1e-6;
            pibt.priority[v] += 1 + first_come;
            if (pibt.at[v] != pibt.target[v]) {
                dwell[v] = 0;
                continue;
            }
            pibt.priority[v] = first_come;
            if (++dwell[v] <= world.steps_of(world.dwell_s)) continue;
            dwell[v] = 0;
            ++run.orders;
            order_s[v] = run.simulated_s;
            pibt.target[v] = orders.next(v);
        }
    }
    for (std::size_t v = 0; v < count; ++v) {
        run.stuck += run.simulated_s - order_s[v] > kStuck_s ? 1 : 0;
    }
    return run;
}

}  // namespace pulseline::bench
