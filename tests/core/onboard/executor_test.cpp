#include "core/onboard/executor.hpp"

#include <gtest/gtest.h>

#include "tests/core/onboard/executor_rig.hpp"

namespace pulseline::onboard::testing {
namespace {

TEST_F(ExecutorTest, StopsAtTheEndOfTheBaseAndAsksForMore) {
    executor.handle(order("a", 4, 2));
    run(60);
    const auto now = state();
    EXPECT_NEAR(furthest_x, 2, 1e-5);
    EXPECT_EQ(now.last_node_id, "n1");
    EXPECT_EQ(now.last_node_sequence_id, 2);
    EXPECT_EQ(now.node_states.size(), 2u);
    EXPECT_FALSE(now.driving);
    EXPECT_TRUE(now.new_base_request);
}

TEST_F(ExecutorTest, HeldWhereItStandsItBeginsNoWayAndOnItsWayItDrivesOn) {
    executor.hold(true);
    run(1);
    EXPECT_FALSE(executor.waits_to_begin()) << "nobody has sent it anywhere";
    executor.handle(order("a", 4, 2));
    run(5);
    EXPECT_TRUE(motion.idle());
    EXPECT_EQ(furthest_x, 0);
    EXPECT_TRUE(executor.waits_to_begin());

    executor.hold(false);
    EXPECT_FALSE(executor.waits_to_begin());
    run(1);
    EXPECT_FALSE(motion.standing());
    executor.hold(true);
    EXPECT_FALSE(executor.waits_to_begin());
    run(60);
    EXPECT_NEAR(furthest_x, 2, 1e-5);
}

TEST_F(ExecutorTest, DrivesOnWithoutStoppingWhenTheBaseGrowsInTime) {
    executor.handle(order("a", 4, 2));
    while (motion.believed_pose().x_m < 1) run(kStep_s);
    executor.handle(update("a", 1, 1, 4, 4));
    bool stood = false;
    for (int i = 0; i < 2000 && !state().node_states.empty(); ++i) {
        run(kStep_s);
        stood |= motion.standing() && motion.believed_pose().x_m < 5.99;
    }
    EXPECT_FALSE(stood);
    EXPECT_NEAR(motion.true_pose().x_m, 6, 1e-5);
    EXPECT_EQ(state().order_update_id, 1);
    EXPECT_TRUE(state().edge_states.empty());
}

TEST_F(ExecutorTest, IgnoresADuplicateWithoutAnError) {
    const auto message = order("a", 3, 2);
    executor.handle(message);
    run(2);
    const auto before = state();
    executor.handle(message);
    EXPECT_TRUE(executor.take_changed());  // and answers it by its state
    EXPECT_EQ(state().node_states.size(), before.node_states.size());
    EXPECT_TRUE(state().errors.empty());
}

TEST_F(ExecutorTest, RefusesAnUpdateThatDoesNotBeginAtTheEndOfTheBase) {
    executor.handle(order("a", 4, 2));
    executor.handle(update("a", 1, 2, 4, 4));
    EXPECT_EQ(last_error(), "orderUpdateError");
    EXPECT_EQ(state().order_update_id, 0);
    run(60);
    EXPECT_NEAR(furthest_x, 2, 1e-5);
}

TEST_F(ExecutorTest, RefusesALowerUpdateAndReportsWhichOne) {
    executor.handle(order("a", 4, 2));
    executor.handle(update("a", 1, 1, 4, 3));
    executor.handle(order("a", 4, 2));
    ASSERT_EQ(last_error(), "orderUpdateError");
    const auto references = state().errors.back().references;
    EXPECT_EQ(references[0], (std::pair<std::string, std::string>("orderId", "a")));
    EXPECT_EQ(references[1].second, "0");
    EXPECT_EQ(state().order_update_id, 1);
}

TEST_F(ExecutorTest, AnUpdateAfterTheEndOfTheOrderContinuesIt) {
    executor.handle(order("a", 2, 2));
    run(60);
    EXPECT_TRUE(state().node_states.empty());
    executor.handle(update("a", 1, 1, 3, 3));
    run(60);
    EXPECT_NEAR(motion.true_pose().x_m, 4, 1e-5);
}

TEST_F(ExecutorTest, AnUpdateReplacesTheHorizon) {
    executor.handle(order("a", 6, 2));
    executor.handle(update("a", 1, 1, 3, 2));
    EXPECT_EQ(state().node_states.size(), 2u);
    EXPECT_TRUE(state().node_states.front().released);
    EXPECT_FALSE(state().node_states.back().released);
}

TEST_F(ExecutorTest, RefusesASecondOrderWhileOneIsActive) {
    executor.handle(order("a", 3, 2));
    executor.handle(order("b", 2, 2));
    EXPECT_EQ(last_error(), "orderError");
    EXPECT_EQ(state().order_id, "a");
}

TEST_F(ExecutorTest, RefusesAnOrderThatBeginsElsewhere) {
    executor.handle(order("a", 2, 2, 5.0));
    EXPECT_EQ(last_error(), "noRouteError");
    EXPECT_EQ(state().order_id, "");
}

TEST_F(ExecutorTest, RefusesMalformedOrdersNamingTheFault) {
    auto gap = order("a", 3, 3);
    gap.nodes[2].sequence_id = 8;
    executor.handle(gap);
    EXPECT_EQ(last_error(), "validationError");
    auto behind = order("a", 3, 1);
    behind.nodes[2].released = true;
    behind.edges[1].released = true;
    executor.handle(behind);
    EXPECT_EQ(last_error(), "validationError");
    auto map = order("a", 2, 2);
    map.nodes[1].map_id = "other";
    executor.handle(map);
    EXPECT_EQ(last_error(), "orderError");
    auto action = order("a", 2, 2);
    action.nodes[1].actions.push_back({"pick", "p", vda5050::BlockingType::kHard, {}, {}, {}});
    executor.handle(action);
    EXPECT_EQ(state().errors.back().references.back().second, "p");
    run(10);
    EXPECT_EQ(furthest_x, 0);
}

TEST_F(ExecutorTest, CancelInMidEdgeBrakesEmptiesTheOrderAndFinishesStanding) {
    executor.handle(order("a", 3, 3));
    while (motion.believed_pose().x_m < 0.6) run(kStep_s);
    const double limit = motion.believed_pose().x_m + motion.braking_m() + 0.05;
    instant("cancelOrder", "c");
    run(kStep_s);
    EXPECT_EQ(status("c"), ActionStatus::kRunning);
    EXPECT_TRUE(state().driving);
    executor.handle(order("b", 2, 2));
    EXPECT_EQ(state().order_id, "a");  // not while cancelling
    run(30);
    EXPECT_EQ(status("c"), ActionStatus::kFinished);
    const auto now = state();
    EXPECT_TRUE(now.node_states.empty() && now.edge_states.empty());
    EXPECT_FALSE(now.driving);
    EXPECT_EQ(now.order_id, "a");
    EXPECT_EQ(now.last_node_id, "n0");
    EXPECT_LT(motion.true_pose().x_m, limit);
    // The update that raced with the cancel moves nothing; a new order from here does.
    executor.handle(update("a", 1, 2, 4, 4));
    EXPECT_EQ(last_error(), "orderUpdateError");
    const double here = motion.believed_pose().x_m;
    executor.handle(order("b", 2, 2, here));
    run(60);
    EXPECT_NEAR(motion.true_pose().x_m, here + 2, 1e-4);
}

TEST_F(ExecutorTest, CancelWithoutAnOrderFails) {
    instant("cancelOrder", "c");
    EXPECT_EQ(status("c"), ActionStatus::kFailed);
    EXPECT_EQ(last_error(), "noOrderToCancel");
}

TEST_F(ExecutorTest, PauseStandsAnywhereAndStopPauseDrivesOn) {
    executor.handle(order("a", 3, 3));
    while (motion.believed_pose().x_m < 1) run(kStep_s);
    instant("startPause", "p");
    run(20);
    EXPECT_EQ(status("p"), ActionStatus::kFinished);
    EXPECT_TRUE(state().paused);
    EXPECT_FALSE(state().driving);
    const double here = motion.true_pose().x_m;
    EXPECT_LT(here, 4);
    run(20);
    EXPECT_EQ(motion.true_pose().x_m, here);
    instant("stopPause", "q");
    run(60);
    EXPECT_EQ(status("q"), ActionStatus::kFinished);
    EXPECT_NEAR(motion.true_pose().x_m, 4, 1e-5);
}

TEST_F(ExecutorTest, ARestartedVehicleKnowsNoPoseAndTakesNoUpdate) {
    executor.handle(order("a", 4, 2));
    run(3);
    VehicleMotion again(platform_type(), motion.true_pose(), 1, 1, exact());
    TrueSensing eyes(again);
    Executor restarted(again, eyes, "hall");
    restarted.handle(update("a", 1, 1, 4, 4));
    restarted.handle(order("b", 2, 2));
    StateMessage now;
    restarted.write_state(now);
    EXPECT_FALSE(now.position_initialized);
    EXPECT_FALSE(now.pose.has_value());
    EXPECT_EQ(now.order_id, "");
    EXPECT_EQ(now.errors.size(), 2u);
    const Pose2 before = again.true_pose();
    for (int i = 0; i < 200; ++i) restarted.step(kStep_s);
    EXPECT_EQ(again.true_pose(), before);
}

TEST_F(ExecutorTest, AdjustsAndMeasuresAtTheLastNode) {
    auto message = order("a", 2, 2);
    const Pose2 target{2.015, -0.01, radians(0.1)};
    message.nodes[1].actions = {stop_action("adjustToMarker", target),
                                stop_action("measureStop", target)};
    executor.handle(message);
    EXPECT_EQ(status("id-measureStop"), ActionStatus::kWaiting);
    run(60);
    const auto now = state();
    ASSERT_EQ(status("id-adjustToMarker"), ActionStatus::kFinished);
    ASSERT_EQ(status("id-measureStop"), ActionStatus::kFinished);
    EXPECT_TRUE(now.node_states.empty());
    const auto& measured = now.action_states.at(1).measurement;
    ASSERT_TRUE(measured.has_value());
    EXPECT_LT(distance(measured->pose.position(), target.position()), 0.002);
    EXPECT_EQ(*now.pose, measured->pose);
    ASSERT_TRUE(measured->arrived);
    EXPECT_LT(distance(measured->arrived->position(), {2, 0}), 0.001)
        << "where the drive had ended, though it was adjusted before it was measured";
}

TEST_F(ExecutorTest, ASecondOrderToWhereItStandsArrivesWhereItStands) {
    const Pose2 target{2.015, -0.01, radians(0.1)};
    auto message = order("a", 2, 2);
    message.nodes[1].actions = {stop_action("adjustToMarker", target),
                                stop_action("measureStop", target)};
    executor.handle(message);
    run(60);
    const Pose2 stood = *state().pose;
    auto again = order("b", 1, 1, stood.x_m);
    again.nodes[0].pose = stood;
    again.nodes[0].actions = message.nodes[1].actions;
    executor.handle(again);
    run(60);
    const auto now = state();
    ASSERT_EQ(now.order_id, "b");
    const auto& measured = now.action_states.at(1).measurement;
    ASSERT_TRUE(measured && measured->arrived);
    EXPECT_LT(distance(measured->arrived->position(), stood.position()), 1e-6);
}

TEST_F(ExecutorTest, AStopThatCannotBeSeenFailsWithTheReason) {
    auto message = order("a", 2, 2);
    message.nodes[1].actions = {stop_action("measureStop", {2, 0, 0})};
    sensing.covered = true;
    executor.handle(message);
    run(60);
    EXPECT_EQ(status("id-measureStop"), ActionStatus::kFailed);
    EXPECT_NE(state().action_states.at(0).result_description.find("no_marker_in_view"),
              std::string::npos);
}

TEST_F(ExecutorTest, ACodeOutOfSightIsLookedForWhereTheVehicleTakesTheTargetToBe) {
    auto message = order("a", 2, 2);
    const Pose2 target{2.06, 0, 0};
    message.nodes[1].actions = {stop_action("adjustToMarker", target)};
    sensing.code = target.position();
    executor.handle(message);
    run(60);
    EXPECT_EQ(status("id-adjustToMarker"), ActionStatus::kFinished);
    EXPECT_LT(distance(motion.true_pose().position(), target.position()), 0.002);
}

TEST_F(ExecutorTest, ACorrectionFarFromTheTargetIsRefused) {
    auto message = order("a", 2, 2);
    message.nodes[1].actions = {stop_action("adjustToMarker", {3, 0, 0})};
    executor.handle(message);
    run(60);
    EXPECT_EQ(status("id-adjustToMarker"), ActionStatus::kFailed);
    EXPECT_NEAR(furthest_x, 2, 1e-5);
}

TEST_F(ExecutorTest, CancelStopsARunningCorrection) {
    auto message = order("a", 2, 2);
    message.nodes[1].actions = {stop_action("adjustToMarker", {2.05, 0, 0}),
                                stop_action("measureStop", {2.05, 0, 0})};
    executor.handle(message);
    while (status("id-adjustToMarker") != ActionStatus::kRunning) run(kStep_s);
    run(0.7);
    instant("cancelOrder", "c");
    run(5);
    EXPECT_EQ(status("id-adjustToMarker"), ActionStatus::kFailed);
    EXPECT_EQ(status("id-measureStop"), ActionStatus::kFailed);
    EXPECT_EQ(status("c"), ActionStatus::kFinished);
    EXPECT_TRUE(motion.idle());
}

TEST_F(ExecutorTest, AResentInstantActionIsDoneOnce) {
    executor.handle(order("a", 3, 3));
    run(4);
    instant("cancelOrder", "c");
    run(20);
    executor.handle(order("b", 2, 2, motion.believed_pose().x_m));
    instant("cancelOrder", "c");
    run(60);
    EXPECT_EQ(state().order_id, "b");
    EXPECT_EQ(state().last_node_id, "n1");
}

TEST_F(ExecutorTest, InitPositionIsRefusedWhileAnOrderIsActive) {
    executor.handle(order("a", 3, 2));
    run(1);
    instant("initPosition", "again");
    EXPECT_EQ(status("again"), ActionStatus::kFailed);
    EXPECT_EQ(status("init"), ActionStatus::kFinished);
}

TEST_F(ExecutorTest, UnknownInstantActionsFailAndFactsheetIsAsked) {
    instant("dance", "d");
    EXPECT_EQ(status("d"), ActionStatus::kFailed);
    instant("factsheetRequest", "f");
    EXPECT_EQ(status("f"), ActionStatus::kFinished);
    EXPECT_TRUE(executor.take_factsheet_request());
    EXPECT_FALSE(executor.take_factsheet_request());
}

TEST_F(ExecutorTest, TakenByHandItBrakesGivesUpItsOrderAndTakesNone) {
    executor.handle(order("leg", 9, 9));
    run(4);
    executor.take_by_hand();
    EXPECT_EQ(state().operating_mode, "MANUAL");
    run(10);
    EXPECT_TRUE(motion.idle());
    EXPECT_TRUE(state().node_states.empty());
    const double stood_at = motion.true_pose().x_m;
    executor.handle(order("next", 3, 3, stood_at));
    EXPECT_EQ(last_error(), "orderError");
    run(5);
    EXPECT_EQ(motion.true_pose().x_m, stood_at) << "nobody asks it to move";
}

TEST_F(ExecutorTest, TakenByHandAndGivenBackItTakesNoUpdateOfTheOrderBefore) {
    executor.handle(order("leg", 4, 2));
    run(20);
    executor.take_by_hand();
    run(1);
    ASSERT_TRUE(executor.give_back());
    const double stood_at = motion.true_pose().x_m;

    executor.handle(update("leg", 1, 1, 4, 4));
    run(20);
    EXPECT_EQ(last_error(), "orderUpdateError");
    EXPECT_EQ(motion.true_pose().x_m, stood_at);
}

TEST_F(ExecutorTest, DrivenByHandAndGivenBackItWaitsForAnOrder) {
    ASSERT_FALSE(executor.drive_by_hand({0.2, 0, 0})) << "not taken yet";
    ASSERT_FALSE(executor.give_back());
    executor.take_by_hand();
    for (int i = 0; i < 100; ++i) {
        ASSERT_TRUE(executor.drive_by_hand({0.2, 0, 0}));
        run(kStep_s);
    }
    EXPECT_GT(motion.true_pose().x_m, 0.3);
    EXPECT_EQ(executor.give_back().error().reason.code, "still_moving");
    run(3);
    ASSERT_TRUE(executor.give_back());
    EXPECT_EQ(state().operating_mode, "AUTOMATIC");
    const double stood_at = motion.true_pose().x_m;
    run(5);
    EXPECT_EQ(motion.true_pose().x_m, stood_at);

    executor.handle(order("leg", 2, 2, motion.believed_pose().x_m));
    run(20);
    EXPECT_NEAR(motion.believed_pose().x_m, stood_at + 2, 0.01);
    EXPECT_TRUE(state().node_states.empty());
}

}  // namespace
}  // namespace pulseline::onboard::testing
