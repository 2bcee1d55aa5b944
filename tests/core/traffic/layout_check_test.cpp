#include "core/traffic/layout_check.hpp"

#include <gtest/gtest.h>

#include "tests/core/traffic/traffic_floor.hpp"

namespace pulseline::traffic {
namespace {

std::vector<LayoutViolation> check(const Floor& floor, std::vector<PlaceIndex> goals,
                                   std::size_t vehicles) {
    return check_layout({{"small", &floor.graph, std::move(goals), vehicles, {}}});
}

std::string text(const Reason& reason, const std::string& name) {
    for (const auto& param : reason.params) {
        if (param.name == name) return std::get<std::string>(param.value);
    }
    return {};
}

TEST(LayoutCheck, BaysBesideALaneAreWellFormed) {
    const Floor floor({"r r r", "....."});
    EXPECT_TRUE(check(floor, {floor.place(1, 1), floor.place(4, 1)}, 3).empty());
}

TEST(LayoutCheck, NamesTheRestingPlaceInTheWay) {
    const Floor floor({"..r..r"});
    const auto found = check(floor, {floor.place(0, 0)}, 2);
    ASSERT_FALSE(found.empty());
    bool named = false;
    for (const auto& violation : found) {
        named |= violation.reason.code == "unreachable" &&
                 text(violation.reason, "from") == std::to_string(floor.place(5, 0)) &&
                 text(violation.reason, "to") == std::to_string(floor.place(0, 0));
    }
    EXPECT_TRUE(named);
}

TEST(LayoutCheck, CountsRestingPlaces) {
    const Floor floor({"r r", "..."});
    EXPECT_TRUE(check(floor, {}, 2).empty());
    const auto found = check(floor, {}, 3);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[0].reason.code, "too_few_resting_places");
}

TEST(LayoutCheck, RestingPlacesOnSharedFloorCountOnce) {
    const Floor floor({"r r", "..."});
    MoveGraph other = floor.graph;  // another class that rests on the same two tiles
    const auto found = check_layout({{"a", &floor.graph, {}, 1, {}}, {"b", &other, {}, 2, {}}});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].reason.code, "too_few_resting_places");
}

TEST(LayoutCheck, AGoalBesideARestMustBeReachableAroundIt) {
    // A long vehicle that has to sweep over a small one's bay.
    const std::vector<std::string> rows = {"......r"};
    const Floor floor(rows);
    MoveGraph platform = long_graph(floor, rows, 3);
    platform.places[0].resting = true;
    const auto last = static_cast<PlaceIndex>(platform.places.size() - 1);
    const auto found =
        check_layout({{"small", &floor.graph, {}, 1, {}}, {"platform", &platform, {last}, 1, {}}});
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(text(found[0].reason, "class"), "platform");
    EXPECT_EQ(text(found[0].reason, "crossing"), std::to_string(floor.place(6, 0)));
}

}  // namespace
}  // namespace pulseline::traffic
