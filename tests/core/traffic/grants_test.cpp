#include <gtest/gtest.h>

#include "tests/core/traffic/traffic_floor.hpp"

namespace pulseline::traffic {
namespace {

TEST(Grants, ReachAsFarAsWantedAndNoFurther) {
    Hall hall({"r.....r"});
    const auto v = hall.add("A", 0, 0);
    ASSERT_TRUE(hall.send(v, {{5, 0}}));
    EXPECT_EQ(hall.traffic.extend(v, 2, at(0)), 2u);
    EXPECT_EQ(hall.traffic.extend(v, 2, at(0)), 2u);
    EXPECT_EQ(hall.traffic.held_tiles(v), (TileSet{0, 1, 2}));
    ASSERT_TRUE(hall.traffic.passed(v, 1, at(5)));
    EXPECT_EQ(hall.traffic.held_tiles(v), (TileSet{1, 2})) << "the tail is clear of the first";
    EXPECT_EQ(hall.traffic.extend(v, 2, at(5)), 3u);
    hall.watch();
}

TEST(Grants, AReportToldAgainChangesNothing) {
    Hall hall({"r.....r"});
    const auto v = hall.add("A", 0, 0);
    ASSERT_TRUE(hall.send(v, {{5, 0}}));
    hall.traffic.extend(v, 3, at(0));
    ASSERT_TRUE(hall.traffic.passed(v, 2, at(9)));
    const auto before = hall.traffic.record();
    EXPECT_TRUE(hall.traffic.passed(v, 2, at(10)));
    EXPECT_TRUE(hall.traffic.passed(v, 1, at(11)));
    EXPECT_EQ(hall.traffic.record(), before);
    hall.watch();
}

TEST(Grants, NobodyPassesWhatHeWasNotGranted) {
    Hall hall({"r.....r"});
    const auto v = hall.add("A", 0, 0);
    ASSERT_TRUE(hall.send(v, {{5, 0}}));
    hall.traffic.extend(v, 1, at(0));
    const auto status = hall.traffic.passed(v, 2, at(9));
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().reason.code, "not_granted");
}

TEST(Grants, AMoveIsGrantedWholeOrNotAtAll) {
    Traffic traffic;
    const auto a = traffic.add_vehicle({"A", kNoGraph, kNoPlace, {1}}, at(0)).value();
    const auto b = traffic.add_vehicle({"B", kNoGraph, kNoPlace, {9}}, at(0)).value();
    Task task_b;
    task_b.sequences = {{{{{9, 5}, {5}, 5, kNoVisit}, {{5, 10}, {10}, 5, kNoVisit}}, kNoPlace}};
    ASSERT_TRUE(traffic.admit(b, task_b, at(0)));
    traffic.extend(b, 1, at(0));  // B holds 5 now
    Task task_a;
    task_a.sequences = {{{{{1, 2, 3, 4, 5, 6}, {6}, 5, kNoVisit}}, kNoPlace}};
    ASSERT_TRUE(traffic.admit(a, task_a, at(0)));

    EXPECT_EQ(traffic.extend(a, 1, at(0)), 0u);
    for (const TileId tile : {2, 3, 4, 6}) EXPECT_FALSE(traffic.holder(tile));
    const auto waits = traffic.waits();
    ASSERT_EQ(waits.size(), 1u);
    EXPECT_EQ(waits[0].vehicle, a);
    EXPECT_EQ(waits[0].block.vehicle, b);
    EXPECT_EQ(waits[0].block.move, 2u);
    EXPECT_EQ(waits[0].block.tile, TileId{5});
    EXPECT_DOUBLE_EQ(waits[0].until_s, 10);

    traffic.extend(b, 2, at(0));
    ASSERT_TRUE(traffic.passed(b, 2, at(10)));
    EXPECT_EQ(traffic.extend(a, 1, at(10)), 1u);
    for (const TileId tile : {1, 2, 3, 4, 5, 6}) EXPECT_EQ(traffic.holder(tile), a);
}

TEST(Grants, DelaysNeverBreakTheOrder) {
    // B would be first at the crossing by the clock, but A's plan is older and goes first there.
    Hall hall({" r ", "r.r", " . ", " r "});
    const auto a = hall.add("A", 0, 1);
    const auto b = hall.add("B", 1, 0);
    ASSERT_TRUE(hall.send(a, {{2, 1}}, 0));
    ASSERT_TRUE(hall.send(b, {{1, 3}}, 0));
    hall.now_s = 10'000;  // A has not moved for hours
    EXPECT_EQ(hall.traffic.extend(b, 3, at(hall.now_s)), 0u);
    EXPECT_TRUE(hall.drive_all({b, a}));
}

}  // namespace
}  // namespace pulseline::traffic
