#include "core/fleet/legs/step_actions.hpp"

#include <gtest/gtest.h>

#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");

NewOrder with_actions() {
    NewOrder order;
    order.vehicle = kV1;
    order.steps = {{2}};
    order.steps[0].before = {{"raiseParking", {}}, {"setBracketHeight", {{"height_m", 0.4}}}};
    order.steps[0].after = {{"lowerParking", {}}};
    return order;
}

struct StepActions : ::testing::Test {
    StepActions() {
        world.connect_all();
        world.announce({"raiseParking", "lowerParking", "setBracketHeight"});
    }
    FakeVehicle& v1() { return world.vehicle("V1"); }
    World world;
};

TEST_F(StepActions, AreDoneInOrderAroundTheDrive) {
    ASSERT_TRUE(world.order(with_actions()));
    world.run(60);

    EXPECT_EQ(world.only_order().state, JobState::kEnded);
    EXPECT_EQ(v1().actions_done,
              (std::vector<std::string>{"raiseParking", "setBracketHeight", "adjustToMarker",
                                        "measureStop", "lowerParking"}));
    EXPECT_EQ(world.store.stops.size(), 1u) << "an action leg is no stop";
    EXPECT_EQ(world.count_events("step.action_done"), 3);
}

TEST_F(StepActions, TheVehicleDoesNotLeaveBeforeTheyAreFinished) {
    v1().action_fails = "setBracketHeight";
    ASSERT_TRUE(world.order(with_actions()));
    world.run(30);

    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
    EXPECT_EQ(world.only_order().reason.code, "action_failed");
    EXPECT_EQ(world.only_order().reason.params.at(0),
              (Param{"action", std::string("setBracketHeight")}));
    EXPECT_EQ(v1().node_steps, 0) << "it stands";

    v1().action_fails = "";
    ASSERT_TRUE(world.fleet->resume_order(world.only_order().id, std::nullopt, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
    EXPECT_EQ(v1().actions_done.at(0), "raiseParking");
    EXPECT_EQ(v1().actions_done.at(1), "setBracketHeight") << "the first one is not sent again";
}

TEST_F(StepActions, ThoseAfterAStepWaitForAGoodStop) {
    v1().stop_error = {0.030, 0, 0};
    ASSERT_TRUE(world.order(with_actions()));
    world.run(60);

    EXPECT_EQ(world.only_order().reason.code, "out_of_tolerance");
    EXPECT_EQ(std::count(v1().actions_done.begin(), v1().actions_done.end(), "lowerParking"), 0);
    EXPECT_EQ(std::count(v1().actions_done.begin(), v1().actions_done.end(), "raiseParking"), 1)
        << "another approach is no new start";
}

TEST_F(StepActions, AFailedOneAfterTheStopLeavesTheOrderToAPerson) {
    v1().action_fails = "lowerParking";
    ASSERT_TRUE(world.order(with_actions()));
    world.run(60);

    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
    EXPECT_EQ(world.only_order().steps.at(0).phase, StepPhase::kAfter);

    v1().action_fails = "";
    ASSERT_TRUE(world.fleet->resume_order(world.only_order().id, std::nullopt, "op", world.now));
    world.run(30);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
    EXPECT_EQ(world.store.stops.size(), 1u) << "it does not have to arrive again";
}

TEST_F(StepActions, AreNotRepeatedWhenTheServerDiesBetweenThem) {
    ASSERT_TRUE(world.order(with_actions()));
    while (v1().actions_done.empty()) world.run(0.1);
    world.run(0.2);
    world.crash_server();
    world.announce({"raiseParking", "lowerParking", "setBracketHeight"});
    world.run(2);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);

    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
    EXPECT_EQ(std::count(v1().actions_done.begin(), v1().actions_done.end(), "raiseParking"), 1);
    EXPECT_EQ(std::count(v1().actions_done.begin(), v1().actions_done.end(), "lowerParking"), 1);
}

TEST_F(StepActions, CancelledWhileTheyRunTheOrderIsAborted) {
    ASSERT_TRUE(world.order(with_actions()));
    world.run(0.3);
    ASSERT_TRUE(world.store.vehicles.at(kV1).leg_data.actions_only);
    ASSERT_TRUE(world.fleet->cancel_order(world.only_order().id, std::nullopt, "op", world.now));
    world.run(5);

    EXPECT_EQ(world.only_order().state, JobState::kAborted);
    EXPECT_FALSE(world.store.vehicles.at(kV1).has_leg);
}

TEST_F(StepActions, AreSentAsBlockingNodeActionsWithTheirParameters) {
    ASSERT_TRUE(world.order(with_actions()));
    const Leg& leg = world.store.vehicles.at(kV1).leg_data;

    ASSERT_EQ(leg.nodes.size(), 1u);
    ASSERT_EQ(leg.nodes[0].actions.size(), 2u);
    EXPECT_EQ(leg.nodes[0].actions[1].type, "setBracketHeight");
    EXPECT_EQ(leg.nodes[0].actions[1].blocking, vda5050::BlockingType::kHard);
    EXPECT_EQ(leg.nodes[0].actions[1].params, (Params{{"height_m", 0.4}}));
}

TEST_F(StepActions, OneThatNoVehicleAnnouncesIsRefusedWithItsField) {
    NewOrder order = with_actions();
    order.steps[0].after.push_back({"fly", {}});
    const auto refused = world.order(order);

    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "unknown_action");
    EXPECT_EQ(refused.error().field, "/steps/0/after/1/type");
    EXPECT_NE(refused.error().what.find("lowerParking"), std::string::npos) << "names what it can";
    EXPECT_TRUE(world.store.orders.empty());
}

TEST_F(StepActions, TheServersOwnAreRefused) {
    NewOrder order = with_actions();
    order.steps[0].before[0].type = "measureStop";
    EXPECT_EQ(world.order(order).error().reason.code, "reserved_action");
}

TEST(StepActionsOf, AVehicleThatSaidNothingAreRefused) {
    World world;
    world.connect_all();
    const auto refused = world.order(with_actions());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "no_factsheet");
    EXPECT_EQ(refused.error().field, "/steps/0/before/0/type");
}

TEST_F(StepActions, FeetThatAreDownBarADriveAndNotWhatRaisesThem) {
    v1().state.parking_feet = {{"front left", 0.12}};
    world.run(0.2);
    NewOrder drive;
    drive.vehicle = kV1;
    drive.steps = {{2}};
    const auto barred = world.order(drive);
    ASSERT_TRUE(barred);
    world.run(5);
    EXPECT_EQ(world.stored(barred->order.id).reason.code, "parking_feet_down");
    ASSERT_TRUE(world.fleet->cancel_order(barred->order.id, std::nullopt, "op", world.now));
    world.settle();

    const auto raised = world.order(with_actions());
    ASSERT_TRUE(raised);
    world.run(2);
    EXPECT_EQ(v1().actions_done, (std::vector<std::string>{"raiseParking", "setBracketHeight"}));
    world.run(5);
    EXPECT_EQ(v1().node_steps, 0) << "they are still reported as down";
    EXPECT_EQ(world.stored(raised->order.id).reason.code, "parking_feet_down");
    v1().state.parking_feet = {{"front left", 0}};
    world.run(60);
    EXPECT_EQ(world.stored(raised->order.id).state, JobState::kEnded);
}

}  // namespace
}  // namespace pulseline::fleet::testing
