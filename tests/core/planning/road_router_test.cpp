#include "core/planning/roads/road_router.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <random>
#include <thread>

#include "core/planning/roads/road_alternatives.hpp"
#include "core/planning/roads/road_explain.hpp"
#include "tests/core/planning/counted_new.hpp"

namespace pulseline::planning {
namespace {

using Random = std::mt19937_64;

constexpr std::int64_t kUnreached = std::numeric_limits<std::int64_t>::max();

/// Cost of driving an arc by the formula alone.
std::int64_t charged(const RoadPreferences& k, const RoadArc& arc, const LaneRules& rules,
                     const RoadUser& user, bool turn) {
    double speed = 1e300;
    if (rules.max_speed_mps > 0) speed = std::min(speed, rules.max_speed_mps);
    if (user.loaded && rules.max_speed_loaded_mps > 0) {
        speed = std::min(speed, rules.max_speed_loaded_mps);
    }
    if (user.max_speed_mps > 0) speed = std::min(speed, user.max_speed_mps);
    const auto thousandths = [](double cost) { return std::int64_t{std::llround(cost * 1000)}; };
    const double way = k.cost.k_same * arc.length_m;
    std::int64_t cost =
        thousandths(way) + thousandths(k.cost.accuracy_k * rules.sigma_m * arc.length_m);
    if (speed < k.reference_speed_mps)
        cost += thousandths(way * (k.reference_speed_mps / speed - 1));
    if (turn) cost += thousandths((k.cost.k_diff - k.cost.k_same) * k.cost.reference_step_m);
    return std::max(std::int64_t{0}, cost);
}

bool turns(const RoadPreferences& k, double a, double b) {
    return std::abs(std::remainder(b - a, 2 * kPi)) > k.cost.turn_threshold_rad;
}

/// A random roadmap with everything that rules may say, and a judge that knows nothing clever.
struct World {
    RoadGraph graph;
    std::vector<LaneRules> rules;
    RoadPreferences preferences;
    RoadUser user;

