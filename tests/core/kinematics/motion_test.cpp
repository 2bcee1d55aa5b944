#include "core/kinematics/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/geometry/bearing.hpp"
#include "core/kinematics/primitives.hpp"
#include "tests/core/kinematics/vehicle_types.hpp"

namespace pulseline::kinematics {
namespace {

using plant::VehicleType;

constexpr double kEnd_m = 1e-9;

double number(const Error& error, const std::string& name) {
    for (const Param& param : error.reason.params) {
        if (param.name == name) return std::get<double>(param.value);
    }
    ADD_FAILURE() << "no parameter " << name << " in " << error.reason.code;
    return 0;
}

VehicleType all_modes() {
    VehicleType type = tang_platform();
    type.motion_modes.push_back(MotionMode::kLateral);
    type.motion_modes.push_back(MotionMode::kOblique);
    return type;
}

/// Follows the segments by their own numbers only (turn, length, direction, centre).
Pose2 drive(const Pose2& start, const std::vector<Segment>& segments) {
    Pose2 pose = start;
    for (const Segment& s : segments) {
        if (s.kind == Segment::Kind::kStraight) {
            const double travel = pose.heading_rad + s.direction_rad;
            pose.x_m += std::abs(s.length_m) * std::cos(travel);
            pose.y_m += std::abs(s.length_m) * std::sin(travel);
        } else if (s.kind == Segment::Kind::kArc) {
            // Rolling without slip: sign of way and turn fix on which side the centre lies.
            const double rho = s.length_m / s.turn_rad;
            const Point2 centre{pose.x_m - rho * std::sin(pose.heading_rad),
                                pose.y_m + rho * std::cos(pose.heading_rad)};
            EXPECT_LT(geometry::distance(centre, s.centre), 1e-6);
            pose.x_m = centre.x_m + rho * std::sin(pose.heading_rad + s.turn_rad);
            pose.y_m = centre.y_m - rho * std::cos(pose.heading_rad + s.turn_rad);
            pose.heading_rad += s.turn_rad;
        } else if (s.kind == Segment::Kind::kCombined) {
            const double travel = pose.heading_rad + s.direction_rad;
            pose.x_m += s.length_m * std::cos(travel);
            pose.y_m += s.length_m * std::sin(travel);
            pose.heading_rad += s.turn_rad;
        } else {
            pose.heading_rad += s.turn_rad;
        }
    }
    pose.heading_rad = wrap(pose.heading_rad);
    return pose;
}

void expect_sound(const MotionPlan& plan, const Pose2& from) {
    Pose2 pose = from;
    double duration = 0;
    for (const Segment& s : plan.segments) {
        EXPECT_LT(geometry::distance(s.start.position(), pose.position()), 1e-8);
        EXPECT_LT(std::abs(wrap(s.start.heading_rad - pose.heading_rad)), 1e-9);
        EXPECT_LT(std::abs(s.turn_rad), kSplitTurn_rad);
        EXPECT_GT(s.duration_s, 0);
        EXPECT_TRUE(s.kind != Segment::Kind::kArc || std::abs(s.turn_rad) <= kPi / 2 + 1e-9);
        pose = s.end;
        duration += s.duration_s;
    }
    EXPECT_NEAR(plan.duration_s, duration, 1e-9);
}

class RandomPairs : public testing::TestWithParam<MotionMode> {};

TEST_P(RandomPairs, EndAtTheTargetOrNameAReason) {
    const VehicleType type = GetParam() == MotionMode::kCombined ? mecanum_platform() : all_modes();
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> place(-60, 60);
    std::uniform_real_distribution<double> turn(-kPi, kPi);
    int driven = 0;
    for (int i = 0; i < 10'000; ++i) {
        const Pose2 from{place(random), place(random), turn(random)};
        Pose2 to{place(random), place(random), turn(random)};
        if (GetParam() == MotionMode::kSelfRotation && i % 4 != 0) {
            to = {from.x_m, from.y_m, to.heading_rad};
        }
        if (GetParam() == MotionMode::kLateral && i % 4 != 0) {
            const Point2 beside = from * Point2{0, place(random)};
            to = {beside.x_m, beside.y_m, to.heading_rad};
        }
        const auto variants = motion_variants(type, from, to, GetParam());
        if (!variants) {
            EXPECT_FALSE(variants.error().reason.code.empty());
            continue;
        }
        ++driven;
        for (const MotionPlan& plan : *variants) {
            expect_sound(plan, from);
            const Pose2 end = drive(from, plan.segments);
            EXPECT_LT(geometry::distance(end.position(), to.position()), kEnd_m);
            EXPECT_LT(geometry::distance(plan.segments.back().end.position(), to.position()),
                      kEnd_m);
            EXPECT_LT(std::abs(wrap(end.heading_rad - to.heading_rad)), kEnd_m);
        }
    }
    EXPECT_GT(driven, 6'000);
}

INSTANTIATE_TEST_SUITE_P(Motion, RandomPairs,
                         testing::Values(MotionMode::kLinear, MotionMode::kFixedAxisRotation,
                                         MotionMode::kSelfRotation, MotionMode::kLateral,
                                         MotionMode::kOblique, MotionMode::kCombined),
                         [](const auto& mode) {
                             return std::string(plant::to_string(mode.param));
                         });

TEST(LinearMotion, ReproducesTangsVector) {
    const auto plan =
        plan_motion(tang_platform(), {10, 20, radians(90)}, {20, 30, 0}, MotionMode::kLinear);

    ASSERT_TRUE(plan);
    ASSERT_EQ(plan->segments.size(), 3u);
    EXPECT_NEAR(degrees(-plan->segments[0].turn_rad), 45, 1e-3);  // the paper counts clockwise
    EXPECT_NEAR(1000 * plan->segments[1].length_m, 14142.136, 1e-3);
    EXPECT_NEAR(degrees(-plan->segments[2].turn_rad), 45, 1e-3);
}

TEST(LinearMotion, DrivesBackwardsWhenThatTurnsLess) {
    const auto plan = plan_motion(tang_platform(), {0, 0, 0}, {-10, 0, 0}, MotionMode::kLinear);

    ASSERT_TRUE(plan);
    ASSERT_EQ(plan->segments.size(), 1u);
    EXPECT_DOUBLE_EQ(plan->segments[0].length_m, -10);
    EXPECT_DOUBLE_EQ(std::abs(plan->segments[0].direction_rad), kPi);
    EXPECT_DOUBLE_EQ(plan->length_m, 10);
}

TEST(FixedAxisRotation, TakesTheShorterWayRoundBackwards) {
    const auto plan =
        plan_motion(tang_platform(), {0, 0, 0}, {-10, 10, 0}, MotionMode::kFixedAxisRotation);

    ASSERT_TRUE(plan);
    EXPECT_LT(plan->segments[0].length_m, 0);
    EXPECT_NEAR(plan->segments[0].turn_rad, -kPi / 2, 1e-12);
}

TEST(FixedAxisRotation, RefusesATargetOnTheHeadingLineWithRadiusAndLimit) {
    for (const double heading : {0.0, 0.7, kPi / 2, -2.5}) {
        const Pose2 from{3, 4, heading};
        const Point2 ahead = from * Point2{20, 0.5};

        const auto plan = plan_motion(tang_platform(), from, {ahead.x_m, ahead.y_m, 0},
                                      MotionMode::kFixedAxisRotation);

        ASSERT_FALSE(plan);
        EXPECT_EQ(plan.error().code, Errc::kUnreachable);
        EXPECT_EQ(plan.error().reason.code, "target_on_heading_line");
        EXPECT_NEAR(number(plan.error(), "offset_m"), 0.5, 1e-9);
        EXPECT_NEAR(number(plan.error(), "radius_m"), (20 * 20 + 0.25) / (2 * 0.5), 1e-6);
        EXPECT_EQ(number(plan.error(), "limit_m"), 200);
    }
    const auto exact =
        plan_motion(tang_platform(), {0, 0, 0}, {20, 0, 1}, MotionMode::kFixedAxisRotation);
    ASSERT_FALSE(exact);
    EXPECT_TRUE(std::isfinite(number(exact.error(), "radius_m")));
}

TEST(FixedAxisRotation, RefusesATurnTighterThanTheVehicleCan) {
    VehicleType type = tang_platform();
    type.min_turn_radius_m = 6;

    const auto plan = plan_motion(type, {0, 0, 0}, {0, 10, 0}, MotionMode::kFixedAxisRotation);

    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().reason.code, "turn_radius_too_small");
    EXPECT_NEAR(number(plan.error(), "radius_m"), 5, 1e-12);
}

TEST(SelfRotation, SplitsLargeTurnsAndGoesCounterClockwiseOnATie) {
    const auto half = plan_motion(tang_platform(), {1, 2, radians(90)}, {1, 2, radians(-90)},
                                  MotionMode::kSelfRotation);
    const auto large =
        plan_motion(tang_platform(), {1, 2, 0}, {1, 2, radians(-171)}, MotionMode::kSelfRotation);

    ASSERT_TRUE(half);
    ASSERT_EQ(half->segments.size(), 2u);
    EXPECT_NEAR(half->segments[0].turn_rad, kPi / 2, 1e-12);
    ASSERT_TRUE(large);
    ASSERT_EQ(large->segments.size(), 2u);
    EXPECT_NEAR(large->segments[1].turn_rad, radians(-85.5), 1e-12);
}

TEST(SelfRotation, RefusesAnotherPlace) {
    const auto plan = plan_motion(tang_platform(), {0, 0, 0}, {1, 0, 1}, MotionMode::kSelfRotation);
    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().reason.code, "not_in_place");
    EXPECT_EQ(number(plan.error(), "distance_m"), 1);
}

TEST(LateralMotion, RefusesATargetAhead) {
    const auto plan = plan_motion(all_modes(), {0, 0, kPi / 2}, {-3, 4, 1}, MotionMode::kLateral);
    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().reason.code, "not_beside");
    EXPECT_NEAR(number(plan.error(), "along_m"), 4, 1e-12);
}

