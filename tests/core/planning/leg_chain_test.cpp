#include "core/planning/legs/leg_chain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/kinematics/primitives.hpp"
#include "core/localisation/codes_on_way.hpp"
#include "core/planning/legs/blind_way.hpp"
#include "core/planning/legs/route_chain.hpp"
#include "tests/core/planning/leg_world.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Pose2;
using kinematics::Segment;
using plant::MotionMode;

const plant::HallId kHall("hall");

/// A straight way of 80 m to a station with a code; one camera 1.2 m ahead of the body's middle.
class LegChainTest : public testing::Test {
protected:
    LegChainTest() {
        type_.footprint = {{-1, -0.5}, {1, -0.5}, {1, 0.5}, {-1, 0.5}};
        type_.cameras.emplace_back();
        type_.cameras.front().body_from_camera = {1.2, 0, 0};
        kinematics::append_straight(way_, {0, 5, 0}, {80, 5});
        station_.hall = kHall;
        station_.pose = {80, 5, 0};
        station_.markers = {code({81.2, 5})};
    }

    plant::MarkerId code(Point2 at) {
        plant::Marker marker;
        marker.id = plant::MarkerId("code-" + std::to_string(plant_.markers.size()));
        marker.payload = "payload-" + std::to_string(plant_.markers.size());
        marker.size_m = 0.05;
        marker.hall = kHall;
        marker.pose = {at.x_m, at.y_m, 0};
        plant_.markers.push_back(marker);
        return marker.id;
    }

    void codes_every(double spacing_m) {
        for (double x_m = spacing_m; x_m < 79; x_m += spacing_m) code({x_m, 5});
    }

    /// Codes of which none can be left out, but each is surely caught.
    double sparse_m() const { return 0.6 * CodeReach(type_, false).at_most_m(0.05); }

    std::optional<Result<LegChain>> chain() const {
        return leg_chain(plant_, kHall, CodeReach(type_, false), &station_, way_);
    }

    plant::Plant plant_;
    plant::VehicleType type_;
    plant::Station station_;
    std::vector<Segment> way_;
};

TEST_F(LegChainTest, LeadsFromMarkerToMarkerToTheLastBeforeTheStation) {
    codes_every(4);
    const auto found = chain();
    ASSERT_TRUE(found && *found);
    const LegChain& chain = **found;
    ASSERT_GE(chain.markers.size(), 4u);
    EXPECT_LT(chain.markers.size(), 10u) << "of nineteen";
    EXPECT_EQ(chain.markers.back().place, (Point2{76, 5}));
    double at_m = 0;
    for (const auto& marker : chain.markers) {
        EXPECT_GT(marker.at_m, at_m);
        EXPECT_NEAR(marker.at_m, marker.place.x_m - 1.2, 0.1) << "the camera is ahead";
        EXPECT_GT(marker.before_m, marker.after_m);
        EXPECT_LE(marker.before_m, chain.worst_m);
        at_m = marker.at_m;
    }
    EXPECT_LE(chain.worst_m, kChainLimit_m);
    EXPECT_GT(chain.arrival_m, chain.markers.back().after_m);
    EXPECT_LT(chain.arrival_m, chain.worst_m);
}

TEST_F(LegChainTest, SigmaIsThatOfEquationFour) {
    codes_every(sparse_m());
    const auto found = chain();
    ASSERT_TRUE(found && *found);
    const auto& markers = (*found)->markers;
    ASSERT_EQ(markers.size(), plant_.markers.size() - 1) << "all but the station's";
    const CodeReach reach(type_, false);
    const auto known = localisation::known_by_code(type_.cameras.front(), plant_.markers[1]);
    EXPECT_NEAR(markers[0].after_m, known.place_m, 1e-12);
    const double way_m = sparse_m() - 0.09;  // 90 mm of it the code is in view
    const double motion_m = localisation::motion_sigma_m(known.heading_rad, way_m, reach.noise());
    EXPECT_NEAR(markers[1].before_m, known.place_m + 1.1 * motion_m, 3e-4);
}

TEST_F(LegChainTest, WithoutAChainItSaysWhereAMarkerHelps) {
    codes_every(sparse_m());
    const double missing_m = plant_.markers[3].pose.x_m;
    plant_.markers.erase(plant_.markers.begin() + 3);
    const auto broken = chain();
    ASSERT_TRUE(broken && !*broken);
    const Reason& reason = broken->error().reason;
    EXPECT_EQ(reason.code, "no_marker_chain");
    const auto number = [&](const char* name) {
        for (const auto& param : reason.params) {
            if (param.name == name) return std::get<double>(param.value);
        }
        return std::nan("");
    };
    EXPECT_NEAR(number("gap_m"), 2 * sparse_m() - 0.09, 0.05);
    EXPECT_LT(number("at_most_m"), 2 * sparse_m());
    EXPECT_GT(number("at_most_m"), sparse_m());
    EXPECT_NEAR(number("x_m"), missing_m - 1.2, 0.05) << "of the body, its camera is ahead";
    EXPECT_NEAR(number("y_m"), 5, 1e-9);
    code({number("x_m") + 1.2, number("y_m")});
    EXPECT_TRUE(*chain());
}

