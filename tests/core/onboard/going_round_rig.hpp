#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/onboard/going_round.hpp"
#include "core/simulation/machine/servo_drive.hpp"
#include "core/simulation/world/scanners.hpp"
#include "tests/core/planning/detour_world.hpp"
#include "tests/core/simulation/platform.hpp"

/// A vehicle with scanners among edges with corridors, for tests of going round: no messages, no
/// clock, and the laws of a detour looked at in every step.
namespace pulseline::onboard::testing {

using geometry::Point2;
using geometry::Polygon;
using geometry::Pose2;
using planning::testing::families;
using planning::testing::front_m;
using planning::testing::half_width_m;
using planning::testing::reach_m;

constexpr double kStep_s = 0.05;
constexpr double kEdge_m = 4;
inline const Pose2 kBegin{20, 30, 0};

class NoSensing : public StopSensing {
public:
    Result<vda5050::StopMeasurement> measure(const vda5050::StopTarget&) override {
        return fail(Errc::kNotFound, "no_marker_in_view", "no code in view");
    }
};

inline simulation::World world_of(const plant::VehicleType& type) {
    simulation::World world;
    plant::Hall hall;
    hall.id = plant::HallId("hall");
    hall.outline = {{0, 0}, {120, 0}, {120, 60}, {0, 60}};
    world.plant.halls.push_back(hall);
    world.plant.vehicle_types.push_back(type);
    return world;
}

/// A vehicle among edges of 4 m along x from kBegin, `side_m` of room beside it on both sides.
class Rig {
public:
    explicit Rig(const plant::VehicleType& of, double side_m = 2.5)
        : type(of),
          corridor(plant::Corridor{half_width_m(of) + side_m, half_width_m(of) + side_m}) {
        vda5050::Action init;
        init.type = "initPosition";
        init.id = "init";
        init.init_position = vda5050::InitPosition{kBegin, "hall", ""};
        executor.handle(vda5050::InstantActionsMessage{{init}});
    }

    /// Nodes 0 to `edges`, `released` of the edges released; sent from node `from` on. At node
    /// `stop` it is to measure, which NoSensing cannot.
    void send(int edges, int released, int from = 0, int stop = -1) {
        vda5050::OrderMessage order;
        order.order_id = "leg";
        order.order_update_id = update++;
        for (int i = from; i <= edges; ++i) {
            vda5050::OrderNode node;
            node.node_id = "n" + std::to_string(i);
            node.sequence_id = 2 * i;
            node.released = i <= released;
            node.pose = kBegin * Pose2{kEdge_m * i, 0, 0};
            node.map_id = "hall";
            if (corridor)
                node.allowed_deviation_xy_m = std::max(corridor->left_m, corridor->right_m);
            if (i == stop) node.actions.push_back(measure(node.pose));
            order.nodes.push_back(node);
            if (i == from) continue;
            vda5050::OrderEdge edge;
            edge.edge_id = "e" + std::to_string(i);
            edge.sequence_id = 2 * i - 1;
            edge.released = i <= released;
            edge.segment =
                simulation::testing::straight(kBegin * Pose2{kEdge_m * (i - 1), 0, 0}, kEdge_m);
            edge.corridor = corridor;
            order.edges.push_back(edge);
        }
        executor.handle(order);
        base_end_m = kBegin.x_m + kEdge_m * released;
    }
    void put_box(double x_m, double y_m, double size_m = 0.5) {
        boxes.push_back(geometry::transformed({kBegin.x_m + x_m, kBegin.y_m + y_m, 0},
                                              geometry::rectangle(size_m, size_m)));
        scanners.put(boxes.back());
    }
    void take_away() {
        boxes.clear();
        scanners.take_away();
    }
    void instant(const std::string& name) {
        vda5050::Action action;
        action.type = name;
        action.id = name;
        executor.handle(vda5050::InstantActionsMessage{{action}});
    }

    /// Until `enough`, or so long; the laws are looked at in every step.
    bool run(double seconds, const std::function<bool()>& enough = {}) {
        for (double t = 0; t < seconds; t += kStep_s) {
            if (enough && enough()) return true;
            look_out.step(kStep_s);
            going_round.step(kStep_s);
            executor.step(kStep_s);
            look_at_laws();
            if (::testing::Test::HasFatalFailure()) return false;
        }
        return enough && enough();
    }
    bool run_to_the_end(double seconds) {
        return run(seconds, [&] { return state().node_states.empty() && drive.idle(); });
    }
    vda5050::StateMessage state() const {
        vda5050::StateMessage now;
        executor.write_state(now);
        look_out.write_state(now);
        going_round.write_state(now);
        return now;
    }
    /// Description of an error in the state; empty: it is not there.
    std::string told(const std::string& type_of_error) const {
        for (const auto& error : state().errors) {
            if (error.type == type_of_error) return error.description;
        }
        return "";
    }
    bool told_why(const std::string& why) const {
        return told("obstacle").find("does not go round it: " + why) != std::string::npos;
    }

    plant::VehicleType type;
    std::optional<plant::Corridor> corridor;
    simulation::World world = world_of(type);
    simulation::ServoDrive drive{type, kBegin, 7};
    simulation::SimulatedScanners scanners{world, plant::HallId("hall"), type, drive.true_pose(),
                                           3};
    LookOut look_out{scanners, false, drive};
    NoSensing sensing;
    Executor executor{drive, sensing, "hall"};
    GoingRound going_round{type, false, drive, look_out, executor};
    std::vector<Polygon> boxes;
    int update = 0;
    double base_end_m = 0;
    double farthest_beside_m = 0;
    std::int64_t last_passed = 0;

private:
    static vda5050::Action measure(const Pose2& target) {
        vda5050::Action action;
        action.type = "measureStop";
        action.id = "measure";
        action.stop_target = vda5050::StopTarget{"st01", 1, target, 0.025, 0.025, 0.0035, {}};
        return action;
    }
    void look_at_laws() {
        const Pose2& at = drive.true_pose();
        farthest_beside_m = std::max(farthest_beside_m, std::abs(at.y_m - kBegin.y_m));
        ASSERT_LE(at.x_m, base_end_m + 0.02) << "past the end of its base";
        const auto passed = executor.last_node_sequence_id();
        ASSERT_GE(passed, last_passed);
        last_passed = passed;
        const double passed_m = kBegin.x_m + kEdge_m * static_cast<double>(passed) / 2;
        ASSERT_GE(at.x_m, passed_m - 0.03) << "behind a node that it has reported";
        const Polygon body = geometry::transformed(at, type.footprint);
        for (const Polygon& box : boxes) ASSERT_GT(geometry::distance(body, box), 0.05);
        if (!corridor) return;
        // Floor is held from R before the last node passed to R behind the end of the base.
        for (const Point2& p : body) {
            ASSERT_GE(p.x_m, passed_m - reach_m(type));
            ASSERT_LE(p.x_m, base_end_m + reach_m(type));
            ASSERT_LE(p.y_m - kBegin.y_m, corridor->left_m);
            ASSERT_GE(p.y_m - kBegin.y_m, -corridor->right_m);
        }
    }
};

}  // namespace pulseline::onboard::testing
