#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <set>
#include <unordered_map>

#include "tests/bench/traffic_world.hpp"

// What a floor lets through at most, whoever controls it, as long as a piece of floor has one
// holder at a time: a move holds all it sweeps while it lasts.
//
// Give every tile t a price y_t >= 0 for each second that somebody holds it, all prices together
// 1. In a second no more than 1 can be paid, since no tile has two holders. An order from a goal to
// the next pays at least the cheapest way's price, so orders per second <= 1 / (mean price of the
// cheapest ways). Any prices give a true bound (weak duality of the maximum concurrent flow); good
// ones are found by raising those of the tiles that cheapest ways use (multiplicative weights, Garg
// and Koenemann, FOCS 1998).
namespace pulseline::bench {
namespace {

constexpr int kRounds = 600;
constexpr int kGoalsOfARound = 40;
constexpr int kGoalsAtTheEnd = 300;
constexpr double kStep = 0.05;
constexpr double kEver = std::numeric_limits<double>::infinity();

class Prices {
public:
    Prices(const World& world, std::size_t zone)
        : world_(world),
          goals_(world.goals[zone]),
          graph_(world.graphs[graph_of(world, zone)]),
          into_(graph_.places.size()) {
        for (std::size_t m = 0; m < graph_.moves.size(); ++m) {
            into_[graph_.moves[m].to].push_back(m);
            tiles_of_.push_back(numbers_of(graph_.moves[m].swept));
        }
        for (const auto& place : graph_.places) stand_of_.push_back(numbers_of(place.stand));
        price_.assign(numbers_.size(), 1.0);
        mean_.assign(numbers_.size(), 0.0);
        move_price_.resize(graph_.moves.size());
        keep_to_reachable();
    }

    double orders_per_hour() {
        for (int round = 0; round < kRounds; ++round) {
            raise();
            if (round < kRounds / 2) continue;
            for (std::size_t t = 0; t < price_.size(); ++t) mean_[t] += price_[t];
        }
        price_ = mean_;
        normalise();
        double sum = 0;
        std::size_t ways = 0;
        const bool all = goals_.size() <= kGoalsAtTheEnd;
        for (int i = 0; i < (all ? static_cast<int>(goals_.size()) : kGoalsAtTheEnd); ++i) {
            const PlaceIndex goal = all ? goals_[static_cast<std::size_t>(i)] : any_goal();
            const auto cost = costs_to(goal);
            for (const PlaceIndex from : goals_) {
                sum += cost[from] + world_.dwell_s * price_of(stand_of_[goal]);
                ++ways;
            }
        }
        return 3600.0 * static_cast<double>(ways) / sum;
    }

private:
    using Numbers = std::vector<std::uint32_t>;

    static GraphIndex graph_of(const World& world, std::size_t zone) {
        for (const auto& vehicle : world.vehicles) {
            if (vehicle.zone == zone) return vehicle.graph;
        }
        return 0;
    }

    Numbers numbers_of(const traffic::TileSet& tiles) {
        Numbers numbers;
        for (const auto tile : tiles) {
            numbers.push_back(
                numbers_.try_emplace(tile, static_cast<std::uint32_t>(numbers_.size()))
                    .first->second);
        }
        return numbers;
    }

    /// Tiles of other zones on the same graph have no part in it.
    void keep_to_reachable() {
        normalise();
        const auto cost = costs_to(goals_.front());
        std::vector<char> used(price_.size(), 0);
        for (std::size_t m = 0; m < graph_.moves.size(); ++m) {
            if (std::isinf(cost[graph_.moves[m].to])) continue;
            for (const auto t : tiles_of_[m]) used[t] = 1;
        }
        for (std::size_t t = 0; t < price_.size(); ++t) price_[t] = used[t];
    }

    PlaceIndex any_goal() { return goals_[random_() % goals_.size()]; }

    double price_of(const Numbers& tiles) const {
        double sum = 0;
        for (const auto t : tiles) sum += price_[t];
        return sum;
    }

    void normalise() {
        double sum = 0;
        for (const double price : price_) sum += price;
        for (double& price : price_) price /= sum;
        for (std::size_t m = 0; m < graph_.moves.size(); ++m) {
            move_price_[m] = graph_.moves[m].duration_s * price_of(tiles_of_[m]);
        }
    }

    /// Of the cheapest way from every place, and in next_ its first move.
    std::vector<double> costs_to(PlaceIndex goal) {
        std::vector<double> cost(graph_.places.size(), kEver);
        next_.assign(graph_.places.size(), std::numeric_limits<std::size_t>::max());
        using Entry = std::pair<double, PlaceIndex>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
        cost[goal] = 0;
        open.emplace(0, goal);
        while (!open.empty()) {
            const auto [at, place] = open.top();
            open.pop();
            if (at > cost[place]) continue;
            for (const std::size_t m : into_[place]) {
                const PlaceIndex from = graph_.moves[m].from;
                const double there = at + move_price_[m];
                if (there >= cost[from]) continue;
                cost[from] = there;
                next_[from] = m;
                open.emplace(there, from);
            }
        }
        return cost;
    }

    void raise() {
        normalise();
        std::vector<double> held_s(price_.size(), 0);
        for (int i = 0; i < kGoalsOfARound; ++i) {
            const PlaceIndex goal = any_goal();
            costs_to(goal);
            for (int k = 0; k < kGoalsOfARound; ++k) {
                for (const auto t : stand_of_[goal]) held_s[t] += world_.dwell_s;
                for (PlaceIndex place = any_goal(); place != goal;) {
                    const auto& move = graph_.moves[next_[place]];
                    for (const auto t : tiles_of_[next_[place]]) held_s[t] += move.duration_s;
                    place = move.to;
                }
            }
        }
        const double most_s = *std::max_element(held_s.begin(), held_s.end());
        for (std::size_t t = 0; t < price_.size(); ++t) {
            price_[t] *= std::exp(kStep * held_s[t] / most_s);
        }
    }

    const World& world_;
    const std::vector<PlaceIndex>& goals_;
    const traffic::MoveGraph& graph_;
    std::vector<std::vector<std::size_t>> into_;  // moves by the place they lead to
    std::unordered_map<traffic::TileId, std::uint32_t> numbers_;
    std::vector<Numbers> tiles_of_;  // by move
    std::vector<Numbers> stand_of_;  // by place
    std::vector<double> price_;      // by tile
    std::vector<double> mean_;
    std::vector<double> move_price_;
    std::vector<std::size_t> next_;
    std::mt19937_64 random_{7};
};

}  // namespace

double floor_capacity(const World& world) {
    double sum = 0;
    for (std::size_t zone = 0; zone < world.goals.size(); ++zone) {
        sum += Prices(world, zone).orders_per_hour();
    }
    return sum;
}

}  // namespace pulseline::bench
