#include "core/planning/roads/road_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <limits>
#include <queue>
#include <random>

#include "core/planning/roads/road_router.hpp"

namespace pulseline::planning {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

plant::RoutingCost routing(double k_same, double k_diff, double step = 1) {
    return {.k_same = k_same, .k_diff = k_diff, .reference_step_m = step};
}

double charged(const plant::RoutingCost& k, double length_m, bool turn) {
    const double sum =
        k.k_same * length_m + (turn ? (k.k_diff - k.k_same) * k.reference_step_m : 0);
    return sum < 0 ? 0 : sum;
}

bool turns(const plant::RoutingCost& k, double a, double b) {
    return std::abs(std::remainder(b - a, 2 * kPi)) > k.turn_threshold_rad;
}

/// Judge: Dijkstra over directed arcs, nothing clever.
double dijkstra(const RoadGraph& graph, const plant::RoutingCost& k, int from, int to,
                std::optional<double> heading, const std::vector<bool>& closed) {
    if (from == to) return 0;
    std::vector<double> best(graph.arcs.size(), kInfinite);
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto reach = [&](std::size_t arc, double cost) {
        if (closed[arc] || cost >= best[arc]) return;
        best[arc] = cost;
        open.push({cost, arc});
    };
    for (std::size_t i = 0; i < graph.arcs.size(); ++i) {
        const RoadArc& arc = graph.arcs[i];
        if (arc.from != from) continue;
        reach(i, charged(k, arc.length_m, heading && turns(k, *heading, arc.heading_rad)));
    }
    double least = kInfinite;
    while (!open.empty()) {
        const auto [cost, i] = open.top();
        open.pop();
        if (cost > best[i]) continue;
        if (graph.arcs[i].to == to) least = std::min(least, cost);
        for (std::size_t n = 0; n < graph.arcs.size(); ++n) {
            const RoadArc& next = graph.arcs[n];
            if (next.from != graph.arcs[i].to) continue;
            reach(n, cost + charged(k, next.length_m,
                                    turns(k, graph.arcs[i].heading_rad, next.heading_rad)));
        }
    }
    return least;
}

RoadGraph random_graph(std::mt19937_64& random) {
    RoadGraph graph;
    const int nodes = 2 + static_cast<int>(random() % 14);
    const bool lattice = random() % 2 == 0;  // many equal costs and straight continuations
    std::uniform_real_distribution<double> place(0, 20);
    for (int i = 0; i < nodes; ++i) {
        if (lattice) {
            graph.add_node({double(random() % 5), double(random() % 4)});
        } else {
            graph.add_node({place(random), place(random)});
        }
    }
    const int arcs = static_cast<int>(random() % static_cast<unsigned>(nodes * 4));
    for (int i = 0; i < arcs; ++i) {
        const int a = static_cast<int>(random() % static_cast<unsigned>(nodes));
        const int b = static_cast<int>(random() % static_cast<unsigned>(nodes));
        if (a == b) continue;
        graph.add_arc(a, b);
        if (random() % 2 == 0) graph.add_arc(b, a);
    }
    return graph;
}

void expect_valid(const RoadGraph& graph, const plant::RoutingCost& k, const RoadPath& path,
                  int from, int to, std::optional<double> heading,
                  const std::vector<bool>& closed) {
    double cost = 0;
    double length = 0;
    int turn_count = 0;
    int node = from;
    for (const int index : path.arcs) {
        const RoadArc& arc = graph.arcs[static_cast<std::size_t>(index)];
        EXPECT_FALSE(closed[static_cast<std::size_t>(index)]);
        EXPECT_EQ(arc.from, node);
        const bool turn = heading && turns(k, *heading, arc.heading_rad);
        cost += charged(k, arc.length_m, turn);
        length += arc.length_m;
        turn_count += turn ? 1 : 0;
        heading = arc.heading_rad;
        node = arc.to;
    }
    EXPECT_EQ(node, to);
    EXPECT_NEAR(path.cost, cost, 1e-9 * (1 + cost));
    EXPECT_NEAR(path.length_m, length, 1e-9 * (1 + length));
    EXPECT_EQ(path.turns, turn_count);
}

TEST(RoadSearch, CostsWhatDijkstraSaysOnRandomGraphs) {
    const double same[] = {0, 0.3, 0.8, 1, 2.5, 10};
    const double diff[] = {0, 0.1, 0.5, 1, 1.6, 7, 20, 100};
    const double steps[] = {0.2, 1, 5};
    std::mt19937_64 random(42);
    int routes = 0;
    int cheap_turns = 0;
    for (int i = 0; i < 6'000; ++i) {
        const RoadGraph graph = random_graph(random);
        const auto k = routing(same[random() % 6], diff[random() % 8], steps[random() % 3]);
        const auto nodes = static_cast<unsigned>(graph.nodes.size());
        const int from = static_cast<int>(random() % nodes);
        const int to = static_cast<int>(random() % nodes);
        std::optional<double> heading;
        if (random() % 2 == 0) heading = double(random() % 8) * kPi / 4 - kPi;
        std::vector<bool> closed(graph.arcs.size());
        for (std::size_t a = 0; a < closed.size(); ++a) closed[a] = random() % 8 == 0;

        const auto path = find_path(graph, k, from, to, heading, [&](int arc) {
            return !closed[static_cast<std::size_t>(arc)];
        });

        const double judged = dijkstra(graph, k, from, to, heading, closed);
        ASSERT_EQ(path.has_value(), judged < kInfinite) << "graph " << i;
        if (!path) continue;
        ASSERT_NEAR(path->cost, judged, 1e-9 * (1 + judged)) << "graph " << i;
        expect_valid(graph, k, *path, from, to, heading, closed);
        ++routes;
        cheap_turns += k.k_diff < k.k_same ? 1 : 0;
    }
    EXPECT_GT(routes, 3'000);
    EXPECT_GT(cheap_turns, 1'000);
}

/// A ladder: a short way with many corners below, a long one with two above.
RoadGraph stairs() {
    RoadGraph graph;
    for (const geometry::Point2 p :
         {geometry::Point2{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {3, 2}, {0, 6}, {3, 6}}) {
        graph.add_node(p);
    }
    for (int i = 0; i < 5; ++i) graph.add_arc(i, i + 1);
    graph.add_arc(0, 6);
    graph.add_arc(6, 7);
    graph.add_arc(7, 5);
    return graph;
}

/// Streets on a jittered lattice, every lane to be driven forwards or backwards.
RoadGraph town(std::mt19937_64& random, int side) {
    std::uniform_real_distribution<double> jitter(-0.2, 0.2);
    RoadGraph graph;
    for (int i = 0; i < side * side; ++i) {
        graph.add_node({5 * (i % side) + jitter(random), 5 * (i / side) + jitter(random)});
    }
    for (int i = 0; i < side * side; ++i) {
        for (const int to :
             {i % side + 1 < side ? i + 1 : i, i + side < side * side ? i + side : i}) {
            if (to == i) continue;
            for (const auto& [a, b] : {std::pair(i, to), {to, i}}) {
                graph.add_arc(a, b);
                graph.arcs[static_cast<std::size_t>(graph.add_arc(a, b, true))].burden = 0.01;
            }
        }
    }
    return graph;
}

TEST(RoadSearch, AnExactBoundLeavesTheAnswerAndLooksAtLittleMoreThanThePath) {
    std::mt19937_64 random(77);
    for (const double k_diff : {20.0, 10.0, 4.0, 200.0}) {
        const auto k = routing(10, k_diff);
        const RoadGraph graph = town(random, 24);
        RoadPreferences rounded_down{k};
        rounded_down.round_down = true;
        RoadRouter router(graph, {}, rounded_down);
        const int user = router.add_user({});
        std::vector<bool> closed(graph.arcs.size(), false);
        for (int i = 0; i < 100; ++i) {
            const int arc = static_cast<int>(random() % graph.arcs.size());
            closed[static_cast<std::size_t>(arc)] = true;
            router.set_closed(arc, true);
            const int from = static_cast<int>(random() % graph.nodes.size());
            RoadQuery query;
            query.goal = static_cast<int>(random() % graph.nodes.size());
            if (from == query.goal) continue;
            query.usable = [&](int a) { return !closed[static_cast<std::size_t>(a)]; };
            for (const int a : graph.out[static_cast<std::size_t>(from)]) {
                query.first.push_back({a, 0, random() % 2 == 0, double(random() % 3)});
            }

            const auto plain = search_road(graph, k, query);
            const CostTable& table = router.table(user, query.goal);
            query.left = [&](int a) {
                const RoadCost left = table.left(a);
                return left == kNoWay ? kInfinite : std::max(0.0, left / 1000.0 - 1e-6);
            };
            const auto bounded = search_road(graph, k, query);

            ASSERT_EQ(plain.has_value(), bounded.has_value());
            if (!plain) continue;
            ASSERT_EQ(plain->arcs, bounded->arcs);
            ASSERT_EQ(plain->cost, bounded->cost);
            ASSERT_LE(bounded->expanded, 4 * static_cast<int>(bounded->arcs.size()) + 8);
        }
    }
}

TEST(RoadSearch, TradesLengthAgainstChangesOfDirection) {
    const auto free_turns = find_path(stairs(), routing(10, 10), 0, 5);
    const auto dear_turns = find_path(stairs(), routing(10, 100), 0, 5);

    ASSERT_TRUE(free_turns);
    EXPECT_EQ(free_turns->turns, 4);
    EXPECT_DOUBLE_EQ(free_turns->cost, 50);
    ASSERT_TRUE(dear_turns);
    EXPECT_EQ(dear_turns->turns, 2);
    EXPECT_DOUBLE_EQ(dear_turns->length_m, 13);
    EXPECT_DOUBLE_EQ(dear_turns->cost, 130 + 2 * 90);
}

TEST(RoadSearch, CountsAUTurnAsOneChange) {
    RoadGraph graph;
    graph.add_node({0, 0});
    graph.add_node({5, 0});
    graph.add_arc(0, 1);

    const auto path = find_path(graph, routing(10, 20), 0, 1, kPi);

    ASSERT_TRUE(path);
    EXPECT_EQ(path->turns, 1);
    EXPECT_DOUBLE_EQ(path->cost, 60);
}

TEST(RoadSearch, NamesWhatIsWrong) {
    const RoadGraph graph = stairs();
    EXPECT_EQ(find_path(graph, routing(10, 20), 5, 0).error().reason.code, "no_route");
    EXPECT_EQ(find_path(graph, routing(10, 20), 0, 99).error().reason.code, "unknown_node");
    const auto bad = find_path(graph, routing(-1, 20), 0, 5);
    EXPECT_EQ(bad.error().reason.code, "routing_cost_invalid");
    EXPECT_EQ(bad.error().field, "/routing/k_same");
    EXPECT_FALSE(find_path(graph, routing(1, std::nan("")), 0, 5));
}

}  // namespace
}  // namespace pulseline::planning