TEST(ObliqueMotion, KeepsTheHeadingOnTheWay) {
    const auto plan = plan_motion(mecanum_platform(), {0, 0, 0.3}, {4, 3, 1}, MotionMode::kOblique);
    ASSERT_TRUE(plan);
    ASSERT_EQ(plan->segments.size(), 2u);
    EXPECT_EQ(plan->segments[0].end, (Pose2{4, 3, 0.3}));
    EXPECT_NEAR(plan->segments[1].turn_rad, 0.7, 1e-12);
}

TEST(CombinedMotion, OffersBothWaysRoundAndNoneToSteeredWheels) {
    const auto ways =
        motion_variants(mecanum_platform(), {0, 0, 0}, {5, 0, 2}, MotionMode::kCombined);
    ASSERT_TRUE(ways);
    ASSERT_EQ(ways->size(), 2u);
    EXPECT_NEAR((*ways)[0].turn_rad, 2, 1e-12);
    EXPECT_NEAR((*ways)[1].turn_rad, 2 * kPi - 2, 1e-12);
    VehicleType steered = tang_platform();
    steered.motion_modes.push_back(MotionMode::kCombined);
    const auto refused = plan_motion(steered, {0, 0, 0}, {5, 0, 2}, MotionMode::kCombined);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "mode_not_supported");
}

