#include "server/agent/going_round.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "core/simulation/servo_drive.hpp"
#include "tests/core/planning/detour_world.hpp"
#include "tests/core/simulation/platform.hpp"

namespace pulseline::agent {
namespace {

using geometry::Point2;
using geometry::Polygon;
using geometry::Pose2;
using planning::testing::families;
using planning::testing::front_m;
using planning::testing::half_width_m;
using planning::testing::reach_m;

constexpr double kStep_s = 0.05;
constexpr double kEdge_m = 4;
const Pose2 kBegin{20, 30, 0};

class NoSensing : public simulation::StopSensing {
public:
    Result<fleet::StopMeasurement> measure(const fleet::StopTarget&) override {
        return fail(Errc::kNotFound, "no_marker_in_view", "no code in view");
    }
};

simulation::World world_of(const plant::VehicleType& type) {
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
        fleet::Action init;
        init.type = "initPosition";
        init.id = "init";
        init.init_position = fleet::InitPosition{kBegin, "hall", ""};
        executor.handle(fleet::InstantActionsMessage{{init}});
    }

    /// Nodes 0 to `edges`, `released` of the edges released; sent from node `from` on.
    void send(int edges, int released, int from = 0) {
        fleet::OrderMessage order;
        order.order_id = "leg";
        order.order_update_id = update++;
        for (int i = from; i <= edges; ++i) {
            fleet::OrderNode node;
            node.node_id = "n" + std::to_string(i);
            node.sequence_id = 2 * i;
            node.released = i <= released;
            node.pose = kBegin * Pose2{kEdge_m * i, 0, 0};
            node.map_id = "hall";
            if (corridor)
                node.allowed_deviation_xy_m = std::max(corridor->left_m, corridor->right_m);
            order.nodes.push_back(node);
            if (i == from) continue;
            fleet::OrderEdge edge;
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
        look_out.put(boxes.back());
    }
    void take_away() {
        boxes.clear();
        look_out.take_away();
    }
    void cancel() {
        fleet::Action action;
        action.type = "cancelOrder";
        action.id = "cancel";
        executor.handle(fleet::InstantActionsMessage{{action}});
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
    fleet::StateMessage state() const {
        fleet::StateMessage now;
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
    plant::Vehicle vehicle;
    simulation::ServoDrive drive{type, kBegin, 7};
    LookOut look_out{world, vehicle, plant::HallId("hall"), drive, 3};
    NoSensing sensing;
    simulation::VehicleExecutor executor{drive, sensing, "hall"};
    GoingRound going_round{type, false, drive, look_out, executor};
    std::vector<Polygon> boxes;
    int update = 0;
    double base_end_m = 0;
    double farthest_beside_m = 0;
    std::int64_t last_passed = 0;

private:
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
    rig.cancel();
    ASSERT_TRUE(rig.run(20, [&] { return rig.drive.idle(); }));
    rig.run(10);
    EXPECT_TRUE(rig.state().node_states.empty());
    EXPECT_TRUE(rig.told("going_round").empty());
    EXPECT_GT(std::abs(rig.drive.true_pose().y_m - kBegin.y_m), 0.4);
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
}  // namespace pulseline::agent
