#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "core/base/angle.hpp"
#include "core/geometry/bearing.hpp"
#include "core/localisation/igps_pose.hpp"
#include "core/localisation/rigid_fit.hpp"

namespace pulseline::localisation {
namespace {

using Eigen::Vector3d;
using plant::Receiver;
using plant::Transmitter;

Transmitter transmitter(const char* id, double x_m, double y_m, double heading_rad) {
    Transmitter t;
    t.id = plant::TransmitterId(id);
    t.hall = plant::HallId("cell");
    t.position = {x_m, y_m};
    t.z_m = 2.6;
    t.heading_rad = heading_rad;
    return t;
}

/// Four of them in the corners of 20 m x 10 m, as levelled by hand and then measured.
std::vector<Transmitter> corners() {
    std::vector<Transmitter> all{transmitter("a", 0, 0, 0.3), transmitter("b", 20, 0, 1.7),
                                 transmitter("c", 20, 10, -2.1), transmitter("d", 0, 10, 3.0)};
    double turn_rad = 0.004;
    for (Transmitter& t : all) {
        t.roll_rad = turn_rad;
        t.pitch_rad = -0.7 * turn_rad;
        turn_rad += 0.003;
    }
    return all;
}

std::vector<Receiver> four() {
    return {{"front left", {1.5, 0.95}, 0.55},
            {"front right", {1.5, -0.95}, 0.55},
            {"rear left", {-1.5, 0.95}, 0.55},
            {"rear right", {-1.5, -0.95}, 0.55}};
}

std::vector<LightAngles> light_of(const std::vector<Transmitter>& all, const Vector3d& point) {
    std::vector<LightAngles> light;
    for (const Transmitter& t : all) {
        if (const auto seen = light_on(t, point)) light.push_back(*seen);
    }
    return light;
}

std::vector<ReceiverLight> light_at(const std::vector<Transmitter>& all,
                                    const std::vector<Receiver>& receivers, const Pose2& pose) {
    std::vector<ReceiverLight> light;
    for (const Receiver& receiver : receivers) {
        const Point2 at = pose * receiver.position;
        light.push_back({receiver.name, light_of(all, {at.x_m, at.y_m, receiver.z_m})});
    }
    return light;
}

TEST(FeatureAngles, AreTheShareOfATurn) {
    const auto angles = feature_angles({plant::TransmitterId("a"), 10, 10.02, 10.005, 10.015});
    ASSERT_TRUE(angles);
    EXPECT_NEAR(angles->first_rad, kPi / 2, 1e-9);
    EXPECT_NEAR(angles->second_rad, 3 * kPi / 2, 1e-9);
}

TEST(FeatureAngles, OfNoTurnAreRefused) {
    const plant::TransmitterId a("a");
    for (const LightPulses& pulses :
         {LightPulses{a, 10, 10, 10, 10}, LightPulses{a, 10, 9, 9.5, 9.5},
          LightPulses{a, 10, 11, 12, 10.5}, LightPulses{a, 10, 11, 10.5, 9},
          LightPulses{a, 10, std::nan(""), 10.5, 10.5}, LightPulses{a, 10, 11, std::nan(""), 10}}) {
        const auto angles = feature_angles(pulses);
        ASSERT_FALSE(angles);
        EXPECT_EQ(angles.error().reason.code, "bad_pulses");
    }
}

/// Law: a sheet that has turned by the angle contains the point, on the side where it shines.
TEST(LightOn, PutsBothSheetsOntoThePoint) {
    std::mt19937_64 random{3};
    std::uniform_real_distribution<double> x(0.5, 19.5), y(0.5, 9.5), z(0.3, 2.2);
    for (int i = 0; i < 500; ++i) {
        const Vector3d point(x(random), y(random), z(random));
        for (const Transmitter& t : corners()) {
            const auto light = light_on(t, point);
            if (!light) continue;
            const Vector3d seen = hall_from_head(t).transpose() *
                                  (point - Vector3d(t.position.x_m, t.position.y_m, t.z_m));
            const auto check = [&](const plant::LightPlane& sheet, double angle_rad, double side) {
                const Eigen::AngleAxisd turn(angle_rad, Vector3d::UnitZ());
                const Vector3d normal = turn * Vector3d(sheet.a, sheet.b, 1);
                EXPECT_NEAR(normal.dot(seen) + sheet.offset_m, 0, 1e-9);
                const double left = normal.x() * seen.y() - normal.y() * seen.x();
                EXPECT_GT(side * left, 0);
            };
            check(t.first, light->first_rad, 1);
            check(t.second, light->second_rad, -1);
        }
    }
}

TEST(LightOn, EndsWhereItDoesNotShine) {
    Transmitter t = transmitter("a", 0, 0, 0);
    EXPECT_TRUE(light_on(t, {10, 0, 0.6}));
    EXPECT_FALSE(light_on(t, {1, 0, 0.6})) << "63 degrees below level";
    EXPECT_FALSE(light_on(t, {0, 0, 0.6}));
    EXPECT_FALSE(light_on(t, {39, 12, 0.6})) << "farther than 40 m";
}

TEST(LocateReceiver, IsExactWithExactLight) {
    std::mt19937_64 random{4};
    std::uniform_real_distribution<double> x(3, 17), y(3.5, 6.5);
    const auto all = corners();
    for (int i = 0; i < 200; ++i) {
        const Vector3d point(x(random), y(random), 0.55);
        const auto fix = locate_receiver(light_of(all, point), all);
        ASSERT_TRUE(fix) << fix.error().what;
        EXPECT_LT((fix->position - point).norm(), 1e-11);
        EXPECT_FALSE(fix->refused);
    }
}

/// Wang's grade: 10 urad and four transmitters on 20 m x 10 m are 0.105 mm in space.
TEST(LocateReceiver, ItsSpreadIsWhatItStates) {
    std::mt19937_64 random{5};
    std::normal_distribution<double> normal;
    auto all = corners();
    for (Transmitter& t : all) t.sigma_place_m = t.sigma_turn_rad = 1e-9;
    const Vector3d point(8, 4.4, 0.55);
    const auto exact = light_of(all, point);
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d stated = Eigen::Matrix3d::Zero();
    constexpr int kFixes = 4000;
    for (int i = 0; i < kFixes; ++i) {
        auto light = exact;
        for (LightAngles& seen : light) {
            seen.first_rad += 1e-5 * normal(random);
            seen.second_rad += 1e-5 * normal(random);
        }
        const auto fix = locate_receiver(light, all);
        ASSERT_TRUE(fix);
        const Vector3d off = fix->position - point;
        spread += off * off.transpose() / kFixes;
        stated = fix->covariance;
    }
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(std::sqrt(spread(axis, axis) / stated(axis, axis)), 1, 0.04) << axis;
    }
    EXPECT_LT(std::sqrt(spread.trace()), 1.5e-4);
}

TEST(LocateReceiver, WhatItDroveOnMeanwhileIsTakenOff) {
    const auto all = corners();
    const Vector3d now(8, 4.4, 0.55);
    std::vector<LightAngles> light;
    double way_m = 0.002;
    for (const Transmitter& t : all) {
        const Point2 first{way_m, -0.4 * way_m};
        const Point2 second{0.5 * way_m, -0.2 * way_m};
        LightAngles seen = *light_on(t, now - Vector3d(first.x_m, first.y_m, 0));
        seen.second_rad = light_on(t, now - Vector3d(second.x_m, second.y_m, 0))->second_rad;
        seen.way_first = first;
        seen.way_second = second;
        light.push_back(seen);
        way_m += 0.004;
    }
    const auto fix = locate_receiver(light, all);
    ASSERT_TRUE(fix);
    EXPECT_LT((fix->position - now).norm(), 1e-10);
}

TEST(LocateReceiver, TwoTransmittersAreEnoughAndOneIsNot) {
    auto all = corners();
    const Vector3d point(8, 4.4, 0.55);
    all.resize(2);
    EXPECT_TRUE(locate_receiver(light_of(all, point), all));
    all.resize(1);
    const auto fix = locate_receiver(light_of(all, point), all);
    ASSERT_FALSE(fix);
    EXPECT_EQ(fix.error().reason.code, "too_few_transmitters");
}

TEST(LocateReceiver, BetweenTwoTransmittersItsGeometryIsPoor) {
    const std::vector<Transmitter> line{transmitter("a", 0, 5, 0.3), transmitter("b", 20, 5, 1.7)};
    const auto fix = locate_receiver(light_of(line, {10, 5, 2.55}), line);
    ASSERT_FALSE(fix);
    EXPECT_EQ(fix.error().reason.code, "poor_geometry");
}

TEST(LocateReceiver, ATransmitterThatWasPushedIsNamedAndLeftOut) {
    const auto surveyed = corners();
    const Vector3d point(8, 4.4, 0.55);
    for (std::size_t pushed = 0; pushed < surveyed.size(); ++pushed) {
        auto true_ones = surveyed;
        true_ones[pushed].heading_rad += 5e-4;  // 5 mm at 10 m
        const auto fix = locate_receiver(light_of(true_ones, point), surveyed);
        ASSERT_TRUE(fix) << fix.error().what;
        ASSERT_TRUE(fix->refused);
        EXPECT_EQ(*fix->refused, surveyed[pushed].id);
        EXPECT_LT((fix->position - point).norm(), 1e-9);
    }
}

TEST(LocateReceiver, WhenNobodyCanTellWhichIsWrongThereIsNoPlace) {
    auto surveyed = corners();
    surveyed.resize(2);
    auto true_ones = surveyed;
    true_ones[1].pitch_rad += 2e-3;
    const auto fix = locate_receiver(light_of(true_ones, {8, 4.4, 0.55}), surveyed);
    ASSERT_FALSE(fix);
    EXPECT_EQ(fix.error().reason.code, "transmitters_disagree");
}

TEST(LocateByLight, IsExactWithExactLight) {
    std::mt19937_64 random{6};
    std::uniform_real_distribution<double> x(5, 15), y(4, 6), heading(-kPi, kPi);
    const auto all = corners();
    for (int i = 0; i < 200; ++i) {
        const Pose2 pose{x(random), y(random), heading(random)};
        const auto found = locate_by_light(light_at(all, four(), pose), all, four());
        ASSERT_TRUE(found) << found.error().what;
        EXPECT_LT(distance(found->fix.pose.position(), pose.position()), 1e-10);
        EXPECT_NEAR(wrap(found->fix.pose.heading_rad - pose.heading_rad), 0, 1e-10);
        EXPECT_NEAR(found->floor_m, 0, 1e-10);
        EXPECT_EQ(found->fix.payloads, (std::vector<std::string>{"a", "b", "c", "d"}));
        EXPECT_TRUE(found->left_out.empty());
    }
}

/// Law of honesty: with all errors drawn as stated, of transmitters, receivers and light, the
/// normalised squared error is chi-square of 3 degrees.
TEST(LocateByLight, ItsCovarianceIsHonest) {
    std::mt19937_64 random{7};
    std::normal_distribution<double> normal;
    const auto surveyed = corners();
    const ReceiverErrors errors;
    double sum = 0;
    constexpr int kMachines = 600;
    for (int machine = 0; machine < kMachines; ++machine) {
        auto true_ones = surveyed;
        for (Transmitter& t : true_ones) {
            for (double* place : {&t.position.x_m, &t.position.y_m, &t.z_m})
                *place += t.sigma_place_m * normal(random);
            for (double* turn : {&t.roll_rad, &t.pitch_rad, &t.heading_rad})
                *turn += t.sigma_turn_rad * normal(random);
        }
        auto receivers = four();
        for (Receiver& receiver : receivers) {
            receiver.position.x_m += errors.place_m * normal(random);
            receiver.position.y_m += errors.place_m * normal(random);
        }
        const Pose2 pose{9, 4.5, 0.7};
        auto light = light_at(true_ones, receivers, pose);
        for (ReceiverLight& receiver : light) {
            for (LightAngles& seen : receiver.light) {
                seen.first_rad += 1e-5 * normal(random);
                seen.second_rad += 1e-5 * normal(random);
            }
        }
        const auto found = locate_by_light(light, surveyed, four(), errors);
        ASSERT_TRUE(found) << found.error().what;
        const Pose2& at = found->fix.pose;
        const Vector3d off(at.x_m - pose.x_m, at.y_m - pose.y_m,
                           wrap(at.heading_rad - pose.heading_rad));
        Eigen::Matrix3d covariance;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                covariance(i, j) =
                    found->fix.covariance[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
        sum += off.dot(covariance.inverse() * off) / kMachines;
        EXPECT_LT(found->fix.sigma_xy_m, 2e-4);
    }
    EXPECT_NEAR(sum, 3, 0.3);
}

TEST(LocateByLight, AReceiverThatWasKnockedIsNamedAndLeftOut) {
    const auto all = corners();
    const Pose2 pose{9, 4.5, 0.7};
    for (std::size_t knocked = 0; knocked < 4; ++knocked) {
        auto true_ones = four();
        true_ones[knocked].position.x_m += 0.01;
        const auto found = locate_by_light(light_at(all, true_ones, pose), all, four());
        ASSERT_TRUE(found) << found.error().what;
        ASSERT_EQ(found->left_out.size(), 1u);
        EXPECT_EQ(found->left_out[0].name, true_ones[knocked].name);
        EXPECT_EQ(found->left_out[0].code, "receiver_moved");
        EXPECT_LT(distance(found->fix.pose.position(), pose.position()), 1e-9);
    }
}

TEST(LocateByLight, WithTwoReceiversItStillTellsADirection) {
    const auto all = corners();
    const Pose2 pose{9, 4.5, 0.7};
    auto light = light_at(all, four(), pose);
    light[0].light.clear();
    light[3].light.resize(1);
    const auto found = locate_by_light(light, all, four());
    ASSERT_TRUE(found);
    EXPECT_LT(distance(found->fix.pose.position(), pose.position()), 1e-9);
    ASSERT_EQ(found->left_out.size(), 2u);
    EXPECT_EQ(found->left_out[0].code, "too_few_transmitters");

    light[1].light.clear();
    const auto lost = locate_by_light(light, all, four());
    ASSERT_FALSE(lost);
    EXPECT_EQ(lost.error().reason.code, "too_few_receivers");
}

TEST(LocateByLight, ReceiversThatAllMovedTellNothing) {
    const auto all = corners();
    auto true_ones = four();
    true_ones[0].position.x_m += 0.01;
    true_ones[1].position.y_m += 0.02;
    const auto found = locate_by_light(light_at(all, true_ones, {9, 4.5, 0.7}), all, four());
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().reason.code, "receivers_disagree");
}

/// Of receivers 4 (rear) and 1 (front) of one side: Wang's pose angle, from +Y in [0, 2 pi).
double beta_rad(Point2 rear, Point2 front) {
    const double angle_rad = geometry::bearing_rad(rear, front) - kPi / 2;
    return angle_rad < 0 ? angle_rad + 2 * kPi : angle_rad;
}

struct WangCase {
    const char* figure;
    double dx_m, dy_m;  // x1 - x4, y1 - y4
    double (*printed)(double alpha_rad);
};

// All four printed cases are right.
TEST(LocateByLight, ItsHeadingIsWangsPoseAngle) {
    const auto all = corners();
    const std::vector<WangCase> cases{
        {"a", 0.6, -0.8, [](double alpha) { return kPi + alpha; }},
        {"b", -0.6, 0.8, [](double alpha) { return alpha; }},
        {"c", -0.8, -0.6, [](double alpha) { return kPi - alpha; }},
        {"d", 0.8, 0.6, [](double alpha) { return 2 * kPi - alpha; }}};
    for (const WangCase& wang : cases) {
        const Pose2 pose{9, 4.5, std::atan2(wang.dy_m, wang.dx_m)};
        const PlacedPoint front{four()[0].position, pose * four()[0].position, 1e-4};
        const PlacedPoint rear{four()[2].position, pose * four()[2].position, 2e-4};
        const double alpha_rad = std::atan(std::abs(wang.dx_m / wang.dy_m));
        const double beta = beta_rad(rear.in_hall, front.in_hall);
        EXPECT_NEAR(beta, wang.printed(alpha_rad), 1e-12) << wang.figure;
        EXPECT_NEAR(wrap(beta + kPi / 2 - pose_by_two(rear, front).heading_rad), 0, 1e-12)
            << wang.figure;
        const RigidFit fit = rigid_fit(std::vector{rear, front});
        EXPECT_NEAR(wrap(fit.pose.heading_rad - pose_by_two(rear, front).heading_rad), 0, 1e-12)
            << wang.figure;

        auto light = light_at(all, four(), pose);
        for (const bool two_only : {false, true}) {
            if (two_only) light = {light[0], light[2]};
            const auto found = locate_by_light(light, all, four());
            ASSERT_TRUE(found);
            EXPECT_NEAR(wrap(beta + kPi / 2 - found->fix.pose.heading_rad), 0, 1e-9) << wang.figure;
        }
    }
}

// Printed, beta has no value for y1 = y4, and no case for x1 = x4.
TEST(PoseByTwo, KnowsTheHeadingsThatWangsCasesLeaveOut) {
    for (const double heading_rad : {0.0, kPi / 2, kPi, -kPi / 2}) {
        const Pose2 pose{9, 4.5, heading_rad};
        const PlacedPoint front{four()[0].position, pose * four()[0].position};
        const PlacedPoint rear{four()[2].position, pose * four()[2].position};
        EXPECT_NEAR(wrap(pose_by_two(rear, front).heading_rad - heading_rad), 0, 1e-12);
        EXPECT_LT(distance(pose_by_two(rear, front).position(), pose.position()), 1e-12);
    }
}

// Eq. 1 and 2: of a diagonal the middle is the vehicle's, which no heading is needed for.
TEST(PoseByTwo, OfADiagonalItIsTheMiddle) {
    const Pose2 pose{9, 4.5, 2.2};
    const PlacedPoint two{four()[1].position, pose * four()[1].position};
    const PlacedPoint four_th{four()[2].position, pose * four()[2].position};
    const Point2 middle = two.in_hall + 0.5 * (four_th.in_hall - two.in_hall);
    const Pose2 found = pose_by_two(four_th, two);
    EXPECT_LT(distance(middle, found.position()), 1e-12);
    EXPECT_NEAR(wrap(found.heading_rad - pose.heading_rad), 0, 1e-12);
}

TEST(ExpectedFix, IsWorseWhereFewerTransmittersAreSeen) {
    plant::Plant plant;
    plant::Hall hall;
    hall.id = plant::HallId("cell");
    hall.outline = {{-1, -1}, {21, -1}, {21, 11}, {-1, 11}};
    plant.halls = {hall};
    plant.transmitters = corners();
    plant::VehicleType type;
    type.receivers = four();
    const auto open = expected_fix(plant, hall.id, type, {9, 4.5, 0});
    ASSERT_TRUE(open);

    plant::Area shelf;
    shelf.kind = plant::AreaKind::kObstacle;
    shelf.hall = hall.id;
    shelf.outline = {{1, 7}, {19, 7}, {19, 7.5}, {1, 7.5}};
    plant.areas = {shelf};
    const auto behind = expected_fix(plant, hall.id, type, {9, 4.5, 0});
    ASSERT_TRUE(behind);
    EXPECT_EQ(behind->fix.payloads, (std::vector<std::string>{"a", "b"}));
    EXPECT_GT(behind->fix.sigma_xy_m, 1.2 * open->fix.sigma_xy_m);

    plant.areas[0].outline = {{7, 2}, {11, 2}, {11, 7.5}, {7, 7.5}};
    const auto inside = expected_fix(plant, hall.id, type, {9, 4.5, 0});
    ASSERT_FALSE(inside);
    EXPECT_EQ(inside.error().reason.code, "too_few_receivers");
}

}  // namespace
}  // namespace pulseline::localisation
