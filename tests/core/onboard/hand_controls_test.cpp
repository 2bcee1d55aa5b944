#include "core/onboard/hand_controls.hpp"

#include <gtest/gtest.h>

#include "tests/core/onboard/executor_rig.hpp"

namespace pulseline::onboard::testing {
namespace {

const HandControl kAnn{"a", "ann"};
const HandControl kBob{"b", "bob"};
const HandControl kBeside{"beside", ""};

class HandControlsTest : public ExecutorTest {
protected:
    std::string refused(const Status& status) { return status ? "" : status.error().reason.code; }
    /// Time of the wall clock and of the vehicle.
    void pass(double time_s) {
        now_s += time_s;
        run(time_s);
    }
    Status drive(const HandControl& control, double vx_mps = 0.2,
                 std::optional<double> sent_s = {}) {
        return hands.drive(control.id, {vx_mps, 0, 0}, sent_s, now_s);
    }
    double driven_m() { return motion.true_pose().x_m; }

    HandControls hands{executor};
    double now_s = 100;
};

TEST_F(HandControlsTest, OneHasItAndTheOtherHearsWho) {
    ASSERT_TRUE(hands.take(kAnn, now_s));
    EXPECT_TRUE(hands.take(kAnn, now_s)) << "twice does no harm";
    const Status other = hands.take(kBob, now_s);
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().reason, (Reason{"in_other_hands", {{"person", std::string("ann")}}}));
    EXPECT_EQ(refused(drive(kBob)), "in_other_hands");
    EXPECT_EQ(refused(hands.give_back(kBob.id)), "in_other_hands");
    pass(1);
    EXPECT_EQ(driven_m(), 0) << "nothing of that moved it";
    EXPECT_TRUE(drive(kAnn));
    ASSERT_EQ(hands.holder()->person, "ann");
}

TEST_F(HandControlsTest, NobodyTookItNobodyDrivesIt) {
    EXPECT_EQ(refused(drive(kAnn)), "not_in_hand");
    EXPECT_EQ(refused(hands.give_back(kAnn.id)), "not_in_hand");
    hands.left(kAnn.id);
    EXPECT_FALSE(executor.in_hand());
    EXPECT_FALSE(hands.holder());
}

TEST_F(HandControlsTest, AnotherGetsItWhenItIsGivenBack) {
    ASSERT_TRUE(hands.take(kAnn, now_s));
    pass(0.1);
    ASSERT_TRUE(hands.give_back(kAnn.id));
    EXPECT_FALSE(hands.holder());
    EXPECT_EQ(refused(drive(kAnn)), "not_in_hand");
    EXPECT_TRUE(hands.take(kBob, now_s));
}

TEST_F(HandControlsTest, AnotherGetsItAtOnceWhenTheFirstHasGoneAndItBrakesThen) {
    ASSERT_TRUE(hands.take(kAnn, now_s));
    for (int i = 0; i < 20; ++i) {
        ASSERT_TRUE(drive(kAnn));
        pass(0.1);
    }
    EXPECT_FALSE(motion.standing());
    hands.left(kBob.id);
    EXPECT_FALSE(hands.take(kBob, now_s)) << "who never had it cannot leave it";
    hands.left(kAnn.id);
    EXPECT_TRUE(executor.in_hand());
    ASSERT_TRUE(hands.take(kBob, now_s));
    pass(2);
    EXPECT_TRUE(motion.standing()) << "what the first wanted is over";
    EXPECT_EQ(refused(drive(kAnn)), "in_other_hands");
    EXPECT_TRUE(drive(kBob));
}

TEST_F(HandControlsTest, ASilentOneLosesItToWhoeverAsksAndOnlyThen) {
    ASSERT_TRUE(hands.take(kBeside, now_s));
    pass(HandControls::kSilent_s - 0.1);
    EXPECT_EQ(refused(hands.take(kAnn, now_s)), "in_other_hands");
    hands.heard(kBeside.id, now_s);
    pass(HandControls::kSilent_s - 0.1);
    EXPECT_EQ(refused(hands.take(kAnn, now_s)), "in_other_hands");
    EXPECT_TRUE(drive(kBeside)) << "nobody asked, so it still has it";
    pass(HandControls::kSilent_s);
    ASSERT_TRUE(hands.take(kAnn, now_s));
    EXPECT_EQ(refused(drive(kBeside)), "in_other_hands");
}

TEST_F(HandControlsTest, WhatALineHeldUpIsNotDoneAnyMore) {
    ASSERT_TRUE(hands.take(kAnn, now_s));
    double control_s = 7;  // a clock with another zero
    for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE(drive(kAnn, 0.2, control_s));
        pass(0.1);
        control_s += 0.1;
    }
    // The line stands still for a second, and then all of it comes at once, the newest let go.
    const double before_s = control_s;
    pass(1);
    const double stood_at_m = driven_m();
    for (double sent_s = before_s; sent_s < before_s + 0.6; sent_s += 0.1) {
        EXPECT_EQ(refused(drive(kAnn, 0.2, sent_s)), "too_late") << sent_s;
    }
    pass(1);
    EXPECT_NEAR(driven_m(), stood_at_m, 0.03) << "braking only";
    EXPECT_TRUE(drive(kAnn, 0.2, before_s + 2)) << "as quick as before";
}

