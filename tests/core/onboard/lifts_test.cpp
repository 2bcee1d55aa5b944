#include <gtest/gtest.h>

#include "tests/core/onboard/executor_rig.hpp"

// Brackets and parking feet as parts of an order and by themselves: what begins, what holds them,
// and who lets them go on.
namespace pulseline::onboard::testing {
namespace {

/// Lifts that move until the test ends it.
class SlowLifts : public Equipment {
public:
    const std::vector<std::string>& action_types() const override { return types_; }
    std::optional<std::string> begin(const vda5050::Action& action) override {
        if (moving) return "lifts_moving";
        if (!refuses.empty()) return refuses;
        begun.push_back(action.type);
        moving = true;
        cause.reset();
        return std::nullopt;
    }
    bool busy() const override { return moving; }
    std::optional<std::string> failure() const override { return cause; }
    void abort() override { moving = false; }
    bool holds_vehicle() const override { return moving || down; }
    bool half_transferred() override { return half; }

    bool moving = false;
    bool down = false;  // the feet
    bool half = false;  // of a load is on its brackets
    std::string refuses;
    std::optional<std::string> cause;
    std::vector<std::string> begun;

private:
    std::vector<std::string> types_{"setBracketHeight", "lowerParking"};
};

class LiftsTest : public ExecutorTest {
protected:
    LiftsTest() {
        vda5050::Action init;
        init.type = "initPosition";
        init.id = "init";
        init.init_position = vda5050::InitPosition{{}, "hall", ""};
        fitted.handle(vda5050::InstantActionsMessage{{init}});
    }

    void tell(const std::string& type, const std::string& id) {
        vda5050::Action action;
        action.type = type;
        action.id = id;
        fitted.handle(vda5050::InstantActionsMessage{{action}});
    }
    /// An order that lowers the feet where it begins, and drives 2 m.
    void give_order() {
        OrderMessage message = order("o1", 2, 2);
        vda5050::Action lower;
        lower.type = "lowerParking";
        lower.id = "lower";
        message.nodes[0].actions = {lower};
        fitted.handle(message);
    }
    void pass(double seconds) {
        for (double t = 0; t < seconds; t += kStep_s) fitted.step(kStep_s);
    }
    vda5050::ActionState action(const std::string& id) const {
        StateMessage now;
        fitted.write_state(now);
        for (const auto& state : now.action_states) {
            if (state.id == id) return state;
        }
        return {"no such action", {}, {}, {}, {}};
    }
    void expect_failed(const std::string& id, const std::string& why) const {
        EXPECT_EQ(action(id).status, ActionStatus::kFailed) << id;
        EXPECT_EQ(action(id).result_description, why) << id;
    }

