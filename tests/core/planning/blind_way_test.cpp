#include "core/planning/legs/blind_way.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "tests/core/planning/leg_world.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;
using plant::MotionMode;

/// Stations 1 and 3, 40 m apart with free floor between them, and lanes a-g-e that lead there by 45
/// m, with codes every 9 m.
class BlindWayTest : public testing::Test {
protected:
    BlindWayTest() {
        auto& plant = world.plant();
        plant.edges.clear();
        plant.nodes.push_back({plant::NodeId("g"), plant::HallId("hall"), {10, 30}});
        lane("a", {20, 10}, "g", {10, 30});
        lane("g", {10, 30}, "e", {20, 50});
        for (auto& type : plant.vehicle_types) {
            type.cameras = {plant::Camera{}};
            type.cameras.front().name = "down";
        }
        for (auto& station : plant.stations) {
            const auto id = code(station.pose.position());
            station.markers = {id};
        }
    }

    plant::MarkerId code(Point2 at) {
        auto& markers = world.plant().markers;
        plant::Marker marker;
        marker.id = plant::MarkerId("code-" + std::to_string(markers.size()));
        marker.payload = marker.id.str();
        marker.size_m = 0.05;
        marker.hall = plant::HallId("hall");
        marker.pose = {at.x_m, at.y_m, 0};
        markers.push_back(marker);
        return marker.id;
    }

    void codes_on_lanes(double every_m) {
        for (const auto& [from, to] : lanes) {
            const double length_m = distance(from, to);
            for (double at_m = every_m / 2; at_m < length_m; at_m += every_m)
                code(from + at_m / length_m * (to - from));
        }
    }

    LegPlan plan(MotionMode mode = MotionMode::kAuto) {
        const LegPlanner planner(world.plant());
        auto request = world.request("tug", 1, 3);
        request.mode = mode;
        return planner.plan_leg(request).value();
    }

    LegWorld world{8};
    std::vector<std::pair<Point2, Point2>> lanes;

private:
    void lane(const char* a, Point2 at_a, const char* b, Point2 at_b) {
        auto& edges = world.plant().edges;
        const std::string name = std::string(a) + "-" + b;
        edges.push_back({plant::EdgeId(name), plant::NodeId(a), plant::NodeId(b), 0, {}});
        edges.push_back({plant::EdgeId(name + "-back"), plant::NodeId(b), plant::NodeId(a), 0, {}});
        lanes.push_back({at_a, at_b});
    }
};

TEST_F(BlindWayTest, LanesWithCodesAreTakenInsteadOfFreeFloorOnWhichItLosesItself) {
    codes_on_lanes(9);
    for (const MotionMode mode : {MotionMode::kAuto, MotionMode::kLinear}) {
        const LegPlan taken = plan(mode);
        EXPECT_EQ(taken.route.size(), 3u);
        EXPECT_FALSE(taken.blind.loses_itself());
        EXPECT_NEAR(taken.blind.way_m, 13.3, 0.2) << "round the bend";
    }
}

TEST_F(BlindWayTest, WithoutCodesOnTheLanesTheShortWayIsTaken) {
    const LegPlan taken = plan();
    EXPECT_TRUE(taken.route.empty());
    EXPECT_TRUE(taken.blind.loses_itself());
    EXPECT_NEAR(taken.blind.way_m, 40, 0.1);
    EXPECT_LT(taken.blind.at_most_m, 40);
}

TEST_F(BlindWayTest, OneCodeHalfWayOnTheFreeFloorMakesItSure) {
    codes_on_lanes(9);
    code({20, 30});
    const LegPlan taken = plan();
    EXPECT_TRUE(taken.route.empty());
    EXPECT_FALSE(taken.blind.loses_itself());
    EXPECT_NEAR(taken.blind.way_m, 20, 0.1);
}

TEST_F(BlindWayTest, ThereIsNothingToMissWithoutCamerasOrWithoutCodes) {
    auto& plant = world.plant();
    for (auto& type : plant.vehicle_types) type.cameras.clear();
    EXPECT_EQ(plan().blind.way_m, 0);
    EXPECT_FALSE(plan().blind.loses_itself());
    for (auto& type : plant.vehicle_types) type.cameras = {plant::Camera{}};
    plant.markers.clear();
    for (auto& station : plant.stations) station.markers.clear();
    EXPECT_FALSE(plan().blind.loses_itself());
}

/// A place to rest at has no code: what comes after the last one is nobody's to miss.
TEST_F(BlindWayTest, APlaceWithoutCodesIsNotMissed) {
    for (auto& station : world.plant().stations) station.markers.clear();
    world.plant().markers.clear();
    codes_on_lanes(9);
    const LegPlan taken = plan();
    EXPECT_TRUE(taken.route.empty());
    EXPECT_FALSE(taken.blind.loses_itself());
}

TEST_F(BlindWayTest, AmongReflectorsItKnowsItsWayWithoutCodes) {
    codes_on_lanes(9);
    auto& plant = world.plant();
    for (auto& type : plant.vehicle_types) type.navigation_scanner = plant::NavigationScanner{};
    const auto reflect = [&](std::initializer_list<Point2> places) {
        for (const Point2 at : places) {
            plant::Reflector one;
            one.id = plant::ReflectorId("r" + std::to_string(plant.reflectors.size()));
            one.hall = plant::HallId("hall");
            one.position = at;
            plant.reflectors.push_back(one);
        }
    };
    reflect({{15, 25}, {27, 33}});
    EXPECT_FALSE(plan().route.empty()) << "one of two is easily hidden";
    reflect({{14, 41}});
    const LegPlan taken = plan();
    EXPECT_TRUE(taken.route.empty());
    EXPECT_FALSE(taken.blind.loses_itself());
}

TEST_F(BlindWayTest, OverClosedFloorNobodyIsLedForTheSakeOfCodes) {
    codes_on_lanes(9);
    LegPlanner planner(world.plant());
    planner.set_closures(
        {{"c1", "spill", plant::HallId("hall"), {{{9, 29}, {11, 29}, {11, 31}, {9, 31}}}, 0}});
    const LegPlan taken = planner.plan_leg(world.request("tug", 1, 3)).value();
    EXPECT_TRUE(taken.closures.empty());
    EXPECT_TRUE(taken.route.empty());
    EXPECT_TRUE(taken.blind.loses_itself());
}

}  // namespace
}  // namespace pulseline::planning
