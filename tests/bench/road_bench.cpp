#include "tests/bench/road_bench.hpp"

#include <algorithm>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <chrono>
#include <cstdio>
#include <random>

#include "core/planning/roads/road_alternatives.hpp"
#include "core/planning/roads/road_router.hpp"

namespace pulseline::bench {
namespace {

using namespace planning;
using Timer = std::chrono::steady_clock;

constexpr int kSide = 100;
constexpr int kLanes = 40'000;
constexpr std::size_t kStations = 250;

double us_since(Timer::time_point begin) {
    return std::chrono::duration<double, std::micro>(Timer::now() - begin).count();
}

/// Streets of a town: a lattice of 5 m with jitter, and some diagonals, all two-way.
RoadGraph roadmap() {
    std::mt19937 random(31);
    std::uniform_real_distribution<double> jitter(-0.2, 0.2);
    RoadGraph graph;
    for (int row = 0; row < kSide; ++row) {
        for (int col = 0; col < kSide; ++col) {
            graph.add_node({col * 5 + jitter(random), row * 5 + jitter(random)});
        }
    }
    const auto both_ways = [&](int a, int b) {
        graph.add_arc(a, b);
        graph.add_arc(b, a);
    };
    for (int row = 0; row < kSide; ++row) {
        for (int col = 0; col < kSide; ++col) {
            const int at = row * kSide + col;
            if (col + 1 < kSide) both_ways(at, at + 1);
            if (row + 1 < kSide) both_ways(at, at + kSide);
        }
    }
    while (static_cast<int>(graph.arcs.size()) < kLanes) {
        const int at = static_cast<int>(random() % ((kSide - 1) * kSide - 1));
        if (at % kSide + 1 < kSide) both_ways(at, at + kSide + 1);
    }
    return graph;
}

struct Times {
    std::vector<double> us;
    double mean() const {
        double sum = 0;
        for (const double t : us) sum += t;
        return sum / static_cast<double>(us.size());
    }
    double quantile(double q) const {
        auto sorted = us;
        std::sort(sorted.begin(), sorted.end());
        return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
    }
};

void show(nlohmann::json& figures, const char* name, const Times& times) {
    std::printf("  %-46s %10.1f %10.1f %10.1f\n", name, times.mean(), times.quantile(0.5),
                times.quantile(0.99));
    std::fflush(stdout);
    figures[name] = {{"mean_us", times.mean()},
                     {"p50_us", times.quantile(0.5)},
                     {"p99_us", times.quantile(0.99)}};
}

/// Boost's graph of arcs as vertices: sees changes of direction, as ours. Backwards from a goal, so
/// that one run gives what one of our tables gives.
class BoostArcs {
public:
    explicit BoostArcs(const RoadView& view) : left_(static_cast<std::size_t>(view.arcs())) {
        std::vector<std::pair<int, int>> edges;
        std::vector<RoadCost> costs;
        for (int arc = 0; arc < view.arcs(); ++arc) {
            for (const RoadView::Link before : view.before(arc)) {
                edges.push_back({arc, before.arc()});
                costs.push_back(view.cost(arc, before.turn()));
            }
        }
        graph_ = Graph(boost::edges_are_unsorted_multi_pass, edges.begin(), edges.end(),
                       costs.begin(), static_cast<std::size_t>(view.arcs()));
    }
    /// Cost from the end of every arc to the node that `last` arcs lead to: the least over them.
    const std::vector<RoadCost>& run(int last) {
        boost::dijkstra_shortest_paths(
            graph_, static_cast<std::size_t>(last),
            boost::weight_map(boost::get(boost::edge_bundle, graph_))
                .distance_map(boost::make_iterator_property_map(
                    left_.begin(), boost::get(boost::vertex_index, graph_))));
        return left_;
    }

private:
    using Graph =
        boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, RoadCost>;
    Graph graph_;
    std::vector<RoadCost> left_;
};

}  // namespace

nlohmann::json bench_roads() {
    std::mt19937 random(32);
    RoadGraph graph = roadmap();
    const auto node = [&] { return static_cast<int>(random() % (kSide * kSide)); };
    std::vector<int> stations;
    for (std::size_t i = 0; i < kStations; ++i) stations.push_back(node());
    const auto station = [&] { return stations[random() % kStations]; };
    RoadRouter router(std::move(graph), {}, {});
    const int user = router.add_user({});

    nlohmann::json figures;
    std::printf("\nroadmap: %zu nodes, %zu directed lanes, %zu stations\n",
                router.graph().nodes.size(), router.graph().arcs.size(), stations.size());
    std::printf("  %-46s %10s %10s %10s\n", "", "mean us", "p50 us", "p99 us");

    Times builds;
    for (const int goal : stations) {
        const auto begin = Timer::now();
        router.table(user, goal);
        builds.us.push_back(us_since(begin));
    }
    show(figures, "table of one station", builds);

    BoostArcs boosted(router.view(user));
    Times boost_runs;
    for (int i = 0; i < 20; ++i) {
        const int goal = station();
        const int last = router.graph().in[static_cast<std::size_t>(goal)].front();
        const auto begin = Timer::now();
        const auto& left = boosted.run(last);
        boost_runs.us.push_back(us_since(begin));
        // Boost's run ends in one arc, a table in the node: equal where that arc is the best end.
        const CostTable& table = router.table(user, goal);
        for (int arc = 0; arc < router.view(user).arcs(); ++arc) {
            int end = arc;
            while (table.next(end) >= 0) end = table.next(end);
            const auto known = left[static_cast<std::size_t>(arc)];
            if (known < table.left(arc) || (end == last && known != table.left(arc))) {
                std::fprintf(stderr, "Boost disagrees on a cost\n");
                std::exit(1);
            }
        }
    }
    show(figures, "Boost dijkstra_shortest_paths, same table", boost_runs);

    RoadRoute route;
    Times queries;
    std::size_t lanes = 0;
    for (int i = 0; i < 20'000; ++i) {
        const RoadStart start{node(), 0.0};
        const int goal = station();
        const auto begin = Timer::now();
        router.find(user, start, goal, route);
        queries.us.push_back(us_since(begin));
        lanes += route.arcs.size();
    }
    show(figures, "route with tables", queries);
    std::printf("  mean route: %.1f lanes\n", static_cast<double>(lanes) / 20'000);

    Times closures;
    for (int i = 0; i < 200; ++i) {
        const int goal = station();
        const RoadStart start{node(), 0.0};
        router.find(user, start, goal, route);
        if (route.arcs.empty()) continue;
        const int arc = route.arcs[random() % route.arcs.size()];  // one that hurts
        const auto begin = Timer::now();
        router.set_closed(arc, true);
        router.find(user, start, goal, route);
        closures.us.push_back(us_since(begin));
        router.set_closed(arc, false);
        router.find(user, start, goal, route);
    }
    show(figures, "closure of a lane to the next right answer", closures);

    std::vector<RoadStart> vehicles;
    std::vector<int> orders;
    for (int i = 0; i < 1'000; ++i) {
        vehicles.push_back({node(), 0.0});
        orders.push_back(station());
    }
    std::vector<RoadCost> matrix;
    Times following;
    Times matrices;
    for (int i = 0; i < 5; ++i) {
        const int arc = static_cast<int>(random() % kLanes);
        router.set_closed(arc, true);
        auto begin = Timer::now();
        router.costs(user, vehicles, orders, matrix);
        following.us.push_back(us_since(begin));
        for (int k = 0; k < 4; ++k) {
            begin = Timer::now();
            router.costs(user, vehicles, orders, matrix);
            matrices.us.push_back(us_since(begin));
        }
        router.set_closed(arc, false);
    }
    show(figures, "1,000 x 1,000 costs", matrices);
    show(figures, "the same after a closure, all tables following", following);

    Times previews;
    std::size_t found = 0;
    for (int i = 0; i < 50; ++i) {
        const RoadStart start{node(), 0.0};
        const int goal = station();
        router.find(user, start, goal, route);
        const auto begin = Timer::now();
        found += alternatives(router, user, start, goal, {}).size();
        previews.us.push_back(us_since(begin));
    }
    show(figures, "three alternatives", previews);

    const std::size_t table_bytes = router.table(user, stations.front()).bytes();
    std::printf("  memory: %.2f MB a table, %.2f MB in all; %.1f alternatives on average\n",
                static_cast<double>(table_bytes) / 1e6, static_cast<double>(router.bytes()) / 1e6,
                static_cast<double>(found) / 50);
    figures["table_bytes"] = table_bytes;
    figures["bytes"] = router.bytes();
    figures["mean_lanes"] = static_cast<double>(lanes) / 20'000;
    return figures;
}

}  // namespace pulseline::bench
