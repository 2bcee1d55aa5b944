#include <gtest/gtest.h>

#include <cmath>

#include "core/kinematics/primitives.hpp"
#include "core/planning/legs/leg_planner.hpp"
#include "core/planning/roads/code_reach.hpp"
#include "core/planning/roads/roadmap_index.hpp"
#include "core/planning/roads/what_if.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;

constexpr double kLane_m = 20;

/// Two ways round a block from station 1 to station 2, both with two turns: the southern one is a
/// little longer and has codes every 4 m.
class AccuracyCost : public testing::Test {
protected:
    static constexpr double kNorth_m = 4;
    static constexpr double kSouth_m = 4.5;

    AccuracyCost() {
        plant::Hall hall;
        hall.id = hall_;
        hall.outline = {{-10, -10}, {kLane_m + 10, -10}, {kLane_m + 10, 10}, {-10, 10}};
        plant_.halls.push_back(hall);
        for (const auto& [id, at] :
             std::initializer_list<std::pair<const char*, Point2>>{{"a", {0, 0}},
                                                                   {"b", {kLane_m, 0}},
                                                                   {"an", {0, kNorth_m}},
                                                                   {"bn", {kLane_m, kNorth_m}},
                                                                   {"as", {0, -kSouth_m}},
                                                                   {"bs", {kLane_m, -kSouth_m}}}) {
            plant_.nodes.push_back({plant::NodeId(id), hall_, at});
        }
        for (const auto& [from, to] : std::initializer_list<std::pair<const char*, const char*>>{
                 {"a", "an"}, {"an", "bn"}, {"bn", "b"}, {"a", "as"}, {"as", "bs"}, {"bs", "b"}}) {
            plant_.edges.push_back({plant::EdgeId(std::string(from) + "." + to),
                                    plant::NodeId(from),
                                    plant::NodeId(to),
                                    0,
                                    {}});
        }
        station(1, "a", {0, 0, kPi / 2});
        station(2, "b", {kLane_m, 0, kPi / 2});
        plant_.areas.push_back({plant::AreaId("block"),
                                plant::AreaKind::kObstacle,
                                "block",
                                hall_,
                                {{2, -2.5}, {kLane_m - 2, -2.5}, {kLane_m - 2, 2}, {2, 2}},
                                {}});
        plant::VehicleType type;
        type.id = plant::VehicleTypeId("cart");
        type.footprint = geometry::rectangle(1.2, 0.8);
        type.clearance_m = 0.2;
        type.motion_modes = {plant::MotionMode::kLinear};
        type.cameras.emplace_back();
        plant_.vehicle_types.push_back(type);
        for (double x_m = 2; x_m < kLane_m; x_m += 4) code({x_m, -kSouth_m});
    }

    void station(int number, const char* node, geometry::Pose2 pose) {
        plant::Station station;
        station.id = plant::StationId("st" + std::to_string(number));
        station.number = number;
        station.hall = hall_;
        station.pose = pose;
        station.node = plant::NodeId(node);
        plant_.stations.push_back(station);
    }

    void code(Point2 at) {
        plant::Marker marker;
        marker.id = plant::MarkerId("code-" + std::to_string(plant_.markers.size()));
        marker.payload = marker.id.str();
        marker.size_m = 0.05;
        marker.hall = hall_;
        marker.pose = {at.x_m, at.y_m, 0};
        plant_.markers.push_back(marker);
    }

    double sigma_m(Point2 from, Point2 to) const {
        std::vector<kinematics::Segment> lane;
        const Point2 way = to - from;
        kinematics::append_straight(lane, {from.x_m, from.y_m, std::atan2(way.y_m, way.x_m)}, to);
        return CodeReach(plant_.vehicle_types.front(), false)
            .mean_sigma_m(plant_, hall_, lane.front());
    }

