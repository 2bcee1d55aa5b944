#include "core/traffic/monitor.hpp"

#include <gtest/gtest.h>

namespace pulseline::traffic {
namespace {

using Kind = Change::Kind;

std::vector<std::string> laws(const std::vector<Violation>& violations) {
    std::vector<std::string> names;
    for (const auto& violation : violations) names.push_back(violation.law);
    return names;
}

using Laws = std::vector<std::string>;

class TwoVehicles : public ::testing::Test {
protected:
    TwoVehicles() {
        EXPECT_TRUE(
            monitor.apply({{Kind::kStand, 0, 0, {1}, {}}, {Kind::kStand, 1, 0, {3}, {}}}).empty());
    }
    static Change plan(VehicleIndex vehicle, MoveNumber base, std::vector<Change::PlanMove> moves) {
        return {Kind::kPlan, vehicle, base, {}, std::move(moves)};
    }
    Monitor monitor;
};

TEST_F(TwoVehicles, TwoHoldersOfATile) {
    EXPECT_TRUE(monitor.apply({plan(0, 0, {{1, {1, 2, 3}, {3}, {}}})}).empty());
    const auto found = monitor.apply({{Kind::kReleased, 0, 1, {}, {}}});
    ASSERT_EQ(laws(found), Laws{"two_holders"});
    EXPECT_EQ(found[0].tile, TileId{3});
    EXPECT_EQ(found[0].other, 1u);
    EXPECT_EQ(laws(monitor.check_all()).front(), "two_holders");
}

TEST_F(TwoVehicles, AFootprintOutsideItsFloor) {
    EXPECT_TRUE(monitor.check_footprint(0, {1}).empty());
    EXPECT_EQ(laws(monitor.check_footprint(0, {1, 2})), Laws{"footprint_outside"});
    EXPECT_EQ(monitor.check_footprint(0, {3})[0].other, 1u);
}

TEST_F(TwoVehicles, ACycleAtOnceAndInFull) {
    EXPECT_TRUE(
        monitor.apply({plan(0, 0, {{1, {1, 2}, {2}, {}}, {2, {2, 5}, {5}, {{1, 2}}}})}).empty());
    const auto found =
        monitor.apply({plan(1, 0, {{1, {3, 4}, {4}, {}}, {2, {4, 6}, {6}, {{0, 2}}}})});
    EXPECT_EQ(laws(found), Laws{"cycle"});
    EXPECT_EQ(laws(monitor.check_all()), Laws{"cycle"});
}

TEST_F(TwoVehicles, AGrantOutOfOrder) {
    EXPECT_TRUE(monitor
                    .apply({plan(0, 0, {{1, {1, 2}, {2}, {}}, {2, {2, 5}, {5}, {}}}),
                            plan(1, 0, {{1, {2, 3}, {2}, {{0, 2}}}, {2, {2, 6}, {6}, {}}})})
                    .empty());
    EXPECT_TRUE(monitor.check_all().empty());
    EXPECT_EQ(laws(monitor.apply({{Kind::kReleased, 1, 1, {}, {}}})), Laws{"granted_out_of_order"});
}

TEST_F(TwoVehicles, ATileWhoseOrderNobodySays) {
    EXPECT_TRUE(monitor
                    .apply({plan(0, 0, {{1, {1, 2}, {2}, {}}, {2, {2, 5}, {5}, {}}}),
                            plan(1, 0, {{1, {2, 3}, {2}, {}}, {2, {2, 6}, {6}, {}}})})
                    .empty());
    const auto found = monitor.check_all();
    ASSERT_EQ(laws(found), Laws{"order_missing"});
    EXPECT_EQ(found[0].tile, TileId{2});
}

TEST_F(TwoVehicles, ARestThatSomebodyHasToCross) {
    EXPECT_TRUE(monitor
                    .apply({plan(0, 0, {{1, {1, 2}, {2}, {}}}),
                            plan(1, 0, {{1, {2, 3}, {2}, {{0, kForever}}}, {2, {2, 6}, {6}, {}}})})
                    .empty());
    EXPECT_EQ(laws(monitor.check_all()).front(), "rest_crossed");
}

TEST_F(TwoVehicles, GrantsIntoClosedFloorAndToHaltedVehicles) {
    EXPECT_TRUE(monitor
                    .apply({plan(0, 0, {{1, {1, 2}, {2}, {}}, {2, {2, 5}, {5}, {}}}),
                            {Kind::kClosed, 0, 0, {2}, {}}})
                    .empty());
    EXPECT_EQ(laws(monitor.apply({{Kind::kReleased, 0, 1, {}, {}}})), Laws{"granted_closed"});
    EXPECT_TRUE(monitor.apply({{Kind::kPassed, 0, 1, {}, {}}}).empty());
    EXPECT_TRUE(
        monitor.apply({{Kind::kReopened, 0, 0, {2}, {}}, {Kind::kHalted, 0, 0, {}, {}}}).empty());
    EXPECT_EQ(laws(monitor.apply({{Kind::kReleased, 0, 2, {}, {}}})), Laws{"granted_halted"});
}

TEST_F(TwoVehicles, ABaseThatIsTakenBack) {
    EXPECT_TRUE(monitor
                    .apply({plan(0, 0, {{1, {1, 2}, {2}, {}}, {2, {2, 5}, {5}, {}}}),
                            {Kind::kReleased, 0, 2, {}, {}}})
                    .empty());
    EXPECT_EQ(laws(monitor.apply({plan(0, 1, {{2, {2, 7}, {7}, {}}})})), Laws{"base_changed"});
    EXPECT_EQ(laws(monitor.apply({{Kind::kPassed, 0, 2, {}, {}}})), Laws{"passed_ungranted"});
}

}  // namespace
}  // namespace pulseline::traffic
