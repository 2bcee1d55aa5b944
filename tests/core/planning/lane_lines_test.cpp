#include "core/planning/roads/lane_lines.hpp"

#include <gtest/gtest.h>

#include "core/kinematics/primitives.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;
using plant::Corridor;

/// Lanes a -> b -> c along y = 5 m, b -> a against them.
plant::Plant lanes(std::optional<Corridor> ab, std::optional<Corridor> bc,
                   std::optional<Corridor> ba) {
    plant::Plant plant;
    const plant::HallId hall("h");
    plant.nodes = {{plant::NodeId("a"), hall, {0, 5}},
                   {plant::NodeId("b"), hall, {10, 5}},
                   {plant::NodeId("c"), hall, {20, 5}}};
    const auto add = [&](const char* from, const char* to, std::optional<Corridor> corridor) {
        plant::RoadmapEdge edge;
        edge.id = plant::EdgeId(std::string(from) + to);
        edge.from = plant::NodeId(from);
        edge.to = plant::NodeId(to);
        edge.corridor = corridor;
        plant.edges.push_back(edge);
    };
    add("a", "b", ab);
    add("b", "c", bc);
    add("b", "a", ba);
    return plant;
}

std::optional<Corridor> along(const plant::Plant& plant, Point2 from, Point2 to,
                              double body_rad = 0) {
    const Point2 way = to - from;
    std::vector<kinematics::Segment> line;
    kinematics::append_straight(
        line, {from.x_m, from.y_m, wrap(std::atan2(way.y_m, way.x_m) + body_rad)}, to);
    return LaneLines(plant).along(plant::HallId("h"), line.at(0)).corridor;
}

TEST(LaneLines, CorridorsAreThoseOfTheLaneThatIsDrivenAlong) {
    const auto plant = lanes(Corridor{1, 2}, std::nullopt, Corridor{3, 4});
    EXPECT_EQ(along(plant, {0, 5}, {4, 5}), (Corridor{1, 2}));
    EXPECT_EQ(along(plant, {4, 5.03}, {9, 4.98}), (Corridor{1, 2})) << "beside it by measuring";
    EXPECT_EQ(along(plant, {9, 5}, {4, 5}), (Corridor{3, 4})) << "left is left of the way";
    EXPECT_EQ(along(plant, {4, 5}, {8, 5}, kPi), (Corridor{1, 2})) << "driven backwards";
}

TEST(LaneLines, TheNarrowestCorridorCountsOverSeveralLanes) {
    const auto plant = lanes(Corridor{1, 2}, Corridor{2, 1}, std::nullopt);
    EXPECT_EQ(along(plant, {8, 5}, {12, 5}), (Corridor{1, 1}));
    EXPECT_EQ(along(plant, {12, 5}, {16, 5}), (Corridor{2, 1}));
}

TEST(LaneLines, ThereIsNoCorridorWhereNotAllOfTheWayHasOne) {
    const auto plant = lanes(Corridor{1, 2}, std::nullopt, std::nullopt);
    EXPECT_FALSE(along(plant, {8, 5}, {12, 5})) << "out at its end";
    EXPECT_FALSE(along(plant, {-2, 5}, {2, 5})) << "not yet on it";
    EXPECT_FALSE(along(plant, {9, 5}, {4, 5})) << "against it";
    EXPECT_FALSE(along(plant, {4, 5}, {4, 9})) << "across it";
    EXPECT_FALSE(along(plant, {4, 5.2}, {8, 5.2})) << "beside it";
}

TEST(LaneLines, TheSlowestLaneThatAWayTouchesLimitsIt) {
    auto plant = lanes(std::nullopt, std::nullopt, std::nullopt);
    plant.edges[0].max_speed_mps = 0.5;
    plant.edges[1].max_speed_mps = 0.2;
    const LaneLines lines(plant);
    const auto speed = [&](double from_m, double to_m) {
        std::vector<kinematics::Segment> line;
        kinematics::append_straight(line, {from_m, 5, from_m < to_m ? 0 : kPi}, {to_m, 5});
        return lines.along(plant::HallId("h"), line.at(0)).max_speed_mps;
    };
    EXPECT_EQ(speed(0, 9), 0.5);
    EXPECT_EQ(speed(-3, 9), 0.5);
    EXPECT_EQ(speed(6, 11), 0.2);
    EXPECT_EQ(speed(9, 0), 0) << "against it";
}

}  // namespace
}  // namespace pulseline::planning