TEST_F(HandControlsTest, ToLetGoIsNeverTooLate) {
    ASSERT_TRUE(hands.take(kAnn, now_s));
    double control_s = 7;
    for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE(drive(kAnn, 0.2, control_s));
        pass(0.1);
        control_s += 0.1;
    }
    // The newest command came in time, the letting go half a second late.
    ASSERT_TRUE(drive(kAnn, 0.2, control_s));
    const double moving_m = driven_m();
    EXPECT_EQ(refused(drive(kAnn, 0, control_s - 0.5)), "too_late");
    pass(1);
    EXPECT_TRUE(motion.standing());
    EXPECT_LT(driven_m() - moving_m, 0.2 * HandDrive::kLetGo_s) << "not only when it is missed";
}

TEST_F(HandControlsTest, WhoGoesAwayHasNotLetGoAfterAPause) {
    ASSERT_TRUE(hands.take(kAnn, now_s));
    ASSERT_TRUE(drive(kAnn));
    pass(0.1);
    instant("startPause", "p");
    hands.left(kAnn.id);
    pass(2);
    ASSERT_TRUE(hands.take(kBob, now_s));
    EXPECT_EQ(refused(drive(kBob)), "let_go_first");
    ASSERT_TRUE(drive(kBob, 0));
    EXPECT_TRUE(drive(kBob));
}

TEST_F(HandControlsTest, ClocksThatDriftApartAreNoLateLine) {
    ASSERT_TRUE(hands.take(kAnn, now_s));
    double control_s = 0;
    for (int i = 0; i < 20'000; ++i) {  // over half an hour, 500 ppm
        now_s += 0.1;
        control_s += 0.1 * (1 - 5e-4);
        ASSERT_TRUE(drive(kAnn, 0, control_s)) << i;
    }
    ASSERT_TRUE(hands.take(kAnn, now_s));
    EXPECT_TRUE(drive(kAnn, 0, control_s - 3600)) << "taken anew, on a tablet that slept";
}

TEST_F(HandControlsTest, APauseBrakesItAndOnlyWhoLetsGoAndPressesAgainMovesIt) {
    ASSERT_TRUE(hands.take(kAnn, now_s));
    for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE(drive(kAnn));
        pass(0.1);
    }
    instant("startPause", "p");
    for (int i = 0; i < 30; ++i) {
        EXPECT_EQ(refused(drive(kAnn)), "let_go_first");
        pass(0.1);
    }
    EXPECT_TRUE(motion.standing());
    EXPECT_EQ(status("p"), ActionStatus::kFinished) << "it stands, and says so";
    const double stood_at_m = driven_m();
    EXPECT_TRUE(drive(kAnn, 0));
    for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE(drive(kAnn)) << "out of the way, on purpose";
        pass(0.1);
    }
    EXPECT_GT(driven_m(), stood_at_m + 0.05);
}

TEST_F(HandControlsTest, WhileItMovesItIsNotGivenBack) {
    ASSERT_TRUE(hands.take(kAnn, now_s));
    ASSERT_TRUE(drive(kAnn));
    pass(0.2);
    EXPECT_EQ(refused(hands.give_back(kAnn.id)), "still_moving");
    ASSERT_TRUE(hands.holder()) << "nothing half done";
    pass(2);
    EXPECT_TRUE(hands.give_back(kAnn.id));
}

}  // namespace
}  // namespace pulseline::onboard::testing
