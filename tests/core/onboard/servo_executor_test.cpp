// The executor on a drive with wheels: what the statistical drive cannot show.
#include <gtest/gtest.h>

#include <optional>

#include "core/onboard/executor.hpp"
#include "core/simulation/machine/servo_drive.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/simulation/platform.hpp"

namespace pulseline::onboard {
namespace {

using namespace simulation;

using simulation::testing::straight;
using vda5050::ActionStatus;

constexpr double kStep_s = 0.05;

class TrueSensing : public StopSensing {
public:
    explicit TrueSensing(const SimulatedDrive& drive) : drive_(drive) {}
    Result<vda5050::StopMeasurement> measure(const vda5050::StopTarget&) override {
        return vda5050::StopMeasurement{drive_.true_pose(), 1e-4, 1e-4, "test", {"ST01-F"}};
    }

private:
    const SimulatedDrive& drive_;
};

/// One leg straight ahead, at its end `actions`.
vda5050::OrderMessage leg(double length_m, std::vector<vda5050::Action> actions) {
    vda5050::OrderMessage order;
    order.order_id = "a";
    order.nodes.resize(2);
    order.edges.resize(1);
    order.edges[0].sequence_id = 1;
    order.edges[0].released = true;
    order.edges[0].segment = straight({}, length_m);
    for (int i = 0; i < 2; ++i) {
        order.nodes[i].node_id = "n" + std::to_string(i);
        order.nodes[i].sequence_id = 2 * i;
        order.nodes[i].released = true;
        order.nodes[i].map_id = "hall";
        order.nodes[i].pose = {length_m * i, 0, 0};
    }
    order.nodes[1].actions = std::move(actions);
    return order;
}

class ServoExecutorTest : public ::testing::TestWithParam<int> {
protected:
    ServoExecutorTest() { instant("initPosition"); }

    static plant::VehicleType type() {
        return GetParam() == 0 ? pulseline::testing::platform() : pulseline::testing::mecanum();
    }
    void instant(const std::string& name) {
        vda5050::Action action;
        action.type = name;
        action.id = "id-" + name;
        if (name == "initPosition") {
            action.init_position = vda5050::InitPosition{drive.believed_pose(), "hall", ""};
        }
        executor.handle(vda5050::InstantActionsMessage{{action}});
    }
    void run(double seconds) {
        for (double t = 0; t < seconds; t += kStep_s) executor.step(kStep_s);
    }
    std::optional<ActionStatus> status(const std::string& id) const {
        vda5050::StateMessage state;
        executor.write_state(state);
        for (const auto& action : state.action_states) {
            if (action.id == id) return action.status;
        }
        return std::nullopt;
    }

    ServoDrive drive{type(), {}, 5};
    TrueSensing sensing{drive};
    Executor executor{drive, sensing, "hall"};
};

TEST_P(ServoExecutorTest, AdjustsItsTruePoseAtTheEndOfALeg) {
    vda5050::Action adjust;
    adjust.type = "adjustToMarker";
    adjust.id = "adjust";
    const Pose2 target{12.012, -0.008, radians(0.1)};
    adjust.stop_target = vda5050::StopTarget{"st01", 1, target, 0.025, 0.025, 0.0035, {}};
    executor.handle(leg(12, {adjust}));
    run(120);
    ASSERT_EQ(status("adjust"), ActionStatus::kFinished);
    const Pose2 off = inverse(target) * drive.true_pose();
    EXPECT_LT(norm(off.position()), 0.0025);
    EXPECT_LT(std::abs(off.heading_rad), radians(0.04));
}

TEST_P(ServoExecutorTest, ADriveThatBreaksInACorrectionFailsTheAction) {
    vda5050::Action adjust;
    adjust.type = "adjustToMarker";
    adjust.id = "adjust";
    adjust.stop_target = vda5050::StopTarget{"st01", 1, {3.05, 0, 0}, 0.025, 0.025, 0.0035, {}};
    executor.handle(leg(3, {adjust}));
    for (int i = 0; i < 2000 && status("adjust") != ActionStatus::kRunning; ++i) run(kStep_s);
    while (drive.idle()) run(kStep_s);
    drive.break_wheel(GetParam() == 0 ? "front drive" : "FL");
    run(10);
    EXPECT_EQ(status("adjust"), ActionStatus::kFailed);
    EXPECT_TRUE(drive.idle());
    vda5050::StateMessage state;
    executor.write_state(state);
    EXPECT_EQ(state.action_states.at(0).result_description, "drive_stopped: wheel_fault");
}

TEST_P(ServoExecutorTest, CancelWhileItDrivesOrSteersLeavesAnIdleVehicle) {
    executor.handle(leg(12, {}));
    run(5);
    instant("cancelOrder");
    run(30);
    EXPECT_EQ(status("id-cancelOrder"), ActionStatus::kFinished);
    EXPECT_TRUE(drive.idle());
    EXPECT_LT(drive.true_pose().x_m, 11);
}

TEST_P(ServoExecutorTest, DrivenByHandItSaysWhatStoppedItAndGoesOnWhenThePersonHasLetGo) {
    const std::string wheel = GetParam() == 0 ? "back drive" : "BR";
    executor.handle(leg(12, {}));
    run(5);
    drive.set_slip(wheel, 0.3);
    run(30);
    ASSERT_TRUE(drive.stop_cause());
    drive.set_slip(wheel, 0);
    executor.take_by_hand();
    run(2);
    const auto by_hand = [&](double vx_mps, double seconds) {
        std::string refused;
        for (double t = 0; t < seconds; t += kStep_s) {
            const auto done = executor.drive_by_hand({vx_mps, 0, 0});
            if (!done) refused = done.error().reason.code;
            run(kStep_s);
        }
        return refused;
    };
    const double here_m = drive.believed_pose().x_m;
    EXPECT_EQ(by_hand(-0.2, 5), "") << "who took it has looked";
    EXPECT_LT(drive.believed_pose().x_m, here_m - 0.3);

    drive.break_wheel(GetParam() == 0 ? "front drive" : "FL");
    EXPECT_EQ(by_hand(-0.2, 5), "wheel_fault");
    EXPECT_TRUE(drive.standing());
    EXPECT_EQ(by_hand(0, 0.5), "");
    EXPECT_EQ(by_hand(-0.2, 1), "wheel_fault") << "still broken";
}

TEST_P(ServoExecutorTest, StopPauseLetsADriveGoOnThatHasStoppedItself) {
    const std::string wheel = GetParam() == 0 ? "back drive" : "BR";
    executor.handle(leg(12, {}));
    run(5);
    drive.set_slip(wheel, 0.3);
    run(30);
    ASSERT_TRUE(drive.stop_cause());
    const double here_m = drive.believed_pose().x_m;
    EXPECT_LT(here_m, 11);
    drive.set_slip(wheel, 0);
    run(10);
    EXPECT_EQ(drive.believed_pose().x_m, here_m);  // of itself it does nothing
    instant("stopPause");
    run(60);
    EXPECT_FALSE(drive.stop_cause());
    EXPECT_NEAR(drive.believed_pose().x_m, 12, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(PlatformAndMecanum, ServoExecutorTest, ::testing::Values(0, 1));

}  // namespace
}  // namespace pulseline::onboard