TEST(PlanMotion, RefusesWhatTheWheelsCannotFollow) {
    VehicleType type = differential_vehicle();
    type.motion_modes = {MotionMode::kLateral};
    const auto refused = plan_motion(type, {0, 0, 0}, {0, 3, 0}, MotionMode::kLateral);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "cannot_move_so");
}

TEST(PlanMotion, KnowsWhenItIsThereAndWhichModesATypeHas) {
    const VehicleType type = tang_platform();
    const auto there =
        plan_motion(type, {1, 1, kPi}, {1.0009, 1, -kPi + radians(0.004)}, MotionMode::kLinear);
    const auto lateral = plan_motion(type, {0, 0, 0}, {0, 5, 0}, MotionMode::kLateral);
    const auto automatic = plan_motion(type, {0, 0, 0}, {0, 5, 0}, MotionMode::kAuto);

    EXPECT_EQ(there.error().reason.code, "already_there");
    EXPECT_EQ(lateral.error().reason.code, "mode_not_supported");
    EXPECT_EQ(automatic.error().reason.code, "mode_not_supported");
}

TEST(Duration, FollowsTheTrapezoidalProfile) {
    EXPECT_DOUBLE_EQ(profile_duration_s(10, 1, 0.2), 10 + 5);  // 5 s up, 5 s down, 5 m in between
    EXPECT_DOUBLE_EQ(profile_duration_s(5, 1, 0.2), 10);       // top speed just reached
    EXPECT_DOUBLE_EQ(profile_duration_s(1.25, 1, 0.2), 5);     // triangle
    EXPECT_EQ(profile_duration_s(0, 1, 0.2), 0);
}

TEST(Duration, PiecesOfOneArcShareOneProfile) {
    const auto plan = plan_motion(tang_platform(), {30, 20, radians(-90)}, {50, 20, radians(90)},
                                  MotionMode::kFixedAxisRotation);
    ASSERT_TRUE(plan);
    ASSERT_EQ(plan->segments.size(), 2u);
    // Radius 10 m: the front left wheel, on the outside, runs at 1 m/s; 0.2 m/s^2 of the centre.
    const double outside_m = std::hypot(10 + 0.925, 4.97);
    const double steering_s = std::atan(4.97 / (10 - 0.925)) / 0.8;
    EXPECT_NEAR(plan->duration_s, profile_duration_s(kPi, 1 / outside_m, 0.02) + steering_s, 1e-9);
}

TEST(Duration, HoldsTheTurningOfSteeredWheelsBeforeEachRun) {
    // A quarter turn, straight on, a quarter turn back: wheels across, straight, across.
    const auto plan = plan_motion(tang_platform(), {0, 0, 0}, {0, 20, 0}, MotionMode::kLinear);
    ASSERT_TRUE(plan);
    ASSERT_EQ(plan->segments.size(), 3u);
    const double turning_s = profile_duration_s(kPi / 2, 0.1, 0.05);
    const double across_s = kPi / 2 / 0.8;
    EXPECT_NEAR(plan->segments[0].duration_s, turning_s + across_s, 1e-9);
    EXPECT_NEAR(plan->segments[1].duration_s, profile_duration_s(20, 1, 0.2) + across_s, 1e-9);
}

