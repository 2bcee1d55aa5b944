#include <gtest/gtest.h>

#include "tests/core/traffic/traffic_floor.hpp"

namespace pulseline::traffic {
namespace {

TEST(Admission, RefusesAPlaceThatIsNotThere) {
    Hall hall({"r.r"});
    const auto v = hall.add("A", 0, 0);
    Task task;
    task.visits = {{77, 1}};
    const auto admission = hall.traffic.admit(v, task, at(0));
    ASSERT_FALSE(admission);
    EXPECT_EQ(admission.error().reason.code, "unknown_place");
}

TEST(Admission, NoTwoVehiclesJoinOnOneTile) {
    Hall hall({"r.r"});
    hall.add("A", 0, 0);
    const auto second = hall.traffic.add_vehicle({"B", 0, hall.floor.place(0, 0), {}}, at(0));
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().reason.code, "floor_held");
}

TEST(Admission, ARefusalLeavesThePresentPlan) {
    Hall hall({"r.r  ", "  ..r"});
    const auto v = hall.add("A", 0, 0);
    ASSERT_TRUE(hall.send(v, {{1, 0}}));
    const auto before = hall.traffic.record();
    hall.traffic.close({Floor::tile(2, 1)}, at(0));
    hall.watch();

    EXPECT_FALSE(hall.send(v, {{3, 1}}));

    EXPECT_EQ(hall.traffic.record().vehicles[v].moves, before.vehicles[v].moves);
    const auto block = hall.traffic.blocked_by(v);
    ASSERT_TRUE(block);
    EXPECT_EQ(block->cause, Obstacle::Cause::kClosed);
    EXPECT_EQ(block->tile, Floor::tile(2, 1));
}

TEST(Admission, AnIdleVehicleOutsideItsRestMakesWay) {
    Hall hall({"r.....r", "r      "});
    const auto a = hall.add("A", 0, 0);
    const auto b = hall.add("B", 0, 1);
    // B has been left in the lane.
    ASSERT_TRUE(hall.traffic.found_at(b, {Floor::tile(3, 0)}, hall.floor.place(3, 0), at(0)));
    hall.watch();

    const auto admission = hall.send(a, {{5, 0}});

    ASSERT_TRUE(admission);
    EXPECT_EQ(admission->made_way, std::vector<VehicleIndex>{b});
    EXPECT_TRUE(hall.drive_all());
}

TEST(Admission, GoesBehindThePresentPlanWhenNothingElseIsLeft) {
    // A drives down the lane into the bay; B follows and needs the lane behind it.
    Hall hall({"r...r", "r    "});
    const auto a = hall.add("A", 0, 0);
    const auto b = hall.add("B", 0, 1);
    ASSERT_TRUE(hall.send(a, {{4, 0}}));
    hall.traffic.extend(a, 1, at(0));
    hall.watch();
    ASSERT_TRUE(hall.send(b, {{1, 0}}));

    const auto admission = hall.send(a, {{2, 0}});

    ASSERT_TRUE(admission);
    EXPECT_TRUE(hall.drive_all());
    EXPECT_EQ(hall.traffic.visits_done(a), 1);
    EXPECT_EQ(hall.traffic.visits_done(b), 1);
}

TEST(Admission, AnUrgentTaskGoesBeforeWhatOthersAreNotGranted) {
    Hall hall({"r.....r", "   r   "});
    const auto a = hall.add("A", 0, 0);
    const auto b = hall.add("B", 3, 1);
    ASSERT_TRUE(hall.send(a, {{6, 0}, {0, 0}, {6, 0}}));
    const double others_s = hall.traffic.finish_s(a);
    Task task;
    task.visits = {{hall.floor.place(3, 0), 3}};
    task.may_delay_others = true;
    ASSERT_TRUE(hall.traffic.admit(b, task, at(0)));
    hall.watch();
    EXPECT_TRUE(hall.drive_all());
    EXPECT_GE(others_s, 15 * kMove_s);
}

TEST(Admission, CancelEndsAtTheRestOrWhereTheBaseEnds) {
    Hall hall({"r....r"});
    const auto v = hall.add("A", 0, 0);
    ASSERT_TRUE(hall.send(v, {{3, 0}}));
    hall.traffic.extend(v, 1, at(0));
    hall.watch();

    ASSERT_TRUE(hall.traffic.cancel(v, at(1)));
    hall.watch();
    EXPECT_EQ(hall.traffic.plan(v).at(hall.traffic.plan(v).last()).place, hall.floor.place(0, 0));

    ASSERT_TRUE(hall.traffic.cancel(v, at(2), true));
    hall.watch();
    EXPECT_EQ(hall.traffic.plan(v).last(), 1u) << "truncated to the base";
    EXPECT_TRUE(hall.drive_all());
    EXPECT_EQ(hall.traffic.visits_done(v), 0);
}

TEST(Admission, CancelOfAHaltedVehicleKeepsTheTurnsOfItsWay) {
    Floor floor({"r..r"});
    // The way through leads over a turn on the spot that sweeps no more than it stands on.
    MoveGraph& graph = floor.graph;
    const auto turned = static_cast<PlaceIndex>(graph.places.size());
    graph.places.push_back({{Floor::tile(1, 0)}, false});
    std::erase_if(graph.moves, [](const Move& move) { return move.from == 1 && move.to == 2; });
    graph.moves.push_back({1, turned, {Floor::tile(1, 0)}, kMove_s});
    graph.moves.push_back({turned, 2, {Floor::tile(1, 0), Floor::tile(2, 0)}, kMove_s});
    Traffic traffic(true);
    traffic.add_graph(graph);
    const auto v = *traffic.add_vehicle({"A", 0, 0, {}}, at(0));
    Task task;
    task.visits = {{1, 10}};
    task.resting = {3};
    ASSERT_TRUE(traffic.admit(v, task, at(0)));
    ASSERT_EQ(traffic.extend(v, 1, at(0)), 1u);
    ASSERT_TRUE(traffic.passed(v, 1, at(5)));
    traffic.halt(v, at(5));

    ASSERT_TRUE(traffic.cancel(v, at(6)));

    std::vector<PlaceIndex> way;
    const auto& plan = traffic.plan(v);
    for (MoveNumber n = plan.passed + 1; n <= plan.last(); ++n) way.push_back(plan.at(n).place);
    EXPECT_EQ(way, (std::vector<PlaceIndex>{turned, 2, 3})) << "all but the stop";
}

TEST(Admission, RerouteTakesTheOpenWayAroundAClosure) {
    Hall ring({"r...r",  //
               " . . ",  //
               " ... "});
    const auto v = ring.add("A", 0, 0);
    ASSERT_TRUE(ring.send(v, {{3, 0}}));
    ring.traffic.close({Floor::tile(2, 0)}, at(0));
    const auto rerouted = ring.traffic.reroute(v, at(0));
    ring.watch();
    ASSERT_TRUE(rerouted);
    EXPECT_TRUE(ring.drive_all());
    EXPECT_EQ(ring.traffic.visits_done(v), 1);
}

TEST(Admission, NobodyGoesBackToTheWorkThatItHasLeftForAnother) {
    Hall hall({"r....r", "  r   "});
    const auto works = hall.add("A", 0, 0);
    const auto passes = hall.add("B", 5, 0);
    ASSERT_TRUE(hall.send(works, {{3, 0}, {3, 0}}, 900));
    const MoveNumber stop = 4;  // behind three moves
    ASSERT_EQ(hall.traffic.extend(works, stop, at(0)), stop);
    ASSERT_TRUE(hall.traffic.passed(works, stop, at(60)));
    hall.traffic.set_leaves(works, Leaves::kLast);
    ASSERT_TRUE(hall.send(passes, {{1, 0}}));
    hall.watch();
    ASSERT_EQ(hall.traffic.makes_way_for(works), passes);

    ASSERT_TRUE(hall.traffic.reroute(works, at(61)));
    hall.watch();
    const auto& plan = hall.traffic.plan(works);
    for (MoveNumber n = plan.passed + 1; n <= plan.last(); ++n)
        EXPECT_EQ(plan.at(n).visit, kNoVisit) << n;
    EXPECT_TRUE(hall.drive_all());
    EXPECT_EQ(hall.traffic.visits_done(passes), 1);
}

}  // namespace
}  // namespace pulseline::traffic
