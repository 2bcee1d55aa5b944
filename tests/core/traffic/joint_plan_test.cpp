#include "core/traffic/joint_plan.hpp"

#include <gtest/gtest.h>

namespace pulseline::traffic {
namespace {

PlannedMove move(TileIndexes swept, TileIndexes stand, double start_s, double end_s) {
    PlannedMove m;
    m.shape = make_shape(std::move(swept), {}, std::move(stand));
    m.start_s = start_s;
    m.end_s = end_s;
    m.duration_s = end_s - start_s;
    return m;
}

// Two vehicles at the ends of the tiles 0 - 1 - 2, with bays 10 and 12 beside the ends.
class TwoOnALine : public ::testing::Test {
protected:
    TwoOnALine() {
        a = joint.add_vehicle({0}, kNoPlace, 0);
        b = joint.add_vehicle({2}, kNoPlace, 0);
    }
    JointPlan joint;
    VehicleIndex a = 0;
    VehicleIndex b = 0;
};

TEST_F(TwoOnALine, AMoveIsGrantedOnlyInTheOrderOfItsTiles) {
    joint.replace(a, {move({0, 1}, {1}, 0, 5), move({1, 11}, {11}, 5, 10)}, Placement::kByTime);
    joint.replace(b, {move({1, 2}, {1}, 20, 25), move({1, 13}, {13}, 25, 30)}, Placement::kByTime);

    EXPECT_FALSE(joint.obstacle(a, 1));
    EXPECT_EQ(joint.obstacle(b, 1), TileIndex{1}) << "the tile is free, but a comes first";
    ASSERT_EQ(joint.plan(b).at(1).waits_for, (std::vector<MoveRef>{{a, 2}}));

    joint.set_released(a, 2, 0);
    joint.pass(a, 1, 5);
    EXPECT_EQ(joint.holder(0), std::nullopt) << "the tail has left";
    EXPECT_EQ(joint.holder(1), a);
    EXPECT_TRUE(joint.obstacle(b, 1));
    joint.pass(a, 2, 10);
    EXPECT_FALSE(joint.obstacle(b, 1));
}

TEST_F(TwoOnALine, FacingPlansCloseACycleAndAreUndone) {
    joint.replace(a, {move({0, 1}, {1}, 0, 5), move({1, 2}, {2}, 5, 10)}, Placement::kByTime);
    ASSERT_TRUE(joint.predict(0));
    const auto before = joint.queue(1);

    // b wants to the place of a, which wants to the place of b.
    auto undo =
        joint.replace(b, {move({1, 2}, {1}, 0, 5), move({0, 1}, {0}, 5, 10)}, Placement::kFirst);

    EXPECT_FALSE(joint.times_agree(undo));
    EXPECT_FALSE(joint.predict_before(b, 0));
    joint.undo(std::move(undo));
    EXPECT_TRUE(joint.predict(0));
    EXPECT_EQ(joint.queue(1), before);
    EXPECT_EQ(joint.plan(b).last(), 0u);
}

TEST_F(TwoOnALine, PredictionsFollowTheOrderAndHaltedVehiclesBlock) {
    joint.replace(a, {move({0, 1}, {1}, 0, 5), move({1, 11}, {11}, 5, 10)}, Placement::kByTime);
    joint.replace(b, {move({1, 2}, {1}, 20, 25), move({1, 13}, {13}, 25, 30)}, Placement::kByTime);

    ASSERT_TRUE(joint.predict(0));
    EXPECT_DOUBLE_EQ(joint.plan(b).at(1).start_s, 10) << "as soon as a is out";
    ASSERT_TRUE(joint.predict(100));
    EXPECT_DOUBLE_EQ(joint.finish_s(b), 120) << "nobody has moved so far";

    joint.set_halted(a, true, 100);
    ASSERT_TRUE(joint.predict(100));
    EXPECT_GT(joint.finish_s(b), kBlocked_s);
}

TEST_F(TwoOnALine, ALateMoveIsExpectedToBeAsLateAgain) {
    joint.replace(a, {move({0, 1}, {1}, 0, 5)}, Placement::kByTime);
    joint.set_released(a, 1, 0);
    ASSERT_TRUE(joint.predict(3));
    EXPECT_DOUBLE_EQ(joint.finish_s(a), 5);
    ASSERT_TRUE(joint.predict(65));
    EXPECT_DOUBLE_EQ(joint.finish_s(a), 125);
}

TEST_F(TwoOnALine, ANewPlanKeepsTheBase) {
    joint.replace(a, {move({0, 1}, {1}, 0, 5), move({1, 11}, {11}, 5, 10)}, Placement::kByTime);
    joint.set_released(a, 1, 0);

    joint.replace(a, {move({1, 14}, {14}, 5, 10)}, Placement::kByTime);

    EXPECT_EQ(joint.plan(a).released, 1u);
    EXPECT_EQ(joint.held_tiles(a), (TileIndexes{0, 1}));
    EXPECT_EQ(joint.plan(a).last(), 2u);
    EXPECT_TRUE(joint.queue(11).empty());
    EXPECT_EQ(joint.queue(14).size(), 1u);
}

TEST_F(TwoOnALine, ClosedFloorMayBeLeftButNotEntered) {
    joint.replace(a, {move({0, 1}, {1}, 0, 5), move({1, 11}, {11}, 5, 10)}, Placement::kByTime);
    joint.close({1});
    EXPECT_EQ(joint.obstacle(a, 1), TileIndex{1});
    joint.open({1});
    EXPECT_FALSE(joint.obstacle(a, 1));
    joint.set_released(a, 1, 0);
    joint.pass(a, 1, 5);
    joint.close({1, 11});
    EXPECT_FALSE(joint.obstacle(a, 2)) << "it stands on closed floor and may leave";
}

}  // namespace
}  // namespace pulseline::traffic
