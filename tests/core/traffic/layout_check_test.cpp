#include "core/traffic/layout_check.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <set>

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

std::int64_t count(const Reason& reason) {
    for (const auto& param : reason.params) {
        if (param.name == "count") return std::get<std::int64_t>(param.value);
    }
    return 0;
}

TEST(LayoutCheck, BaysBesideALaneAreWellFormed) {
    const Floor floor({"r r r", "....."});
    EXPECT_TRUE(check(floor, {floor.place(1, 1), floor.place(4, 1)}, 3).empty());
}

TEST(LayoutCheck, NamesTheRestingPlaceInTheWay) {
    const Floor floor({"..r..r"});
    const auto found = check(floor, {floor.place(0, 0)}, 2);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].reason.code, "unreachable");
    EXPECT_EQ(text(found[0].reason, "crossing"), std::to_string(floor.place(2, 0)));
    // From (5, 0) to the goal and back; the rest in the middle can leave to both sides.
    EXPECT_EQ(count(found[0].reason), 2);
}

TEST(LayoutCheck, NamesARestingPlaceFarFromTheGoal) {
    const Floor floor({"r.r....."});
    const auto found = check(floor, {floor.place(7, 0)}, 2);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(text(found[0].reason, "crossing"), std::to_string(floor.place(2, 0)));
}

TEST(LayoutCheck, TellsEachRestingPlaceInTheWayOnce) {
    const Floor floor({"rrrr", ".  ."});  // rests in a row, goals below both ends
    const auto found = check(floor, {floor.place(0, 1), floor.place(3, 1)}, 4);
    std::set<std::string> crossings;
    std::int64_t pairs = 0;
    for (const auto& violation : found) {
        EXPECT_TRUE(crossings.insert(text(violation.reason, "crossing")).second);
        pairs += count(violation.reason);
    }
    EXPECT_EQ(crossings.size(), 4u);
    EXPECT_GT(pairs, 4);
}

/// A lane of resting places, each of which is in the way of all that drive past it.
MoveGraph lane_of_rests(PlaceIndex places) {
    MoveGraph graph;
    for (PlaceIndex p = 0; p < places; ++p) {
        graph.places.push_back({TileSet{static_cast<TileId>(p)}, true});
        for (const PlaceIndex next : {p - 1, p + 1}) {
            if (next >= places) continue;  // before the first too
            Move move;
            move.from = p;
            move.to = next;
            move.duration_s = 1;
            graph.moves.push_back(std::move(move));
        }
    }
    return graph;
}

TEST(LayoutCheck, TakesSecondsWhereThousandsOfPlacesAreInEachOthersWay) {
    const PlaceIndex places = 3000;
    const MoveGraph graph = lane_of_rests(places);
    const auto begin = std::chrono::steady_clock::now();

    const auto found = check_layout({{"small", &graph, {}, 2, {}}});

    EXPECT_EQ(found.size(), places - 2U) << "the two at the ends are in nobody's way";
    std::int64_t pairs = 0;
    for (const auto& violation : found) pairs += count(violation.reason);
    EXPECT_EQ(pairs, std::int64_t{places} * (places - 1) - 2 * (places - 1));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
}

TEST(LayoutCheck, TheOnlyVehicleOfAClassIsNotInItsOwnWay) {
    const Floor floor({"..r..r"});
    EXPECT_TRUE(check(floor, {floor.place(0, 0)}, 1).empty());
}

TEST(LayoutCheck, AClassWithoutVehiclesIsInNobodysWay) {
    const Floor floor({"..r..r"});
    MoveGraph small = floor.graph;
    small.places[floor.place(2, 0)].resting = false;
    const std::vector<PlaceIndex> goal{floor.place(0, 0)};
    EXPECT_TRUE(check_layout({{"a", &small, goal, 1, {}}, {"b", &floor.graph, {}, 0, {}}}).empty());
    const auto found = check_layout({{"a", &small, goal, 1, {}}, {"b", &floor.graph, {}, 1, {}}});
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(text(found[0].reason, "crossing"), std::to_string(floor.place(2, 0)));
}

TEST(LayoutCheck, AVehicleMayTurnWhereItArrives) {
    const Floor floor({"r r", "..."});
    const PlaceIndex rest = floor.place(2, 0);
    MoveGraph graph = floor.graph;
    const auto other_heading = static_cast<PlaceIndex>(graph.places.size());
    graph.places.push_back({graph.places[rest].stand, false});
    for (Move& move : graph.moves) {
        if (move.to == rest) move.to = other_heading;
        if (move.from == rest) move.from = other_heading;
    }
    graph.moves.push_back({other_heading, rest, graph.places[rest].stand, kMove_s});
    graph.moves.push_back({rest, other_heading, graph.places[rest].stand, kMove_s});
    EXPECT_TRUE(check_layout({{"small", &graph, {}, 2, {}}}).empty());
}

TEST(LayoutCheck, NamesNoRestingPlaceWhereNoWayLeads) {
    const Floor floor({"r ."});
    const auto found = check(floor, {floor.place(2, 0)}, 1);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(text(found[0].reason, "crossing"), "");
    EXPECT_EQ(count(found[0].reason), 2);
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