    LegRequest request() const {
        LegRequest request;
        request.type = &plant_.vehicle_types.front();
        request.hall = hall_;
        request.start = plant_.stations[0].pose;
        request.from_station = plant_.stations[0].id;
        request.target = plant_.stations[1].id;
        return request;
    }

    std::string second_node(const LegPlan& plan) const { return plan.route.at(1).str(); }

    const plant::HallId hall_{"hall"};
    plant::Plant plant_;
};

TEST_F(AccuracyCost, ALaneWithoutCodesLeavesMoreUnknown) {
    const double without_m = sigma_m({0, kNorth_m}, {kLane_m, kNorth_m});
    const double with_m = sigma_m({0, -kSouth_m}, {kLane_m, -kSouth_m});

    EXPECT_GT(without_m, 2 * with_m);
    EXPECT_GT(with_m, 0);
    EXPECT_GT(without_m, sigma_m({0, kNorth_m}, {kLane_m / 2, kNorth_m})) << "half as long";
}

TEST_F(AccuracyCost, WithoutSensesOrAnythingForThemAllLanesAreAlike) {
    plant_.vehicle_types.front().cameras.clear();
    EXPECT_EQ(sigma_m({0, kNorth_m}, {kLane_m, kNorth_m}), 0);

    plant_.vehicle_types.front().cameras.emplace_back();
    plant_.markers.clear();
    EXPECT_EQ(sigma_m({0, kNorth_m}, {kLane_m, kNorth_m}), 0);
}

TEST_F(AccuracyCost, AsLongAsThePlantSaysNothingTheShorterWayIsTaken) {
    const auto plan = LegPlanner(plant_).plan_leg(request()).value();

    EXPECT_EQ(second_node(plan), "an");
    EXPECT_EQ(plan.accuracy, 0);
}

TEST_F(AccuracyCost, TheWayPastCodesIsTakenAndWhyNotTheOtherIsSaid) {
    plant_.routing.accuracy_k = 1000;
    LegPlanner planner(plant_);

    const auto plan = planner.plan_leg(request()).value();
    EXPECT_EQ(second_node(plan), "as");
    EXPECT_GT(plan.accuracy, 0);
    const auto others = planner.alternatives(request(), plan, 1, {});
    ASSERT_EQ(others.size(), 1u);
    EXPECT_EQ(second_node(others[0].plan), "an");
    EXPECT_LT(others[0].more_length, 0) << "it is shorter";
    EXPECT_GT(others[0].more_accuracy, 0);
    EXPECT_NEAR(others[0].more_cost,
                others[0].more_length + others[0].more_turns + others[0].more_accuracy, 1e-9);
    EXPECT_EQ(others[0].main_reason, LegAlternative::Reason::kAccuracy);
}

TEST_F(AccuracyCost, ARouteSaysWhatItCostsLaneByLane) {
    plant_.routing.accuracy_k = 1000;
    WhatIf question;
    question.vehicle_type = plant_.vehicle_types.front().id;
    question.from = 1;
    question.to = 2;

    const auto answer = what_if(plant_, question).value();

    ASSERT_EQ(answer.routes.size(), 2u);
    ASSERT_EQ(answer.routes[0].legs.size(), 3u);
    const auto& lane = answer.routes[0].legs[1];
    EXPECT_EQ(lane.edge.str(), "as.bs");
    const double sigma = sigma_m({0, -kSouth_m}, {kLane_m, -kSouth_m});
    EXPECT_NEAR(static_cast<double>(lane.cost.accuracy), 1000 * sigma * kLane_m * kCostUnit, 1);
    ASSERT_EQ(answer.differences.size(), 1u);
    EXPECT_EQ(answer.differences[0].main_reason(), RouteDifference::Reason::kAccuracy);
    EXPECT_NEAR(answer.routes[0].cost,
                LegPlanner(plant_).plan_leg(request()).value().cost * kCostUnit, 3)
        << "the same for legs and routes, but for rounding lane by lane";
}

}  // namespace
}  // namespace pulseline::planning
