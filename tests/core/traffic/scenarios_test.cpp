#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/core/traffic/traffic_floor.hpp"

// The four meetings that stop other fleets.
namespace pulseline::traffic {
namespace {

TEST(Scenario, HeadOnInACorridor) {
    Hall hall({"r        r",  //
               "..........",  //
               "r        r"});
    const auto a = hall.add("A", 0, 0);
    const auto b = hall.add("B", 9, 0);
    ASSERT_TRUE(hall.send(a, {{9, 1}}));
    ASSERT_TRUE(hall.send(b, {{0, 1}}));

    hall.traffic.extend(a, 1, at(1));
    EXPECT_EQ(hall.traffic.extend(b, 9, at(1)), hall.traffic.plan(b).released);
    std::set<VehicleIndex> waiting;
    for (const auto& wait : hall.traffic.waits()) waiting.insert(wait.vehicle);
    EXPECT_FALSE(waiting.count(a) != 0 && waiting.count(b) != 0) << "never both";

    EXPECT_TRUE(hall.drive_all({b, a}));
    EXPECT_EQ(hall.traffic.visits_done(a), 1);
    EXPECT_EQ(hall.traffic.visits_done(b), 1);
}

TEST(Scenario, RingOfFourAtACrossing) {
    // Each wants to the resting place at its left, round the square in the middle.
    Hall hall({" r  ",  //
               " ..r",  //
               "r.. ",  //
               "  r "});
    const auto n = hall.add("N", 1, 0);
    const auto e = hall.add("E", 3, 1);
    const auto s = hall.add("S", 2, 3);
    const auto w = hall.add("W", 0, 2);
    ASSERT_TRUE(hall.send(n, {{2, 2}, {1, 1}}, 1));
    ASSERT_TRUE(hall.send(e, {{1, 2}, {2, 1}}, 1));
    ASSERT_TRUE(hall.send(s, {{1, 1}, {2, 2}}, 1));
    ASSERT_TRUE(hall.send(w, {{2, 1}, {1, 2}}, 1));

    // In every order in which the vehicles may be served.
    const auto record = hall.traffic.record();
    std::vector<VehicleIndex> order{n, e, s, w};
    do {
        Hall again({" r  ", " ..r", "r.. ", "  r "});
        again.traffic = Traffic::rebuild(record, {hall.floor.graph}, true).value();
        EXPECT_TRUE(again.monitor.apply(again.traffic.all_as_changes()).empty());
        EXPECT_TRUE(again.drive_all(order));
        for (const VehicleIndex v : order) EXPECT_EQ(again.traffic.visits_done(v), 2);
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Scenario, APlatformBacksOutForAnother) {
    // A dead-end road; platforms are three tiles long. P1 stands at the station at its end and
    // rests there, since nobody needed it. P2 is sent to the same station: P1 must back out into
    // the bay beside the entry, P2 must let it pass.
    Traffic traffic(true);
    Monitor monitor;
    const auto watch = [&] {
        for (const auto& violation : monitor.apply(traffic.take_changes())) {
            ADD_FAILURE() << to_string(violation);
        }
        for (const auto& violation : monitor.check_all()) ADD_FAILURE() << to_string(violation);
    };
    // Places along the road at columns 0, 3, 6, 9; bays above column 0 and below it.
    MoveGraph graph;
    const auto body = [](int column, int row) {
        return TileSet{Floor::tile(column, row), Floor::tile(column + 1, row),
                       Floor::tile(column + 2, row)};
    };
    for (const int column : {0, 3, 6, 9}) graph.places.push_back({body(column, 1), false});
    graph.places.push_back({body(0, 0), true});
    graph.places.push_back({body(0, 2), true});
    const auto link = [&](PlaceIndex a, PlaceIndex b) {
        const TileSet swept = merge(graph.places[a].stand, graph.places[b].stand);
        graph.moves.push_back({a, b, swept, 30});
        graph.moves.push_back({b, a, swept, 30});
    };
    for (PlaceIndex p = 0; p < 3; ++p) link(p, p + 1);
    link(0, 4);
    link(0, 5);
    traffic.add_graph(graph);
    const PlaceIndex station = 3;
    const auto p1 = traffic.add_vehicle({"P1", 0, station, {}}, at(0)).value();
    const auto p2 = traffic.add_vehicle({"P2", 0, 4, {}}, at(0)).value();
    watch();

    Task task;
    task.visits = {{station, 60}};
    const auto admission = traffic.admit(p2, task, at(0));
    watch();

    ASSERT_TRUE(admission);
    EXPECT_EQ(admission->made_way, std::vector<VehicleIndex>{p1});
    const auto first_waits = traffic.waits();
    ASSERT_FALSE(first_waits.empty());
    EXPECT_EQ(first_waits[0].vehicle, p2);
    EXPECT_EQ(first_waits[0].block.vehicle, p1);
    double now_s = 0;
    for (int round = 0; round < 40; ++round) {
        for (const VehicleIndex v : {p2, p1}) {
            const auto granted = traffic.extend(v, 1, at(now_s += 1));
            watch();
            ASSERT_TRUE(traffic.passed(v, granted, at(now_s += 29)));
            watch();
        }
    }
    EXPECT_EQ(traffic.visits_done(p2), 1);
    EXPECT_EQ(traffic.plan(p1).place, PlaceIndex{5});
    EXPECT_EQ(traffic.plan(p2).place, PlaceIndex{4});
}

TEST(Scenario, ABreakdownOnTheOnlyRoad) {
    Hall hall({"r.....r", " r   r "});
    const auto a = hall.add("A", 0, 0);
    const auto b = hall.add("B", 5, 1);
    ASSERT_TRUE(hall.send(a, {{4, 0}}));
    hall.traffic.extend(a, 2, at(0));
    ASSERT_TRUE(hall.traffic.passed(a, 2, at(20)));
    hall.traffic.halt(a, at(21));  // on (2, 0)
    hall.watch();

    const auto refused = hall.send(b, {{1, 0}});
    ASSERT_FALSE(refused);
    const auto block = hall.traffic.blocked_by(b);
    ASSERT_TRUE(block);
    EXPECT_EQ(block->cause, Obstacle::Cause::kVehicle);
    EXPECT_EQ(block->vehicle, a);
    EXPECT_EQ(block->tile, Floor::tile(2, 0));
    ASSERT_TRUE(hall.send(b, {{4, 0}})) << "this side of the breakdown is open";
    EXPECT_FALSE(hall.drive_all()) << "A does not move";
    EXPECT_EQ(hall.traffic.visits_done(b), 1);

    hall.traffic.resume(a, at(5000));
    hall.now_s = 5000;
    ASSERT_TRUE(hall.send(b, {{1, 0}}));
    EXPECT_TRUE(hall.drive_all());
    EXPECT_EQ(hall.traffic.visits_done(a), 1);
    EXPECT_EQ(hall.traffic.visits_done(b), 1);
}

}  // namespace
}  // namespace pulseline::traffic
