#include <gtest/gtest.h>

#include "tests/core/onboard/executor_rig.hpp"

/// What an order asks for on its edges.
namespace pulseline::onboard::testing {
namespace {

class EdgeActions : public ExecutorTest {};

OrderMessage observing(int count, int released) {
    OrderMessage message = order("a", count, released);
    for (auto& edge : message.edges) {
        vda5050::Action action;
        action.type = "observeMarkers";
        action.id = "observe-" + edge.edge_id;
        action.blocking = vda5050::BlockingType::kNone;
        const char* payload = edge.edge_id == "e3" ? "10" : "7";
        action.markers = {{payload, "apriltag", 0.05, edge.segment.end, 1e-4, 5e-4}};
        edge.actions = {action};
    }
    return message;
}

TEST_F(EdgeActions, RunWhileTheEdgeIsDriven) {
    executor.handle(observing(4, 3));
    EXPECT_EQ(status("observe-e1"), ActionStatus::kWaiting);
    run(1);
    EXPECT_EQ(status("observe-e1"), ActionStatus::kRunning);
    EXPECT_EQ(status("observe-e2"), ActionStatus::kWaiting);
    run(60);
    EXPECT_EQ(status("observe-e1"), ActionStatus::kFinished);
    EXPECT_EQ(status("observe-e2"), ActionStatus::kFinished);
    EXPECT_EQ(status("observe-e3"), ActionStatus::kWaiting);
    EXPECT_NEAR(motion.true_pose().x_m, 4, 0.05) << "it stops for none of them";
}

TEST_F(EdgeActions, TellTheCodesThatWereReadThere) {
    executor.handle(observing(4, 4));
    run(1);
    executor.note_codes({"7"});
    executor.note_codes({"8", "9", "7"});
    run(60);
    EXPECT_EQ(result("observe-e1"), "7, 8, 9");
    EXPECT_EQ(result("observe-e2"), "7") << "it lies where both meet";
    EXPECT_EQ(result("observe-e3"), "") << "passed unread";
    executor.note_codes({"7"});
    EXPECT_EQ(result("observe-e3"), "") << "that is another one";
    executor.note_codes({"10"});
    EXPECT_EQ(result("observe-e3"), "10") << "of a picture taken before the node";
}

TEST_F(EdgeActions, EndWithTheirOrderOrTheirHorizon) {
    executor.handle(observing(4, 3));
    executor.handle(update("a", 1, 2, 3, 3));
    EXPECT_EQ(status("observe-e3"), std::nullopt) << "taken back";
    run(1);
    instant("cancelOrder", "c");
    EXPECT_EQ(status("observe-e1"), ActionStatus::kFailed);
    EXPECT_EQ(status("observe-e2"), ActionStatus::kFailed);
}

/// Three edges of 2 m, the second one to be driven precisely.
OrderMessage precise_in_the_middle() {
    OrderMessage message = order("a", 4, 4);
    vda5050::Action action;
    action.type = "finePositioning";
    action.id = "fine";
    action.blocking = vda5050::BlockingType::kNone;
    message.edges[1].actions = {action};
    return message;
}

TEST_F(EdgeActions, FinePositioningLastsFromTheEdgesBeginningToItsEnd) {
    executor.handle(precise_in_the_middle());
    double fastest_before = 0;
    double fastest_on = 0;
    double fastest_behind = 0;
    while (!state().node_states.empty()) {
        run(kStep_s);
        const double speed_mps = motion.velocity_mps();
        const auto last = state().last_node_id;
        double& fastest =
            last == "n0" ? fastest_before : (last == "n1" ? fastest_on : fastest_behind);
        fastest = std::max(fastest, speed_mps);
        const auto expected = last == "n0"   ? ActionStatus::kWaiting
                              : last == "n1" ? ActionStatus::kRunning
                                             : ActionStatus::kFinished;
        ASSERT_EQ(status("fine"), expected) << "behind " << last;
        ASSERT_LT(furthest_x, 6.01);
    }
    EXPECT_GT(fastest_before, 0.35);
    EXPECT_LE(fastest_on, 0.3 + 0.1 * kStep_s) << "one step of its braking, at the node";
    EXPECT_GT(fastest_on, 0.29) << "and no slower than that";
    EXPECT_GT(fastest_behind, 0.35);
    EXPECT_EQ(result("fine"), "");
}

TEST_F(EdgeActions, ALowerLimitOfAPreciseEdgeHolds) {
    auto message = precise_in_the_middle();
    message.edges[1].max_speed_mps = 0.2;
    executor.handle(message);
    double fastest_on = 0;
    for (int i = 0; i < 2000 && !state().node_states.empty(); ++i) {
        run(kStep_s);
        if (state().last_node_id == "n1") fastest_on = std::max(fastest_on, motion.velocity_mps());
    }
    EXPECT_TRUE(state().node_states.empty());
    EXPECT_NEAR(fastest_on, 0.2, 0.1 * kStep_s + 1e-9);
}

TEST_F(EdgeActions, APreciseEdgeDoesNotTakeTheCodesOfAnother) {
    auto message = observing(4, 4);
    message.edges[0].actions.insert(message.edges[0].actions.begin(),
                                    precise_in_the_middle().edges[1].actions.front());
    executor.handle(message);
    run(1);
    executor.note_codes({"7"});
    run(60);
    EXPECT_EQ(status("fine"), ActionStatus::kFinished);
    EXPECT_EQ(result("fine"), "");
    EXPECT_EQ(result("observe-e1"), "7");
}

TEST_F(EdgeActions, FailWithACancelledOrder) {
    executor.handle(precise_in_the_middle());
    for (int i = 0; i < 2000 && state().last_node_id != "n1"; ++i) run(kStep_s);
    EXPECT_EQ(status("fine"), ActionStatus::kRunning);
    instant("cancelOrder", "c");
    EXPECT_EQ(status("fine"), ActionStatus::kFailed);
    EXPECT_EQ(result("fine"), "cancelled");
}

/// By its name and as for a node; nothing of the order is done.
TEST_F(EdgeActions, ThatItCannotDoAreRefused) {
    struct Case {
        const char* type;
        vda5050::BlockingType blocking;
        const char* id;
    };
    using enum vda5050::BlockingType;
    for (const auto& [type, blocking, id] :
         {Case{"raiseParking", kNone, "r"}, Case{"measureStop", kNone, "m"},
          Case{"beep", kNone, "b"}, Case{"finePositioning", kHard, "h"},
          Case{"observeMarkers", kSoft, "s"}, Case{"finePositioning", kNone, ""}}) {
        auto message = precise_in_the_middle();
        auto& action = message.edges[2].actions.emplace_back();
        action.type = type;
        action.blocking = blocking;
        action.id = id;
        executor.handle(message);
        ASSERT_EQ(last_error(), "orderError") << type;
        const auto now = state();
        EXPECT_EQ(now.errors.back().references.back(),
                  (std::pair<std::string, std::string>("actionId", id)));
        EXPECT_NE(now.errors.back().description.find(type), std::string::npos);
        EXPECT_EQ(now.order_id, "");
        EXPECT_EQ(status("fine"), std::nullopt);
    }
    run(5);
    EXPECT_EQ(furthest_x, 0);

    executor.handle(order("a", 4, 2));
    auto more = update("a", 1, 1, 4, 4);
    more.edges[1].actions = {{"beep", "b", kNone, {}, {}, {}}};
    executor.handle(more);
    EXPECT_EQ(last_error(), "orderError");
    run(60);
    EXPECT_NEAR(furthest_x, 2, 1e-5) << "the order before goes on as it was";
}

}  // namespace
}  // namespace pulseline::onboard::testing
