#include "core/onboard/going_round.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/core/onboard/going_round_rig.hpp"

namespace pulseline::onboard {
namespace {

using namespace testing;

class GoingRoundTest : public ::testing::TestWithParam<std::size_t> {
protected:
    Rig rig{families()[GetParam()]};
    double thing_m = 8 + front_m(rig.type);  // where it stands, along the way
};

TEST_P(GoingRoundTest, GoesRoundABoxAndOnToTheEndOfItsOrder) {
    rig.put_box(thing_m, 0.1);
    rig.send(10, 10);
    ASSERT_TRUE(rig.run(60, [&] { return !rig.told("going_round").empty(); }))
        << rig.told("obstacle");
    ASSERT_TRUE(rig.run_to_the_end(300)) << rig.told("obstacle");
    EXPECT_EQ(rig.state().last_node_id, "n10");
    EXPECT_LT(distance(rig.drive.believed_pose().position(), {60, 30}), 5e-3);
    EXPECT_TRUE(rig.state().errors.empty());
    EXPECT_GT(rig.farthest_beside_m, 0.7);
}

TEST_P(GoingRoundTest, WaitsWithoutACorridorAndGoesOnWhenTheWayIsFree) {
    rig.corridor.reset();
    rig.put_box(thing_m, 0);
    rig.send(10, 10);
    rig.run(60);
    EXPECT_TRUE(rig.told_why("this way has no corridor")) << rig.told("obstacle");
    EXPECT_TRUE(rig.drive.standing());
    rig.take_away();
    ASSERT_TRUE(rig.run_to_the_end(120));
    EXPECT_LT(rig.farthest_beside_m, 0.05);
}

TEST_P(GoingRoundTest, DoesNotSwerveForWhatWalksPast) {
    rig.put_box(thing_m, 0);
    rig.send(10, 10);
    ASSERT_TRUE(rig.run(60, [&] { return rig.look_out.barred(); }));
    rig.run(1.5);
    rig.take_away();
    ASSERT_TRUE(rig.run_to_the_end(120));
    EXPECT_LT(rig.farthest_beside_m, 0.05);
}

TEST_P(GoingRoundTest, StaysWhereThereIsNoRoom) {
    rig.corridor = {half_width_m(rig.type) + 0.4, half_width_m(rig.type) + 0.4};
    rig.put_box(thing_m, 0);
    rig.send(10, 10);
    rig.run(60);
    EXPECT_TRUE(rig.told_why("there is no room")) << rig.told("obstacle");
    EXPECT_FALSE(rig.state().new_base_request) << "more of the same would not help";
    EXPECT_LT(rig.farthest_beside_m, 0.05);
}

TEST_P(GoingRoundTest, AsksForALongerBaseAndGoesRoundOnceItHasIt) {
    rig.put_box(thing_m, 0);
    // The base ends where the vehicle would still stand beside the box.
    const int enough = static_cast<int>(std::ceil((thing_m + front_m(rig.type)) / kEdge_m));
    rig.send(10, enough - 1);
    ASSERT_TRUE(rig.run(60, [&] { return rig.told_why("its base is too short"); }))
        << rig.told("obstacle");
    rig.run(10);
    EXPECT_TRUE(rig.state().new_base_request);
    EXPECT_LT(rig.farthest_beside_m, 0.05);
    rig.send(10, 10, enough - 1);
    ASSERT_TRUE(rig.run_to_the_end(300)) << rig.told("obstacle");
    EXPECT_GT(rig.farthest_beside_m, 0.7);
}

TEST_P(GoingRoundTest, SaysThatTheOrderEndsTooNear) {
    rig.put_box(thing_m, 0);
    const int enough = static_cast<int>(std::ceil((thing_m + front_m(rig.type)) / kEdge_m));
    rig.send(enough - 1, enough - 1);
    rig.run(60);
    EXPECT_TRUE(rig.told_why("the corridor or the order ends too near")) << rig.told("obstacle");
    EXPECT_FALSE(rig.state().new_base_request);
}

TEST_P(GoingRoundTest, PlansAnewWhenItMeetsSomethingOnItsDetour) {
    rig.put_box(thing_m, 0.1);
    rig.send(12, 12);
    ASSERT_TRUE(rig.run(60, [&] { return rig.farthest_beside_m > 0.6; })) << rig.told("obstacle");
    const std::string first = rig.told("going_round");
    const double side = rig.drive.true_pose().y_m > kBegin.y_m ? 1 : -1;
    rig.put_box(thing_m + 1.6, side * 0.6);
    ASSERT_TRUE(rig.run(120, [&] {
        const auto now = rig.told("going_round");
        return !now.empty() && now != first;
    })) << rig.told("obstacle");
    ASSERT_TRUE(rig.run_to_the_end(300)) << rig.told("obstacle");
}

TEST_P(GoingRoundTest, ACancelledOrderIsDroppedBesideTheLine) {
    rig.put_box(thing_m, 0.1);
    rig.send(10, 10);
    ASSERT_TRUE(rig.run(60, [&] { return rig.farthest_beside_m > 0.6; }));
    rig.instant("cancelOrder");
    ASSERT_TRUE(rig.run(20, [&] { return rig.drive.idle(); }));
    rig.run(10);
    EXPECT_TRUE(rig.state().node_states.empty());
    EXPECT_TRUE(rig.told("going_round").empty());
    EXPECT_GT(std::abs(rig.drive.true_pose().y_m - kBegin.y_m), 0.4);
}

TEST_P(GoingRoundTest, PausedBesideTheLineItGoesOnWhenThePauseEnds) {
    rig.put_box(thing_m, 0.1);
    rig.send(10, 10);
    ASSERT_TRUE(rig.run(60, [&] { return rig.farthest_beside_m > 0.6; }));
    rig.instant("startPause");
    rig.run(20);
    const Pose2 stood = rig.drive.true_pose();
    rig.run(20);
    EXPECT_EQ(rig.drive.true_pose(), stood);
    rig.instant("stopPause");
    ASSERT_TRUE(rig.run_to_the_end(300)) << rig.told("obstacle");
}

TEST_P(GoingRoundTest, TakenByHandBesideTheLineItGivesUpItsOrder) {
    rig.put_box(thing_m, 0.1);
    rig.send(10, 10);
    ASSERT_TRUE(rig.run(60, [&] { return rig.farthest_beside_m > 0.6; }));
    rig.executor.take_by_hand();
    for (int i = 0; i < 200; ++i) rig.executor.step(kStep_s);
    EXPECT_TRUE(rig.executor.way_ahead().empty());
    ASSERT_TRUE(rig.executor.give_back());
    const Pose2 stood = rig.drive.true_pose();
    rig.run(10);
    EXPECT_TRUE(rig.told("going_round").empty());
    EXPECT_EQ(rig.drive.true_pose(), stood);
}

TEST_P(GoingRoundTest, AWheelThatBreaksOnADetourEndsIt) {
    rig.put_box(thing_m, 0.1);
    rig.send(10, 10);
    ASSERT_TRUE(rig.run(60, [&] { return rig.farthest_beside_m > 0.6; }));
    const auto& wheels = rig.type.wheels;
    const auto driven = std::find_if(wheels.begin(), wheels.end(),
                                     [](const plant::Wheel& wheel) { return wheel.driven; });
    ASSERT_TRUE(rig.drive.break_wheel(driven->name));
    ASSERT_TRUE(rig.run(30, [&] { return rig.drive.stop_cause() && rig.drive.standing(); }));
    const Pose2 stood = rig.drive.true_pose();
    rig.run(20);
    EXPECT_EQ(rig.drive.true_pose(), stood) << "it needs a person";
}

TEST_P(GoingRoundTest, ReachesANodeWithActionsExactlyAndDoesThemThere) {
    rig.put_box(thing_m, 0.1);
    const int stop = static_cast<int>(std::ceil((thing_m + front_m(rig.type)) / kEdge_m)) + 1;
    rig.send(10, 10, 0, stop);
    const auto measured = [&] {
        const auto actions = rig.state().action_states;
        return std::any_of(actions.begin(), actions.end(), [](const vda5050::ActionState& action) {
            return action.id == "measure" && action.status == vda5050::ActionStatus::kFailed;
        });
    };
    ASSERT_TRUE(rig.run(300, measured)) << rig.told("obstacle");
    EXPECT_EQ(rig.state().last_node_id, "n" + std::to_string(stop));
    EXPECT_LT(
        distance(rig.drive.believed_pose().position(), {kBegin.x_m + kEdge_m * stop, kBegin.y_m}),
        5e-3);
    ASSERT_TRUE(rig.run_to_the_end(300));
    EXPECT_GT(rig.farthest_beside_m, 0.7);
}

/// Deep things, things behind things: it may have to plan anew, or to wait, but the laws hold.
TEST_P(GoingRoundTest, HoldsItsLawsAmongThingsAtRandom) {
    std::mt19937_64 random(5);
    const auto uniform = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    int arrived = 0;
    for (int i = 0; i < 12; ++i) {
        Rig one(rig.type, 3.5);
        one.put_box(thing_m, uniform(-0.5, 0.5), uniform(0.3, 1.5));
        for (int k = 0; k < 2; ++k)
            one.put_box(thing_m + uniform(2, 16), uniform(-3.5, 3.5), uniform(0.2, 1));
        one.send(14, 14);
        arrived += one.run_to_the_end(200);
        if (HasFatalFailure()) FAIL() << "in world " << i;
    }
    EXPECT_GE(arrived, 8);
}

INSTANTIATE_TEST_SUITE_P(Families, GoingRoundTest, ::testing::Values(0, 1, 2));

}  // namespace
}  // namespace pulseline::onboard