/// What lies at the border of the picture is seen only by who is exactly on its line.
TEST_F(LegChainTest, ACodeBesideTheLineIsLessSurelyCaught) {
    codes_every(sparse_m());
    EXPECT_TRUE(*chain());
    plant_.markers[3].pose.y_m += 0.01;
    EXPECT_TRUE(*chain());
    plant_.markers[3].pose.y_m += 0.03;
    EXPECT_FALSE(*chain()) << "40 mm of 45 mm beside it";
}

TEST_F(LegChainTest, ATurnMakesItLessSure) {
    codes_every(10);
    const double straight_m = (*chain())->arrival_m;
    way_.clear();
    kinematics::append_straight(way_, {0, 5, 0}, {76, 5});
    kinematics::append_turn(way_, {76, 5, 0}, kPi / 2);
    kinematics::append_turn(way_, {76, 5, kPi / 2}, -kPi / 2);
    kinematics::append_straight(way_, {76, 5, 0}, {80, 5});
    const auto turned = chain();
    ASSERT_TRUE(turned && *turned);
    EXPECT_GT((*turned)->arrival_m, straight_m + 1e-4);
}

TEST_F(LegChainTest, ItsStationsOwnCodesAreNoMarkersOfTheWay) {
    way_.clear();
    kinematics::append_straight(way_, {70, 5, 0}, {80, 5});
    const auto found = chain();
    ASSERT_TRUE(found && *found);
    EXPECT_TRUE((*found)->markers.empty());
    type_.cameras.push_back(type_.cameras.front());
    type_.cameras.back().body_from_camera = {5, 0, 0};
    const auto early = chain();
    ASSERT_TRUE(early && *early);
    ASSERT_EQ((*early)->markers.size(), 1u) << "seen before by the camera farther ahead";
    EXPECT_NEAR((*early)->markers.front().at_m, 6.2, 0.1);
}

TEST_F(LegChainTest, ThereIsNoneWithoutCamerasOrCodesOrBesideBeacons) {
    type_.cameras.clear();
    EXPECT_FALSE(chain());
    type_.cameras.emplace_back();
    EXPECT_TRUE(chain());
    plant_.markers.clear();
    EXPECT_FALSE(chain());
    codes_every(10);
    type_.navigation_scanner = plant::NavigationScanner{};
    EXPECT_TRUE(chain()) << "no reflector hangs there";
    plant_.reflectors.emplace_back();
    EXPECT_FALSE(chain());
}

/// The planner says it of what people look at.
TEST(LegChainOfPlanner, ComesWithEveryModeThatPeopleLookAt) {
    LegWorld world{8};
    auto& plant = world.plant();
    for (auto& type : plant.vehicle_types) type.cameras = {plant::Camera{}};
    plant::Marker marker;
    marker.id = plant::MarkerId("half-way");
    marker.payload = "half-way";
    marker.size_m = 0.05;
    marker.hall = kHall;
    marker.pose = {20, 30, 0};
    plant.markers.push_back(marker);
    const LegPlanner planner(plant);
    const auto request = world.request("tug", 1, 3);
    EXPECT_FALSE(planner.plan_leg(request).value().chain);
    int with_chain = 0;
    for (const auto& option : planner.assess_modes(request, {})) {
        if (!option.plan) continue;
        ASSERT_TRUE(option.plan->chain);
        if (!*option.plan->chain) continue;
        with_chain += (*option.plan->chain)->markers.empty() ? 0 : 1;
        EXPECT_EQ((*option.plan->chain)->markers.front().payload, "half-way");
    }
    EXPECT_GT(with_chain, 0);
}

/// Of /routes: lanes a-b, b-e from station 1 to station 3, 20 m each on one line.
TEST(RouteChain, SaysHowWellThePlaceIsKnownOnARoute) {
    LegWorld world{8};
    auto& plant = world.plant();
    for (auto& type : plant.vehicle_types) type.cameras = {plant::Camera{}};
    WhatIf question;
    question.vehicle_type = plant::VehicleTypeId("tug");
    question.from = 1;
    question.to = 3;
    const auto answer = what_if(plant, question).value();
    ASSERT_FALSE(answer.routes.empty());
    const WhatIfRoute& route = answer.routes.front();
    EXPECT_FALSE(route_chain(plant, question, route)) << "a plant without codes";
    const auto lay = [&](double y_m) {
        plant::Marker marker;
        marker.id = plant::MarkerId("y" + std::to_string(static_cast<int>(y_m)));
        marker.payload = marker.id.str();
        marker.size_m = 0.09;  // so large that it must be met exactly
        marker.hall = kHall;
        marker.pose = {20, y_m, 0};
        plant.markers.push_back(marker);
    };
    lay(34);
    const auto broken = route_chain(plant, question, route);
    ASSERT_TRUE(broken && !*broken);
    EXPECT_EQ(broken->error().reason.code, "no_marker_chain");
    lay(22);
    lay(16);  // behind the turn at the start
    const auto chain = route_chain(plant, question, route);
    ASSERT_TRUE(chain && *chain);
    EXPECT_EQ((*chain)->markers.back().marker, plant::MarkerId("y34"));
    const double by_boundary_m = (*chain)->arrival_m;
    lay(46);
    EXPECT_LT((*route_chain(plant, question, route))->arrival_m, by_boundary_m);
    EXPECT_EQ(answer.routes.front().cost, what_if(plant, question).value().routes.front().cost)
        << "codes cost nothing";
}

}  // namespace
}  // namespace pulseline::planning
