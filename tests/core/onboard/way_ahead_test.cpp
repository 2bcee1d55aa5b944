#include "core/onboard/way_ahead.hpp"

#include <gtest/gtest.h>

#include "tests/core/simulation/platform.hpp"

namespace pulseline::onboard {
namespace {

using namespace simulation;

using simulation::testing::exact;
using simulation::testing::platform_type;
using simulation::testing::straight;
using simulation::testing::turn;

constexpr double kStep_s = 0.05;

class WayAheadTest : public ::testing::Test {
protected:
    /// An edge of 2 m along x with a corridor, and the node at its end.
    void add(bool released = true) {
        vda5050::OrderEdge edge;
        vda5050::OrderNode node;
        const auto number = static_cast<double>(way.edges().size());
        edge.released = node.released = released;
        edge.segment = straight({2 * number, 0, 0}, 2);
        edge.corridor = plant::Corridor{4, 3};
        node.allowed_deviation_xy_m = 4;
        node.sequence_id = 2 * (static_cast<std::int64_t>(number) + 1);
        node.pose = edge.segment.end;
        way.append(edge, node);
    }
    void run(double seconds) {
        for (double t = 0; t < seconds; t += kStep_s) {
            way.hand_over();
            drive.step(kStep_s);
            for (const auto& hop : way.take_passed()) {
                passed.push_back(hop.node.sequence_id);
                passed_at_m.push_back(drive.believed_pose().x_m);
            }
            most_left_m = std::max(most_left_m, drive.believed_pose().y_m);
            farthest_since_m = std::max(farthest_since_m, way.distance_since_last_node_m());
        }
    }
    /// 1.5 m aside from where it stands, past the first two nodes, and back at the end of the third
    /// edge.
    planning::Detour aside() const {
        const Pose2 from = drive.believed_pose();
        planning::Detour detour;
        const double shift_m = 1.5 - from.y_m;
        detour.pieces.push_back({straight(from, shift_m, kPi / 2), 0});
        const Pose2 out = detour.pieces.back().segment.end;
        detour.pieces.push_back({straight(out, 4.2 - out.x_m), 2});
        detour.pieces.push_back({straight({4.2, 1.5, 0}, 1.8), 0});
        detour.pieces.push_back({straight({6, 1.5, 0}, 1.5, -kPi / 2), 1});
        detour.edges = 3;
        return detour;
    }

    VehicleMotion drive{platform_type(), {}, 1, 1, exact()};
    WayAhead way{drive};
    std::vector<std::int64_t> passed;
    std::vector<double> passed_at_m;
    double most_left_m = 0;
    double farthest_since_m = 0;
};

TEST_F(WayAheadTest, TheStretchIsTheReleasedEdgesOnOneLine) {
    add();
    add();
    add(false);
    EXPECT_EQ(way.stretch(false).size(), 2u);
    EXPECT_EQ(way.stretch(true).size(), 3u);
    EXPECT_EQ(way.stretch(false)[1].corridor, (plant::Corridor{4, 3}));
    EXPECT_EQ(way.stretch(false)[1].end.x_m, 4);
}

TEST_F(WayAheadTest, TheStretchEndsAtABendAtATurnAtANodeWithActionsAndWithTheCorridor) {
    add();
    vda5050::OrderEdge other;
    other.released = true;
    other.corridor = plant::Corridor{4, 3};
    vda5050::OrderNode node;
    node.released = true;
    node.allowed_deviation_xy_m = 4;

    other.segment = straight({2, 0, 0}, 2, kPi / 2);
    way.append(other, node);
    EXPECT_EQ(way.stretch(false).size(), 1u) << "a bend";
    way.clear();

    add();
    other.segment = turn({2, 0, 0}, 1);
    way.append(other, node);
    EXPECT_EQ(way.stretch(false).size(), 1u) << "a turn";
    way.clear();

    other.segment = straight({0, 0, 0}, 2);
    node.actions.push_back({"measureStop", "a", vda5050::BlockingType::kHard, {}, {}, {}});
    way.append(other, node);
    add();
    EXPECT_EQ(way.stretch(false).size(), 1u) << "a node with actions";
    way.clear();

    node.actions.clear();
    node.allowed_deviation_xy_m = 1;
    way.append(other, node);
    add();
    EXPECT_EQ(way.stretch(false).size(), 1u) << "a node that is not to be passed so far beside it";
    way.clear();

    other.corridor.reset();
    way.append(other, node);
    EXPECT_TRUE(way.stretch(false).empty()) << "no corridor";
}

TEST_F(WayAheadTest, ADetourPassesItsNodesAndTheEdgesBehindItFollow) {
    for (int i = 0; i < 5; ++i) add();
    run(3);
    drive.hold();
    run(10);
    const double stood_m = drive.believed_pose().x_m;
    ASSERT_GT(stood_m, 0.1);
    ASSERT_LT(stood_m, 2);
    way.go_round(aside());
    drive.release();
    EXPECT_TRUE(way.going_round());
    EXPECT_NEAR(way.distance_since_last_node_m(), stood_m, 1e-6);
    run(120);
    EXPECT_EQ(passed, (std::vector<std::int64_t>{2, 4, 6, 8, 10}));
    EXPECT_NEAR(passed_at_m[0], 4.2, 0.05);
    EXPECT_NEAR(passed_at_m[2], 6, 1e-3);
    EXPECT_FALSE(way.going_round());
    EXPECT_TRUE(way.empty());
    EXPECT_NEAR(most_left_m, 1.5, 1e-6);
    EXPECT_LT(distance(drive.believed_pose().position(), {10, 0}), 1e-6);
    EXPECT_LE(farthest_since_m, 2.001) << "along the edge, never more than it is long";
}

TEST_F(WayAheadTest, AnotherDetourMayReplaceTheFirst) {
    for (int i = 0; i < 4; ++i) add();
    run(3);
    drive.hold();
    run(10);
    way.go_round(aside());
    drive.release();
    run(4);
    drive.hold();
    run(10);
    ASSERT_GT(drive.believed_pose().y_m, 0.1);
    way.go_round(aside());
    drive.release();
    run(120);
    EXPECT_EQ(passed, (std::vector<std::int64_t>{2, 4, 6, 8}));
    EXPECT_TRUE(way.empty());
}

TEST_F(WayAheadTest, ADetourThatEndsWithTheBaseWaitsForMore) {
    for (int i = 0; i < 4; ++i) add(i < 3);
    way.go_round(aside());
    run(120);
    EXPECT_EQ(passed, (std::vector<std::int64_t>{2, 4, 6}));
    EXPECT_NEAR(drive.believed_pose().x_m, 6, 1e-6);
    EXPECT_TRUE(way.has_horizon());
    EXPECT_TRUE(way.base_handed_over());
}

TEST_F(WayAheadTest, ClearedOnADetourItHasNothingAhead) {
    for (int i = 0; i < 4; ++i) add();
    way.go_round(aside());
    run(3);
    drive.hold();
    run(10);
    way.clear();
    drive.release();
    run(10);
    EXPECT_TRUE(way.empty());
    EXPECT_FALSE(way.going_round());
    EXPECT_TRUE(passed.empty());
    EXPECT_TRUE(drive.idle());
}

}  // namespace
}  // namespace pulseline::onboard