TEST(Part, PiecesMeetAndAddUp) {
    const auto plan =
        plan_motion(tang_platform(), {30, 20, -1.2}, {50, 25, 0.4}, MotionMode::kFixedAxisRotation);
    ASSERT_TRUE(plan);
    std::vector<Segment> segments = plan->segments;
    append_combined(segments, {1, 2, 0.5}, {7, -3}, 1.4);
    for (const Segment& whole : segments) {
        const Segment a = part(tang_platform(), whole, 0, 0.3);
        const Segment b = part(tang_platform(), whole, 0.3, 1);
        EXPECT_EQ(a.start, whole.start);
        EXPECT_EQ(a.end, b.start);
        EXPECT_EQ(b.end, whole.end);
        EXPECT_NEAR(a.length_m + b.length_m, whole.length_m, 1e-12);
        EXPECT_NEAR(a.turn_rad + b.turn_rad, whole.turn_rad, 1e-12);
        const Pose2 middle = pose_at(whole, 0.3 + 0.7 * 0.5);
        EXPECT_LT(geometry::distance(pose_at(b, 0.5).position(), middle.position()), 1e-9);
    }
}

/// Wang, 4.3: from +Y in [0, 2 pi).
double gamma_rad(Point2 from, Point2 target) {
    const double angle_rad = geometry::bearing_rad(from, target) - kPi / 2;
    return angle_rad < 0 ? angle_rad + 2 * kPi : angle_rad;
}

/// His cases as printed, theta being arctan |(x0 - xaim) / (y0 - yaim)|; `y_m`: the one whose sign
/// chooses among them, y1 in print.
double printed_gamma_rad(Point2 from, Point2 target, double y_m) {
    const double theta = std::atan(std::abs((from.x_m - target.x_m) / (from.y_m - target.y_m)));
    if (from.x_m > target.x_m) return y_m < target.y_m ? theta : kPi - theta;  // a, d
    return y_m > target.y_m ? kPi + theta : 2 * kPi - theta;                   // b, c
}

TEST(MoveDirection, IsWangsTargetAngleInAllQuadrants) {
    const Pose2 pose{10, 20, 0.4};
    const double beta_rad = pose.heading_rad - kPi / 2;
    for (const Point2 way : {Point2{-3, 4}, Point2{3, -4}, Point2{4, 3}, Point2{-4, -3}}) {
        const Point2 target = pose.position() + way;
        const double gamma = gamma_rad(pose.position(), target);
        EXPECT_NEAR(gamma, printed_gamma_rad(pose.position(), target, pose.y_m), 1e-12);
        EXPECT_NEAR(wrap(geometry::move_direction_rad(pose, target) - (gamma - beta_rad)), 0,
                    1e-12);
        const Pose2 there =
            pose * Pose2{5 * std::cos(geometry::move_direction_rad(pose, target)),
                         5 * std::sin(geometry::move_direction_rad(pose, target)), 0};
        EXPECT_LT(distance(there.position(), target), 1e-9);
    }
}

// Which his cases leave out: they divide by y0 - yaim, and none has x0 = xaim.
TEST(MoveDirection, KnowsTheTargetsOnTheAxes) {
    const Pose2 pose{10, 20, kPi / 2};
    EXPECT_NEAR(geometry::move_direction_rad(pose, {10, 21}), 0, 1e-12);
    EXPECT_NEAR(geometry::move_direction_rad(pose, {9, 20}), kPi / 2, 1e-12);
    EXPECT_NEAR(geometry::move_direction_rad(pose, {11, 20}), -kPi / 2, 1e-12);
    EXPECT_NEAR(std::abs(geometry::move_direction_rad(pose, {10, 19})), kPi, 1e-12);
}

// The print compares yaim with y1, receiver 1's, where y0 is meant: a target between the two is
// taken for one on the other side of the vehicle.
TEST(MoveDirection, WangsCasesAsPrintedTakeTheWrongQuadrantBesideTheVehicle) {
    const Point2 centre{10, 20};
    const double y1_m = 20.6;
    const Point2 target{9, 20.3};
    const double right_rad = gamma_rad(centre, target);
    EXPECT_NEAR(printed_gamma_rad(centre, target, centre.y_m), right_rad, 1e-12);
    EXPECT_NEAR(printed_gamma_rad(centre, target, y1_m) - right_rad, 2 * std::atan(0.3), 1e-12);
}

}  // namespace
}  // namespace pulseline::kinematics
