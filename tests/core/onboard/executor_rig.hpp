#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

#include "core/onboard/executor.hpp"
#include "tests/core/simulation/platform.hpp"

/// A vehicle that measures and drives without an error, for tests of what its executor does: no
/// messages, no clock.
namespace pulseline::onboard::testing {

using namespace simulation;

using simulation::testing::exact;
using simulation::testing::platform_type;
using simulation::testing::straight;
using vda5050::ActionStatus;
using vda5050::OrderMessage;
using vda5050::StateMessage;

constexpr double kStep_s = 0.05;

/// Measures the true pose, or nothing while `covered` or out of sight of the code.
class TrueSensing : public StopSensing {
public:
    explicit TrueSensing(const VehicleMotion& motion) : motion_(motion) {}
    Result<vda5050::StopMeasurement> measure(const vda5050::StopTarget&) override {
        const bool far = code && distance(motion_.true_pose().position(), *code) > kSight_m;
        if (covered || far) return fail(Errc::kNotFound, "no_marker_in_view", "no code in view");
        return vda5050::StopMeasurement{motion_.true_pose(), 1e-4, 1e-4, "test", {"ST01-F"}};
    }
    bool covered = false;
    std::optional<geometry::Point2> code;

private:
    static constexpr double kSight_m = 0.04;
    const VehicleMotion& motion_;
};

/// Nodes 2 m apart along x; the first `released` of `count` released.
inline OrderMessage order(const std::string& id, int count, int released, double from_x = 0) {
    OrderMessage message;
    message.order_id = id;
    for (int i = 0; i < count; ++i) {
        vda5050::OrderNode node;
        node.node_id = "n" + std::to_string(i);
        node.sequence_id = 2 * i;
        node.released = i < released;
        node.pose = {from_x + 2.0 * i, 0, 0};
        node.map_id = "hall";
        message.nodes.push_back(node);
        if (i == 0) continue;
        vda5050::OrderEdge edge;
        edge.edge_id = "e" + std::to_string(i);
        edge.sequence_id = 2 * i - 1;
        edge.released = i < released;
        edge.segment = straight({from_x + 2.0 * (i - 1), 0, 0}, 2);
        message.edges.push_back(edge);
    }
    return message;
}

/// Update number `update` of order(id, count, released), sent from its node `from` on.
inline OrderMessage update(const std::string& id, int number, int from, int count, int released) {
    OrderMessage message = order(id, count, released);
    message.order_update_id = number;
    message.nodes.erase(message.nodes.begin(), message.nodes.begin() + from);
    message.edges.erase(message.edges.begin(), message.edges.begin() + from);
    return message;
}

inline vda5050::Action stop_action(const std::string& type, const Pose2& target) {
    vda5050::Action action;
    action.type = type;
    action.id = "id-" + type;
    action.stop_target = vda5050::StopTarget{"st01", 1, target, 0.025, 0.025, 0.0035, {}};
    return action;
}

class ExecutorTest : public ::testing::Test {
protected:
    ExecutorTest() { instant("initPosition", "init"); }

    void instant(const std::string& type, const std::string& id) {
        vda5050::Action action;
        action.type = type;
        action.id = id;
        if (type == "initPosition") action.init_position = vda5050::InitPosition{{}, "hall", ""};
        executor.handle(vda5050::InstantActionsMessage{{action}});
    }
    void run(double seconds) {
        for (double t = 0; t < seconds; t += kStep_s) {
            executor.step(kStep_s);
            furthest_x = std::max(furthest_x, motion.true_pose().x_m);
        }
    }
    StateMessage state() const {
        StateMessage state;
        executor.write_state(state);
        return state;
    }
    std::optional<ActionStatus> status(const std::string& id) const {
        for (const auto& action : state().action_states) {
            if (action.id == id) return action.status;
        }
        return std::nullopt;
    }
    std::string result(const std::string& id) const {
        for (const auto& action : state().action_states) {
            if (action.id == id) return action.result_description;
        }
        return "no such action";
    }
    std::string last_error() const {
        const auto now = state();
        return now.errors.empty() ? "" : now.errors.back().type;
    }

    VehicleMotion motion{platform_type(), {}, 1, 1, exact()};
    TrueSensing sensing{motion};
    Executor executor{motion, sensing, "hall"};
    double furthest_x = 0;
};

}  // namespace pulseline::onboard::testing
