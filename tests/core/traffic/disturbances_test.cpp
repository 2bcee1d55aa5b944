#include <gtest/gtest.h>

#include "tests/core/traffic/traffic_floor.hpp"

namespace pulseline::traffic {
namespace {

TEST(Disturbances, AHaltedVehicleGetsNoGrantsAndKeepsItsFloor) {
    Hall hall({"r....r"});
    const auto v = hall.add("A", 0, 0);
    ASSERT_TRUE(hall.send(v, {{4, 0}}));
    hall.traffic.extend(v, 2, at(0));
    hall.traffic.halt(v, at(1));
    EXPECT_EQ(hall.traffic.extend(v, 5, at(2)), 2u);
    EXPECT_EQ(hall.traffic.held_tiles(v), (TileSet{0, 1, 2}));
    const auto waits = hall.traffic.waits();
    ASSERT_EQ(waits.size(), 1u);
    EXPECT_EQ(waits[0].block.cause, Obstacle::Cause::kHalted);
    hall.traffic.resume(v, at(100));
    hall.watch();
    EXPECT_TRUE(hall.drive_all());
}

TEST(Disturbances, ClosedFloorIsNotGrantedUntilEveryClosureIsGone) {
    Hall hall({"r....r"});
    const auto v = hall.add("A", 0, 0);
    ASSERT_TRUE(hall.send(v, {{4, 0}}));
    const auto one = hall.traffic.close({2, 3}, at(0));
    const auto two = hall.traffic.close({3}, at(0));
    hall.watch();
    EXPECT_EQ(hall.traffic.extend(v, 9, at(1)), 1u);
    EXPECT_FALSE(hall.drive_all());
    hall.traffic.reopen(one, at(2));
    hall.traffic.reopen(one, at(2));  // again changes nothing
    EXPECT_FALSE(hall.drive_all());
    EXPECT_EQ(hall.place_of(v), hall.floor.place(2, 0));
    hall.traffic.reopen(two, at(3));
    EXPECT_TRUE(hall.drive_all());
}

TEST(Disturbances, ClosuresThatComeAndGoTakeNoMoreRoom) {
    Hall hall({"r....r"});
    const auto v = hall.add("A", 0, 0);
    ASSERT_TRUE(hall.send(v, {{4, 0}}));
    const auto lasting = hall.traffic.close({3}, at(0));
    for (int i = 0; i < 1000; ++i) {
        const auto closed = hall.traffic.close({2, 3}, at(0));
        EXPECT_NE(closed, lasting);
        hall.traffic.reopen(closed, at(0));
    }

    EXPECT_EQ(hall.traffic.record().closures.size(), 2u);
    hall.watch();
    EXPECT_FALSE(hall.drive_all()) << "the lasting one is still closed";
    hall.traffic.reopen(lasting, at(1));
    EXPECT_TRUE(hall.drive_all());
}

TEST(Disturbances, AVehicleFoundElsewhereHoldsThatFloorOnly) {
    Hall hall({"r.....r", "r      "});
    const auto a = hall.add("A", 0, 0);
    const auto b = hall.add("B", 0, 1);
    ASSERT_TRUE(hall.send(a, {{5, 0}}));
    ASSERT_TRUE(hall.send(b, {{2, 0}}));
    hall.traffic.extend(a, 2, at(0));

    ASSERT_TRUE(hall.traffic.found_at(a, {Floor::tile(1, 0), Floor::tile(2, 0)}, kNoPlace, at(9)));
    hall.watch();

    EXPECT_EQ(hall.traffic.held_tiles(a), (TileSet{1, 2}));
    EXPECT_FALSE(hall.drive_all()) << "B waits: A has no plan to leave";
    Task task;
    task.visits = {{hall.floor.place(5, 0), 1}};
    task.sequences = {{{{{1, 2}, {2}, 4, kNoVisit}}, hall.floor.place(2, 0)}};
    ASSERT_TRUE(hall.traffic.admit(a, task, at(20)));
    hall.watch();
    hall.now_s = 20;
    hall.traffic.improve(at(20), 5);
    hall.watch();
    EXPECT_TRUE(hall.drive_all());
    EXPECT_EQ(hall.traffic.visits_done(a), 1);
    EXPECT_EQ(hall.traffic.visits_done(b), 1);
}

TEST(Disturbances, ASequenceMayEndAtThePlaceItStartsAt) {
    Hall hall({"r..r"});
    const auto a = hall.add("A", 0, 0);
    const TileId here = Floor::tile(0, 0);
    Task task;
    task.visits = {{hall.floor.place(0, 0), 1}};
    task.sequences = {{{{{here}, {here}, 4, kNoVisit}}, hall.floor.place(0, 0)}};  // a turn

    ASSERT_TRUE(hall.traffic.admit(a, task, at(0)));
    hall.watch();
    EXPECT_TRUE(hall.drive_all());
    EXPECT_EQ(hall.traffic.visits_done(a), 1);
}

TEST(Disturbances, AVehicleThatStoodWiderThanItsPlaceLeavesAllOfItBehind) {
    Hall hall({"r...r", "r    "});
    const auto a = hall.add("A", 0, 0);
    const auto b = hall.add("B", 0, 1);
    const auto place = hall.floor.place(1, 0);
    ASSERT_TRUE(hall.traffic.found_at(a, {Floor::tile(1, 0), Floor::tile(0, 0)}, place, at(1)));
    ASSERT_TRUE(hall.send(a, {{1, 0}, {3, 0}}));
    ASSERT_TRUE(hall.send(b, {{0, 0}}));
    hall.watch();

    ASSERT_EQ(hall.traffic.extend(a, 1, at(2)), hall.traffic.plan(a).passed + 1);
    ASSERT_TRUE(hall.traffic.passed(a, hall.traffic.plan(a).released, at(8)));
    EXPECT_EQ(hall.traffic.holder(Floor::tile(0, 0)), a) << "it has only made a stop";
    ASSERT_EQ(hall.traffic.extend(a, 1, at(8)), hall.traffic.plan(a).passed + 1);
    EXPECT_EQ(hall.traffic.holder(Floor::tile(0, 0)), a);
    ASSERT_TRUE(hall.traffic.passed(a, hall.traffic.plan(a).released, at(9)));
    hall.watch();

    EXPECT_FALSE(hall.traffic.holder(Floor::tile(0, 0)));
    EXPECT_TRUE(hall.drive_all());
    EXPECT_EQ(hall.traffic.visits_done(b), 1);
}

TEST(Disturbances, AVehicleFoundOnFloorOfAnotherIsHaltedAndNothingElseChanges) {
    Hall hall({"r..r"});
    const auto a = hall.add("A", 0, 0);
    const auto b = hall.add("B", 3, 0);
    const auto status = hall.traffic.found_at(b, {Floor::tile(0, 0)}, kNoPlace, at(0));
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().reason.code, "floor_held");
    EXPECT_TRUE(hall.traffic.plan(b).halted);
    EXPECT_EQ(hall.traffic.holder(Floor::tile(0, 0)), a);
    EXPECT_EQ(hall.traffic.holder(Floor::tile(3, 0)), b);
}

TEST(Disturbances, FloorOfAVehicleCarriedAwayIsFree) {
    Hall hall({"r..r"});
    const auto a = hall.add("A", 0, 0);
    const auto b = hall.add("B", 3, 0);
    ASSERT_TRUE(hall.send(a, {{2, 0}}));
    hall.traffic.remove_vehicle(b, at(1));
    hall.watch();
    EXPECT_FALSE(hall.traffic.holder(Floor::tile(3, 0)));
    EXPECT_TRUE(hall.drive_all());
}

}  // namespace
}  // namespace pulseline::traffic
