#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/traffic/traffic_floor.hpp"

namespace pulseline::traffic {
namespace {

/// Two minutes of improvement, everybody driving as far as granted.
void go_on(Hall& hall) {
    for (int i = 0; i < 6; ++i) {
        hall.now_s += 20;
        hall.traffic.improve(at(hall.now_s), 4);
        hall.watch();
        hall.drive_all();
    }
}

TEST(Improvement, AVehicleBehindALateOneGoesFirstOrRound) {
    Hall hall({" r  ",  //
               "r..r",  //
               " .. ",  //
               " r  "});
    const auto a = hall.add("A", 0, 1);
    const auto b = hall.add("B", 1, 0);
    ASSERT_TRUE(hall.send(a, {{3, 1}}, 0));
    ASSERT_TRUE(hall.send(b, {{1, 3}}, 0));
    hall.now_s = 600;  // A was expected to have passed long ago; it has not even started
    hall.traffic.extend(a, 1, at(0));
    hall.watch();
    ASSERT_TRUE(hall.traffic.passed(a, 0, at(0)));
    const auto improvement = hall.traffic.improve(at(hall.now_s), 4);
    hall.watch();
    EXPECT_TRUE(improvement.blocked.empty());
    EXPECT_TRUE(hall.drive_all());
    EXPECT_EQ(hall.traffic.visits_done(b), 1);
}

TEST(Improvement, NeverMovesTheOldestFinishBack) {
    Hall hall({"r r r r",  //
               ".......",  //
               " r r r "});
    std::vector<VehicleIndex> all;
    for (const int c : {0, 2, 4, 6}) all.push_back(hall.add("T" + std::to_string(c), c, 0));
    for (const int c : {1, 3, 5}) all.push_back(hall.add("B" + std::to_string(c), c, 2));
    for (std::size_t i = 0; i < all.size(); ++i) {
        hall.now_s += 1;
        ASSERT_TRUE(hall.send(all[i], {{static_cast<int>(6 - i), 1}}, 20));
    }
    hall.traffic.improve(at(hall.now_s), 0);  // brings the times up to date
    const double oldest_s = hall.traffic.finish_s(all[0]);
    for (int i = 0; i < 10; ++i) {
        hall.traffic.improve(at(hall.now_s), 10);
        hall.watch();
        EXPECT_LE(hall.traffic.finish_s(all[0]), oldest_s + 1e-6);
    }
    EXPECT_TRUE(hall.drive_all());
}

TEST(Improvement, TellsWhoIsBlockedAndBringsThemOutOfTheWay) {
    // A broke down on the only road while B is on it.
    Hall hall({"r....r", "r  r  "});
    const auto a = hall.add("A", 0, 0);
    const auto b = hall.add("B", 0, 1);
    ASSERT_TRUE(hall.send(a, {{5, 0}}, 5));
    ASSERT_TRUE(hall.send(b, {{4, 0}}, 5));
    hall.traffic.extend(a, 4, at(0));
    ASSERT_TRUE(hall.traffic.passed(a, 4, at(20)));  // on (4, 0)
    hall.traffic.extend(b, 2, at(20));
    ASSERT_TRUE(hall.traffic.passed(b, 2, at(40)));  // on (1, 0)
    hall.traffic.halt(a, at(41));
    hall.watch();

    const auto improvement = hall.traffic.improve(at(50), 5);
    hall.watch();

    EXPECT_EQ(improvement.changed, std::vector<VehicleIndex>{b});
    EXPECT_TRUE(hall.traffic.postponed(b));
    EXPECT_EQ(hall.traffic.take_replanned(), (std::vector<VehicleIndex>{a, b}));
    EXPECT_TRUE(hall.traffic.take_replanned().empty());
    hall.now_s = 60;
    hall.drive_all();
    const auto rest = hall.place_of(b);
    EXPECT_TRUE(rest == hall.floor.place(0, 0) || rest == hall.floor.place(0, 1) ||
                rest == hall.floor.place(3, 1));
    const auto block = hall.traffic.blocked_by(b);
    ASSERT_TRUE(block);
    EXPECT_EQ(block->vehicle, a);

    hall.now_s += 1000;
    hall.traffic.resume(a, at(hall.now_s));
    hall.traffic.improve(at(hall.now_s), 5);
    hall.watch();
    EXPECT_TRUE(hall.drive_all());
    EXPECT_EQ(hall.traffic.visits_done(b), 1) << "the visit was only postponed";
}

TEST(Improvement, AnIdleVehicleInALaneIsSentHomeForAPostponedVisit) {
    Hall hall({"r.....r", "r  r   "});
    const auto a = hall.add("A", 0, 0);
    const auto b = hall.add("B", 0, 1);
    const auto c = hall.add("C", 6, 0);
    ASSERT_TRUE(hall.send(a, {{5, 0}}, 5));
    hall.traffic.extend(a, 1, at(0));
    ASSERT_TRUE(hall.traffic.passed(a, 1, at(5)));
    hall.traffic.halt(c, at(5));
    // B is left at (3, 0), right where A has to pass, and has no plan.
    ASSERT_TRUE(hall.traffic.found_at(b, {Floor::tile(3, 0)}, hall.floor.place(3, 0), at(6)));
    hall.watch();
    go_on(hall);
    EXPECT_EQ(hall.traffic.visits_done(a), 1);
}

TEST(Improvement, TwoThatGaveWayToEachOthersGoalsGetPastEachOther) {
    Hall hall({"r.....r", "  r r  "});
    const auto a = hall.add("A", 1, 0);
    const auto b = hall.add("B", 5, 0);
    const auto idle = hall.add("C", 2, 1);
    ASSERT_TRUE(hall.send(a, {{6, 0}}));
    ASSERT_TRUE(hall.send(b, {{0, 0}}));
    // Both wait for C for ever, and it cannot leave before both give up what they planned.
    ASSERT_TRUE(hall.traffic.found_at(idle, {Floor::tile(3, 0)}, hall.floor.place(3, 0), at(0)));
    hall.watch();
    hall.now_s = 20;
    hall.traffic.improve(at(hall.now_s), 4);
    hall.watch();
    hall.drive_all();
    ASSERT_EQ(hall.place_of(a), hall.floor.place(0, 0)) << "B's goal";
    ASSERT_EQ(hall.place_of(b), hall.floor.place(6, 0)) << "A's goal";

    go_on(hall);
    EXPECT_EQ(hall.traffic.visits_done(a), 1);
    EXPECT_EQ(hall.traffic.visits_done(b), 1);
}

TEST(Improvement, AVehicleThatGaveUpItsWayToRestGoesOnToIt) {
    Hall hall({"r......r",  //
               "    r r "});
    const auto behind = hall.add("D", 0, 0);
    const auto idle = hall.add("A", 1, 0);
    const auto rests = hall.add("B", 2, 0);
    const auto halted = hall.add("H", 5, 0);
    Task to_rest;
    to_rest.resting = {hall.floor.place(6, 1)};
    ASSERT_TRUE(hall.traffic.admit(halted, to_rest, at(0)));
    to_rest.resting = {hall.floor.place(7, 0)};
    ASSERT_TRUE(hall.traffic.admit(rests, to_rest, at(0)));
    hall.traffic.extend(rests, 1, at(0));
    ASSERT_TRUE(hall.traffic.passed(rests, 1, at(5)));
    // Everybody waits for H, and A stands without a plan where D was to follow it.
    to_rest.resting = {hall.floor.place(4, 1)};
    ASSERT_TRUE(hall.traffic.admit(idle, to_rest, at(5)));
    Task follows;
    follows.visits = {{hall.floor.place(3, 0), 10}};
    follows.resting = {hall.floor.place(0, 0)};
    ASSERT_TRUE(hall.traffic.admit(behind, follows, at(5)));
    hall.traffic.halt(halted, at(6));
    ASSERT_TRUE(hall.traffic.found_at(idle, {Floor::tile(1, 0)}, hall.floor.place(1, 0), at(6)));
    hall.watch();
    hall.traffic.improve(at(20), 8);
    hall.watch();
    ASSERT_EQ(hall.traffic.plan(rests).last(), hall.traffic.plan(rests).released) << "untangled";
    EXPECT_TRUE(hall.traffic.postponed(rests));

    hall.now_s = 1000;
    hall.traffic.resume(halted, at(hall.now_s));
    go_on(hall);
    EXPECT_EQ(hall.place_of(rests), hall.floor.place(7, 0));
    EXPECT_FALSE(hall.traffic.postponed(rests));
}

}  // namespace
}  // namespace pulseline::traffic
