#include "core/planning/manoeuvre/steering.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/planning/manoeuvre/manoeuvre_path.hpp"

namespace pulseline::planning {
namespace {

using geometry::Pose2;
using kinematics::Segment;
using plant::MotionMode;

plant::VehicleType type_of(double radius_m, std::vector<MotionMode> modes) {
    plant::VehicleType type;
    type.footprint = geometry::rectangle(4, 2);
    type.min_turn_radius_m = radius_m;
    type.motion_modes = std::move(modes);
    return type;
}

const std::vector<plant::VehicleType> kTypes{
    type_of(5, {MotionMode::kFree}), type_of(0, {MotionMode::kSelfRotation, MotionMode::kFree}),
    type_of(3, {MotionMode::kLinear, MotionMode::kLateral, MotionMode::kFree})};

Pose2 random_pose(std::mt19937_64& random) {
    std::uniform_real_distribution<double> x(-20, 20);
    std::uniform_real_distribution<double> turn(-kPi, kPi);
    return {x(random), x(random), turn(random)};
}

void expect_at(const Pose2& at, const Pose2& wanted) {
    EXPECT_NEAR(at.x_m, wanted.x_m, 1e-9);
    EXPECT_NEAR(at.y_m, wanted.y_m, 1e-9);
    EXPECT_NEAR(wrap(at.heading_rad - wanted.heading_rad), 0, 1e-9);
}

TEST(Steering, EveryWayEndsAtItsGoalAndTheLeastComesFirst) {
    std::mt19937_64 random(1);
    for (const auto& type : kTypes) {
        const Steering steering(type);
        std::vector<Way> ways;
        for (int i = 0; i < 500; ++i) {
            const Pose2 from = random_pose(random);
            const Pose2 to = random_pose(random);
            steering.ways(from, to, ways);
            ASSERT_FALSE(ways.empty());
            EXPECT_LE(steering.least_cost_m(from, to), ways.front().cost_m + 1e-9);
            double before = 0;
            for (const Way& way : ways) {
                EXPECT_GE(way.cost_m, before);
                before = way.cost_m;
                Pose2 at = from;
                for (int k = 0; k < way.count; ++k) {
                    at = moved(at, way.moves[static_cast<std::size_t>(k)]);
                }
                expect_at(at, to);
            }
        }
    }
}

TEST(Steering, KnowsWhatATypeMayDo) {
    const Steering arcs(kTypes[0]);
    EXPECT_EQ(arcs.radius_m(), 5);
    EXPECT_FALSE(arcs.turns_on_the_spot());

    const Steering spot(kTypes[1]);
    EXPECT_EQ(spot.radius_m(), 2);  // half its length
    EXPECT_TRUE(spot.turns_on_the_spot());
    EXPECT_FALSE(spot.any_direction());

    EXPECT_TRUE(Steering(kTypes[2]).any_direction());
    plant::VehicleType mecanum = type_of(0, {MotionMode::kFree});
    mecanum.kinematics = plant::Kinematics::kMecanum;
    EXPECT_TRUE(Steering(mecanum).any_direction());
}

TEST(Steering, NoPointOfTheBodyMovesFartherThanSaid) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> amount(-0.4, 0.4);
    for (int i = 0; i < 1000; ++i) {
        const Move move{.kind = static_cast<Segment::Kind>(i % 3),
                        .amount = amount(random),
                        .direction_rad = amount(random),
                        .curvature = 0.25};
        const Pose2 from = random_pose(random);
        const Pose2 to = moved(from, move);
        for (const geometry::Point2 corner : geometry::rectangle(4, 2)) {
            EXPECT_LE(geometry::distance(from * corner, to * corner),
                      farthest_moved_m(move, std::hypot(2, 1)) + 1e-12);
        }
    }
}

TEST(Steering, SegmentsChainEvenForMovesOfNextToNothing) {
    const Moves moves{{.kind = Segment::Kind::kRotate, .amount = 3.1},
                      {.amount = 1e-8},
                      {.kind = Segment::Kind::kRotate, .amount = -1e-8},
                      {.kind = Segment::Kind::kArc, .amount = -7, .curvature = -0.2},
                      {.amount = -2},
                      {.amount = 1, .direction_rad = kPi / 2}};
    const Pose2 start{1, 2, 0.5};
    Pose2 goal = start;
    for (const Move& move : moves) goal = moved(goal, move);

    const auto segments = segments_of(start, moves, goal);

    EXPECT_EQ(segments.front().start, start);
    EXPECT_EQ(segments.back().end, goal);
    for (std::size_t i = 1; i < segments.size(); ++i) {
        EXPECT_EQ(segments[i].start, segments[i - 1].end);
        expect_at(kinematics::pose_at(segments[i], 1 - 1e-12), segments[i].end);
    }
    EXPECT_EQ(segments.size(), 7u);  // the large turn is ordered as two, the arc of 80 deg as one
}

TEST(ManoeuvrePath, ReversedItLeadsBackAtTheSameCost) {
    const Moves moves{{.amount = 2},
                      {.kind = Segment::Kind::kArc, .amount = 3, .curvature = 0.2},
                      {.kind = Segment::Kind::kRotate, .amount = 0.7},
                      {.amount = -1}};
    const Pose2 start{3, -1, 2};
    Pose2 at = start;
    for (const Move& move : moves) at = moved(at, move);
    for (const Move& move : reversed(moves)) at = moved(at, move);
    expect_at(at, start);
    const Steering steering(kTypes[1]);
    EXPECT_NEAR(cost_m(steering, reversed(moves)), cost_m(steering, moves), 1e-12);
}

TEST(ManoeuvrePath, ShortensDetoursAndKeepsItsEnds) {
    plant::Plant plant;
    plant::Hall hall;
    hall.id = plant::HallId("hall");
    hall.outline = {{0, 0}, {60, 0}, {60, 40}, {0, 40}};
    plant.halls.push_back(hall);
    const Obstacles obstacles(plant, plant.halls.front());
    const FloorField field(plant, plant.halls.front(), 2.5);
    plant::VehicleType type = kTypes[0];
    const Body body = body_of(type, false);
    const FootprintCheck check(body.pieces, body.clearance_m + ManoeuvreRoom::kMargin_m, field);
    const Steering steering(type);
    const Pose2 start{10, 10, 0};
    const Moves detour{{.amount = 15},
                       {.kind = Segment::Kind::kArc, .amount = 5 * kPi, .curvature = 0.2},
                       {.amount = -20},
                       {.kind = Segment::Kind::kArc, .amount = -2, .curvature = -0.2}};
    Pose2 goal = start;
    for (const Move& move : detour) goal = moved(goal, move);
    const ManoeuvreRoom room({obstacles, field, body, check}, {}, start, goal);

    const Moves shorter = shortened({steering, room, start, goal}, detour, 100, 1);

    Pose2 at = start;
    for (const Move& move : shorter) at = moved(at, move);
    expect_at(at, goal);
    std::vector<Way> ways;
    steering.ways(start, goal, ways);
    EXPECT_LE(cost_m(steering, shorter), ways.front().cost_m + 0.1);
    EXPECT_LT(cost_m(steering, shorter), cost_m(steering, detour));
}

}  // namespace
}  // namespace pulseline::planning
