#include "core/traffic/window_search.hpp"

#include <gtest/gtest.h>

#include "tests/core/traffic/traffic_floor.hpp"

namespace pulseline::traffic {
namespace {

TEST(WindowSearch, TakesTheSoonestWayOnAnEmptyFloor) {
    Hall hall({"r...r"});
    const auto v = hall.add("A", 0, 0);
    const auto admission = hall.send(v, {{2, 0}}, 10);
    ASSERT_TRUE(admission);
    // Two moves, ten seconds of stop, two moves to either end.
    EXPECT_DOUBLE_EQ(admission->finish_s, 4 * kMove_s + 10);
    EXPECT_EQ(hall.traffic.plan(v).last(), 5u);
    EXPECT_EQ(hall.traffic.plan(v).at(3).visit, 0);
}

TEST(WindowSearch, WaitsForTheGapWhenTheWayRoundIsLonger) {
    Hall hall({"r....r",  //
               "  r   "});
    const auto a = hall.add("A", 0, 0);
    const auto b = hall.add("B", 2, 1);
    ASSERT_TRUE(hall.send(a, {{5, 0}}, 0));
    const auto admission = hall.send(b, {{2, 0}}, 0);
    ASSERT_TRUE(admission);
    EXPECT_GT(admission->finish_s, 2 * kMove_s) << "A passes first";
    EXPECT_EQ(hall.traffic.plan(b).at(1).waits_for.size(), 1u);
    EXPECT_DOUBLE_EQ(hall.traffic.finish_s(a), 5 * kMove_s) << "A is not held up";
}

TEST(WindowSearch, NamesWhoNeverGoesAway) {
    Hall hall({"r.x.r"});
    const auto a = hall.add("A", 0, 0);
    hall.traffic.add_vehicle({"B", 0, hall.floor.place(2, 0), {}}, at(0)).value();
    hall.traffic.halt(1, at(0));
    const auto admission = hall.send(a, {{3, 0}});
    ASSERT_FALSE(admission);
    const auto block = hall.traffic.blocked_by(a);
    ASSERT_TRUE(block);
    EXPECT_EQ(block->cause, Obstacle::Cause::kVehicle);
    EXPECT_EQ(block->vehicle, 1u);
    EXPECT_EQ(block->tile, Floor::tile(2, 0));
    EXPECT_EQ(admission.error().reason.code, "traffic_blocked");
}

TEST(WindowSearch, ChoosesAmongFixedSequencesTheOneThatIsFree) {
    Traffic traffic;
    const auto v = traffic.add_vehicle({"A", kNoGraph, kNoPlace, {1}}, at(0)).value();
    traffic.add_vehicle({"B", kNoGraph, kNoPlace, {3}}, at(0)).value();
    Sequence direct;
    direct.steps = {{{1, 2, 3}, {3}, 5, kNoVisit}, {{3, 4}, {4}, 5, kNoVisit}};
    Sequence round;
    round.steps = {{{1, 11}, {11}, 9, kNoVisit}, {{11, 4}, {4}, 9, kNoVisit}};
    Task task;
    task.sequences = {direct, round};

    const auto admission = traffic.admit(v, task, at(0));

    ASSERT_TRUE(admission);
    EXPECT_DOUBLE_EQ(admission->finish_s, 18);
    EXPECT_EQ(traffic.tiles_of(traffic.plan(v).at(1).shape->swept), (TileSet{1, 11}));
    task.sequences = {direct};
    EXPECT_FALSE(traffic.admit(v, task, at(0))) << "B stands in it for ever";
    EXPECT_EQ(traffic.plan(v).last(), 2u) << "the incumbent stays";
}

TEST(WindowSearch, NeverEndsWhereSomebodyStillHasToPass) {
    Hall hall({"r.r.r"});
    const auto a = hall.add("A", 0, 0);
    const auto b = hall.add("B", 4, 0);
    ASSERT_TRUE(hall.send(a, {{3, 0}}));  // through the resting place in the middle
    const auto plan_ends = hall.traffic.plan(a).at(hall.traffic.plan(a).last()).place;
    ASSERT_NE(plan_ends, hall.floor.place(4, 0));
    const auto admission = hall.send(b, {{3, 0}});
    ASSERT_TRUE(admission);
    EXPECT_TRUE(hall.drive_all());
    EXPECT_NE(hall.place_of(a), hall.place_of(b));
}

}  // namespace
}  // namespace pulseline::traffic