    SlowLifts lifts;
    Executor fitted{motion, sensing, "hall", &lifts};
};

TEST_F(LiftsTest, RunByThemselvesUntilTheyHaveEnded) {
    tell("setBracketHeight", "up");
    pass(1);
    EXPECT_EQ(action("up").status, ActionStatus::kRunning);
    lifts.moving = false;
    pass(0.1);
    EXPECT_EQ(action("up").status, ActionStatus::kFinished);

    tell("setBracketHeight", "down");
    lifts.moving = false;
    lifts.cause = "bracket_force_out_of_range";
    pass(0.1);
    expect_failed("down", "bracket_force_out_of_range");
}

/// In the moment in which what it wanted has ended, or while the executor stood still for a fault.
TEST_F(LiftsTest, AnOrderIsCancelledAfterWhatItWantedHasEnded) {
    give_order();
    pass(0.1);
    ASSERT_EQ(action("lower").status, ActionStatus::kRunning);
    lifts.moving = false;
    tell("cancelOrder", "cancel");
    pass(0.1);
    EXPECT_EQ(action("lower").status, ActionStatus::kFinished) << "nothing is left of the order";
    EXPECT_EQ(action("cancel").status, ActionStatus::kFinished);
}

TEST_F(LiftsTest, OneMovementAtATimeAndNoneThatTheVehicleDoesNotHave) {
    tell("setBracketHeight", "first");
    tell("lowerParking", "second");
    expect_failed("second", "lifts_moving");
    EXPECT_EQ(lifts.begun.size(), 1u);
    lifts.moving = false;
    pass(0.1);
    tell("raiseParking", "third");
    EXPECT_EQ(action("third").status, ActionStatus::kFailed);
    lifts.refuses = "out_of_stroke";
    tell("setBracketHeight", "fourth");
    expect_failed("fourth", "out_of_stroke");
}

TEST_F(LiftsTest, StayWhereTheyAreWhileTheVehicleHasAnOrderOrIsPaused) {
    give_order();
    tell("setBracketHeight", "up");
    expect_failed("up", "vehicle_busy");
    lifts.moving = false;
    pass(20);
    tell("startPause", "pause");
    tell("setBracketHeight", "again");
    expect_failed("again", "vehicle_paused");
}

TEST_F(LiftsTest, AnOrderThatComesMeanwhileWaitsForTheirEnd) {
    tell("setBracketHeight", "up");
    give_order();
    pass(5);
    EXPECT_EQ(action("lower").status, ActionStatus::kWaiting);
    EXPECT_EQ(motion.true_pose().x_m, 0);
    lifts.moving = false;
    pass(0.1);
    EXPECT_EQ(action("up").status, ActionStatus::kFinished);
    EXPECT_EQ(action("lower").status, ActionStatus::kRunning);
}

TEST_F(LiftsTest, APauseHoldsThemAndAPersonMovesThemAnew) {
    tell("setBracketHeight", "up");
    pass(0.1);
    tell("startPause", "pause");
    EXPECT_FALSE(lifts.moving) << "at once";
    expect_failed("up", "vehicle_paused");
    tell("stopPause", "go");
    pass(5);
    EXPECT_FALSE(lifts.moving);
}

TEST_F(LiftsTest, APauseHoldsThoseOfAnOrderWhichGoesOnWithThem) {
    give_order();
    pass(0.1);
    ASSERT_TRUE(lifts.moving);
    tell("startPause", "pause");
    EXPECT_FALSE(lifts.moving) << "at once";
    pass(1);
    EXPECT_EQ(action("lower").status, ActionStatus::kPaused);
    tell("stopPause", "go");
    pass(0.1);
    EXPECT_TRUE(lifts.moving);
    EXPECT_EQ(action("lower").status, ActionStatus::kRunning);
    lifts.moving = false;
    pass(20);
    EXPECT_EQ(action("lower").status, ActionStatus::kFinished);
    EXPECT_NEAR(motion.true_pose().x_m, 2, 0.01);
}

TEST_F(LiftsTest, APausedOneOfACancelledOrderHasFailed) {
    give_order();
    pass(0.1);
    tell("startPause", "pause");
    tell("cancelOrder", "cancel");
    pass(1);
    expect_failed("lower", "cancelled");
    tell("stopPause", "go");
    pass(1);
    EXPECT_FALSE(lifts.moving);
}

TEST_F(LiftsTest, ACutLineHoldsThemWhoeverWantedThem) {
    tell("setBracketHeight", "up");
    pass(0.1);
    fitted.lose_link();
    EXPECT_FALSE(lifts.moving);
    expect_failed("up", "link_lost");

    give_order();
    pass(0.1);
    ASSERT_TRUE(lifts.moving);
    fitted.lose_link();
    pass(20);
    EXPECT_FALSE(lifts.moving);
    expect_failed("lower", "link_lost");
}

TEST_F(LiftsTest, ACutLineHoldsNoDrive) {
    fitted.handle(order("o1", 2, 2));
    pass(0.5);
    fitted.lose_link();
    pass(20);
    EXPECT_NEAR(motion.true_pose().x_m, 2, 0.01);
}

TEST_F(LiftsTest, AreStoppedByAskingForIt) {
    tell("setBracketHeight", "up");
    tell("stopLifts", "stop");
    EXPECT_FALSE(lifts.moving);
    expect_failed("up", "lifts_stopped");
    tell("stopLifts", "stop again");
    EXPECT_EQ(action("stop again").status, ActionStatus::kFinished) << "nothing moves";

    give_order();
    pass(0.1);
    tell("stopLifts", "stop the order's");
    expect_failed("lower", "lifts_stopped");
}

TEST_F(LiftsTest, TakenByHandTheyStayWhereTheyAre) {
    tell("setBracketHeight", "up");
    pass(0.1);
    fitted.take_by_hand();
    EXPECT_FALSE(lifts.moving);
    expect_failed("up", "taken by hand");
    pass(1);
    tell("setBracketHeight", "in hand");
    lifts.moving = false;
    pass(0.1);
    EXPECT_EQ(action("in hand").status, ActionStatus::kFinished);
}

TEST_F(LiftsTest, AVehicleWithoutThemKnowsNoSuchAction) {
    instant("stopLifts", "stop");
    EXPECT_EQ(status("stop"), ActionStatus::kFailed);
    EXPECT_EQ(last_error(), "instantActionError");
}

TEST_F(LiftsTest, OnItsFeetOrWithHalfALoadNobodyDrivesItByHand) {
    fitted.take_by_hand();
    const auto refused = [&] {
        const auto driven = fitted.drive_by_hand({0.2, 0, 0});
        pass(1);
        return driven ? "" : driven.error().reason.code;
    };
    lifts.down = true;
    EXPECT_EQ(refused(), "held");
    lifts.down = false;
    lifts.half = true;
    EXPECT_EQ(refused(), "load_half_taken");
    EXPECT_TRUE(fitted.drive_by_hand({})) << "to let go is never refused";
    EXPECT_EQ(motion.true_pose().x_m, 0);
    lifts.half = false;
    EXPECT_EQ(refused(), "");
    EXPECT_GT(motion.true_pose().x_m, 0.005);
}

TEST_F(LiftsTest, WithHalfALoadAnOrderWaitsAndItSaysWhy) {
    const auto says = [&] {
        vda5050::StateMessage state;
        fitted.write_state(state);
        return std::ranges::count(state.errors, vda5050::kLoadHalfTaken,
                                  &vda5050::VehicleError::type);
    };
    lifts.half = true;
    fitted.handle(order("o1", 2, 2));
    pass(5);
    EXPECT_EQ(motion.true_pose().x_m, 0);
    EXPECT_EQ(says(), 1);
    lifts.moving = true;
    EXPECT_EQ(says(), 0) << "while it is at it, it is no half";
    lifts.moving = false;
    lifts.half = false;
    EXPECT_EQ(says(), 0);
    pass(30);
    EXPECT_NEAR(motion.true_pose().x_m, 2, 0.05);
}

}  // namespace
}  // namespace pulseline::onboard::testing