    bool open(std::size_t arc) const {
        return !rules[arc].closed && (rules[arc].classes & user.vehicle_class) != 0;
    }
    std::int64_t judge(const RoadStart& start, int goal) const {
        if (start.node == goal) return 0;
        std::vector<std::int64_t> best(graph.arcs.size(), kUnreached);
        using Entry = std::pair<std::int64_t, std::size_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        const auto reach = [&](std::size_t arc, std::int64_t from, bool turn) {
            if (!open(arc)) return;
            const auto cost = from + charged(preferences, graph.arcs[arc], rules[arc], user, turn);
            if (cost >= best[arc]) return;
            best[arc] = cost;
            queue.push({cost, arc});
        };
        for (std::size_t a = 0; a < graph.arcs.size(); ++a) {
            if (graph.arcs[a].from != start.node) continue;
            reach(a, 0,
                  start.heading_rad &&
                      turns(preferences, *start.heading_rad, graph.arcs[a].heading_rad));
        }
        while (!queue.empty()) {
            const auto [cost, a] = queue.top();
            queue.pop();
            if (cost > best[a]) continue;
            if (graph.arcs[a].to == goal) return cost;
            for (std::size_t n = 0; n < graph.arcs.size(); ++n) {
                if (graph.arcs[n].from != graph.arcs[a].to) continue;
                if (user.may_follow && !user.may_follow(int(a), int(n))) continue;
                reach(n, cost,
                      turns(preferences, graph.arcs[a].heading_rad, graph.arcs[n].heading_rad));
            }
        }
        return kUnreached;
    }
    /// Empty when the route is as it says.
    std::string fault(const RoadStart& start, int goal, const RoadRoute& route) const {
        int node = start.node;
        auto heading = start.heading_rad;
        std::int64_t cost = 0;
        int count = 0;
        for (std::size_t i = 0; i < route.arcs.size(); ++i) {
            const auto a = static_cast<std::size_t>(route.arcs[i]);
            if (graph.arcs[a].from != node) return "jumps";
            if (!open(a)) return "drives a barred lane";
            if (i > 0 && user.may_follow && !user.may_follow(route.arcs[i - 1], int(a))) {
                return "turns where there is no room";
            }
            const bool turn = heading && turns(preferences, *heading, graph.arcs[a].heading_rad);
            cost += charged(preferences, graph.arcs[a], rules[a], user, turn);
            count += turn ? 1 : 0;
            heading = graph.arcs[a].heading_rad;
            node = graph.arcs[a].to;
        }
        if (node != goal) return "does not reach the goal";
        if (cost != route.cost) return "miscounts its cost";
        return count == route.turns ? "" : "miscounts its turns";
    }
};

LaneRules random_rules(Random& random) {
    LaneRules rules;
    rules.closed = random() % 10 == 0;
    if (random() % 4 == 0) rules.max_speed_mps = 0.2 + double(random() % 10) / 5;
    if (random() % 4 == 0) rules.max_speed_loaded_mps = 0.1 + double(random() % 10) / 9;
    if (random() % 8 == 0) rules.classes = random() % 4;
    if (random() % 3 == 0) rules.sigma_m = double(random() % 20) / 1000;
    return rules;
}

World random_world(Random& random, int most_nodes) {
    World world;
    const int nodes = 2 + static_cast<int>(random() % static_cast<unsigned>(most_nodes));
    for (int i = 0; i < nodes; ++i) {
        world.graph.add_node({double(random() % 8), double(random() % 6)});
    }
    for (int i = static_cast<int>(random() % static_cast<unsigned>(nodes * 4)); i > 0; --i) {
        const int a = static_cast<int>(random() % static_cast<unsigned>(nodes));
        const int b = static_cast<int>(random() % static_cast<unsigned>(nodes));
        if (a == b) continue;
        world.graph.add_arc(a, b);
        if (random() % 3 != 0) world.graph.add_arc(b, a);  // else one-way
    }
    for (std::size_t i = 0; i < world.graph.arcs.size(); ++i) {
        world.rules.push_back(random_rules(random));
    }
    const double k[] = {0, 0.3, 0.8, 1, 2.5, 10};
    const double diff[] = {0, 0.5, 1, 1.6, 7, 20, 100};
    world.preferences.cost.k_same = k[random() % 6];
    world.preferences.cost.k_diff = diff[random() % 7];
    if (random() % 2 == 0) world.preferences.reference_speed_mps = 1.5;
    if (random() % 2 == 0) world.preferences.cost.accuracy_k = 100;
    world.user.vehicle_class = 1 + random() % 2;
    world.user.loaded = random() % 2 == 0;
    if (random() % 3 == 0) {
        world.user.may_follow = [](int arc, int next) { return (arc * 31 + next) % 5 != 0; };
    }
    return world;
}

RoadStart random_start(Random& random, const World& world) {
    RoadStart start;
    start.node = static_cast<int>(random() % world.graph.nodes.size());
    if (random() % 2 == 0) start.heading_rad = double(random() % 8) * kPi / 4 - kPi;
    return start;
}

TEST(RoadRouter, CostsWhatDijkstraSaysThroughClosuresAndSpeedChanges) {
    Random random(21);
    int routes = 0;
    for (int i = 0; i < 800; ++i) {
        World world = random_world(random, 16);
        RoadRouter router(world.graph, world.rules, world.preferences);
        const int user = router.add_user(world.user);
        RoadRoute route;
        for (int k = 0; k < 20; ++k) {
            for (int edits = static_cast<int>(random() % 3); edits > 0 && !world.graph.arcs.empty();
                 --edits) {
                const auto arc = random() % world.graph.arcs.size();
                world.rules[arc] = random_rules(random);
                router.set_rules(static_cast<int>(arc), world.rules[arc]);
            }
            const RoadStart start = random_start(random, world);
            const int goal = static_cast<int>(random() % world.graph.nodes.size());

            const bool found = router.find(user, start, goal, route);

            const std::int64_t judged = world.judge(start, goal);
            ASSERT_EQ(found, judged != kUnreached) << "world " << i << " query " << k;
            ASSERT_EQ(router.cost(user, start, goal),
                      found ? static_cast<RoadCost>(judged) : kNoWay);
            if (!found) continue;
            ASSERT_EQ(route.cost, judged) << "world " << i << " query " << k;
            ASSERT_EQ(world.fault(start, goal, route), "") << "world " << i << " query " << k;
            ++routes;
        }
    }
    EXPECT_GT(routes, 4'000);
}

TEST(RoadRouter, MatrixHoldsEveryCost) {
    Random random(5);
    const World world = random_world(random, 40);
    RoadRouter router(world.graph, world.rules, world.preferences);
    const int user = router.add_user(world.user);
    std::vector<RoadStart> starts;
    std::vector<int> goals;
    for (int i = 0; i < 12; ++i) starts.push_back(random_start(random, world));
    for (int i = 0; i < 9; ++i) {
        goals.push_back(static_cast<int>(random() % world.graph.nodes.size()));
    }
    std::vector<RoadCost> matrix;

    router.costs(user, starts, goals, matrix);

    for (std::size_t s = 0; s < starts.size(); ++s) {
        for (std::size_t g = 0; g < goals.size(); ++g) {
            EXPECT_EQ(matrix[s * goals.size() + g], router.cost(user, starts[s], goals[g]));
        }
    }
}

TEST(RoadRouter, AllocatesNothingOnceWarm) {
    Random random(6);
    const World world = random_world(random, 60);
    RoadRouter router(world.graph, world.rules, world.preferences);
    const int user = router.add_user(world.user);
    RoadRoute route;
    const auto ask_all = [&] {
        for (int from = 0; from < int(world.graph.nodes.size()); ++from) {
            for (int to = 0; to < 10; ++to) router.find(user, {from, {}}, to, route);
        }
    };
    ask_all();

    const std::int64_t before = allocations();
    ask_all();

    EXPECT_EQ(allocations(), before);
}

TEST(RoadRouter, KeepsNothingOfATableThatWasCancelled) {
    Random random(7);
    const World world = random_world(random, 60);
    RoadRouter router(world.graph, world.rules, world.preferences);
    RoadRouter other(world.graph, world.rules, world.preferences);
    const int user = router.add_user(world.user);
    other.add_user(world.user);
    std::atomic<bool> cancel{true};

    EXPECT_FALSE(router.prepare(user, 0, &cancel));
    cancel = false;
    EXPECT_TRUE(router.prepare(user, 0, &cancel));
    // A change is followed by a repair, which can be cancelled like a build.
    for (auto* each : {&router, &other}) each->set_closed(0, !world.rules[0].closed);
    cancel = true;
    static_cast<void>(router.prepare(user, 0, &cancel));

    for (int from = 0; from < int(world.graph.nodes.size()); ++from) {
        EXPECT_EQ(router.cost(user, {from, {}}, 0), other.cost(user, {from, {}}, 0)) << from;
    }
}

TEST(RoadRouter, ManyThreadsReadOneTable) {
    Random random(8);
    const World world = random_world(random, 200);
    RoadRouter router(world.graph, world.rules, world.preferences);
    const int user = router.add_user(world.user);
    std::vector<const CostTable*> tables;
    for (int goal = 0; goal < int(world.graph.nodes.size()) && goal < 20; ++goal) {
        tables.push_back(&router.table(user, goal));
    }
    std::vector<std::vector<std::uint64_t>> read(4);
    std::vector<std::thread> threads;
    for (auto& own : read) {
        threads.emplace_back([&] {
            for (const CostTable* table : tables) {
                for (int arc = 0; arc < int(world.graph.arcs.size()); ++arc) {
                    std::uint64_t lanes = 0;
                    for (int at = table->next(arc); at >= 0; at = table->next(at)) ++lanes;
                    own.push_back(table->left(arc) * std::uint64_t{1000} + lanes);
                }
            }
        });
    }
    for (auto& thread : threads) thread.join();
    ASSERT_FALSE(read.front().empty());
    for (const auto& own : read) EXPECT_EQ(own, read.front());
}

/// A ladder: a short way with many corners below, a long one with two above, both from 0 to 5.
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
constexpr int kStairs = 5;  // arcs of the short way; the long one has the last three

RoadPreferences plain(double k_same, double k_diff) {
    RoadPreferences preferences;
    preferences.cost.k_same = k_same;
    preferences.cost.k_diff = k_diff;
    return preferences;
}

TEST(RoadExplain, SaysWhatEachLegCostsAndWhyNotTheOther) {
    RoadPreferences preferences = plain(10, 12);
    preferences.reference_speed_mps = 1;
    preferences.cost.accuracy_k = 100;
    RoadRouter router(stairs(), {}, preferences);
    LaneRules slow;
    slow.max_speed_mps = 0.5;
    slow.sigma_m = 0.01;
    router.set_rules(1, slow);
    const int user = router.add_user({});

    const auto routes = alternatives(router, user, {0, {}}, 5, {.count = 2, .most_cost = 3});

    ASSERT_EQ(routes.size(), 2u);
    const auto best = leg_costs(router, user, {0, {}}, routes[0].arcs);
    ASSERT_EQ(best.size(), 5u);
    EXPECT_EQ(best[1].length, 10'000);
    EXPECT_EQ(best[1].turns, 2'000);
    EXPECT_EQ(best[1].speed, 10'000);
    EXPECT_EQ(best[1].accuracy, 1'000);
    std::int64_t sum = 0;
    for (const auto& leg : best) sum += leg.total();
    EXPECT_EQ(sum, routes[0].cost);
    const auto other = leg_costs(router, user, {0, {}}, routes[1].arcs);
    const RouteDifference more = difference(best, other);
    EXPECT_EQ(more.total(), std::int64_t{routes[1].cost} - routes[0].cost);
    EXPECT_EQ(more.length, 80'000);
    EXPECT_EQ(more.turns, -4'000);
    EXPECT_EQ(more.main_reason(), RouteDifference::Reason::kLength);
}

TEST(RoadExplain, NamesWhatBarsTheShorterWay) {
    RoadRouter router(stairs(), {}, plain(10, 10));
    const int user = router.add_user({});
    router.set_closed(2, true);

    RoadRoute route;
    ASSERT_TRUE(router.find(user, {0, {}}, 5, route));
    const auto barred = barred_shortcut(router, user, {0, {}}, 5, route.cost);

    ASSERT_TRUE(barred);
    EXPECT_EQ(barred->route.cost, 50'000u);
    ASSERT_EQ(barred->bars.size(), 1u);
    EXPECT_EQ(barred->bars[0].arc, 2);
    EXPECT_EQ(barred->bars[0].bar, Bar::kClosed);
}

TEST(RoadExplain, FindsASmallestBlockingSet) {
    RoadRouter router(stairs(), {}, plain(10, 10));
    const int user = router.add_user({.vehicle_class = 2});
    router.set_closed(1, true);
    router.set_closed(3, true);
    LaneRules for_others;
    for_others.classes = 1;
    router.set_rules(kStairs + 1, for_others);

    RoadRoute route;
    EXPECT_FALSE(router.find(user, {0, {}}, 5, route));
    const auto set = blocking_set(router, user, {0, {}}, 5);

    ASSERT_TRUE(set);
    ASSERT_EQ(set->size(), 1u);
    EXPECT_EQ(set->front().arc, kStairs + 1);
    EXPECT_EQ(set->front().bar, Bar::kClass);
    EXPECT_FALSE(blocking_set(router, user, {5, {}}, 0));  // no lanes lead back
}

TEST(RoadExplain, OpeningTheBlockingSetIsEnoughAndNoLessIs) {
    Random random(77);
    int sets = 0;
    for (int i = 0; i < 300; ++i) {
        World world = random_world(random, 8);
        for (auto& rules : world.rules) rules.closed = random() % 2 == 0;
        RoadRouter router(world.graph, world.rules, world.preferences);
        const int user = router.add_user(world.user);
        const RoadStart start = random_start(random, world);
        const int goal = static_cast<int>(random() % world.graph.nodes.size());
        const auto set = blocking_set(router, user, start, goal);
        if (!set || set->empty()) continue;
        for (const BarredArc& barred : *set) router.set_rules(barred.arc, {});
        RoadRoute route;
        ASSERT_TRUE(router.find(user, start, goal, route)) << i;
        for (const BarredArc& barred : *set) {  // none of them can be left out
            router.set_closed(barred.arc, true);
            EXPECT_FALSE(router.find(user, start, goal, route)) << i;
            router.set_closed(barred.arc, false);
        }
        ++sets;
    }
    EXPECT_GT(sets, 50);
}

TEST(RoadAlternatives, AreValidDifferentAndInOrder) {
    Random random(8);
    int several = 0;
    for (int i = 0; i < 200; ++i) {
        const World world = random_world(random, 40);
        RoadRouter router(world.graph, world.rules, world.preferences);
        const int user = router.add_user(world.user);
        const RoadStart start = random_start(random, world);
        const int goal = static_cast<int>(random() % world.graph.nodes.size());
        const auto routes = alternatives(router, user, start, goal, {});
        const std::int64_t judged = world.judge(start, goal);
        ASSERT_EQ(routes.empty(), judged == kUnreached);
        for (std::size_t a = 0; a < routes.size(); ++a) {
            EXPECT_EQ(world.fault(start, goal, routes[a]), "") << i;
            EXPECT_LE(routes[0].cost, routes[a].cost);
            for (std::size_t b = 0; b < a; ++b) {
                double shared = 0;
                for (const int arc : routes[a].arcs) {
                    const auto& other = routes[b].arcs;
                    if (std::find(other.begin(), other.end(), arc) == other.end()) continue;
                    shared += world.graph.arcs[static_cast<std::size_t>(arc)].length_m;
                }
                EXPECT_LE(shared, 0.6 * routes[a].length_m + 1e-9) << i;
            }
        }
        if (!routes.empty()) {
            EXPECT_EQ(routes[0].cost, judged);
        }
        several += routes.size() > 1 ? 1 : 0;
    }
    EXPECT_GT(several, 20);
}

}  // namespace
}  // namespace pulseline::planning
