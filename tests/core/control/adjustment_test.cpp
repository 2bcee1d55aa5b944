#include "core/control/adjustment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::control {
namespace {

using kinematics::Segment;
using pulseline::testing::differential;
using pulseline::testing::mecanum;
using pulseline::testing::tricycle;
using Kind = Segment::Kind;

/// Drives segments with a scale and some noise of its own.
struct SimpleVehicle {
    double scale = 1;
    double noise_m = 0;
    double noise_rad = 0;
    std::mt19937_64 random{3};

    Pose2 drive(std::span<const Segment> segments) {
        const auto normal = [&](double sigma) {
            return sigma * std::normal_distribution<double>()(random);
        };
        Pose2 body;
        for (const Segment& segment : segments) {
            const Pose2 step = inverse(segment.start) * segment.end;
            const bool turn = segment.kind == Kind::kRotate;
            body = body * Pose2{scale * step.x_m + (turn ? 0 : normal(noise_m)),
                                scale * step.y_m + (turn ? 0 : normal(noise_m)),
                                scale * step.heading_rad + (turn ? normal(noise_rad) : 0)};
        }
        return body;
    }
};

/// Every place passed, as shares of the segments.
template <class Visit>
void visit_way(const std::vector<Segment>& segments, Visit visit) {
    for (const Segment& segment : segments) {
        for (int i = 0; i <= 20; ++i) visit(kinematics::pose_at(segment, i / 20.0));
    }
}

TEST(Segments, AndMovesAreTheSameThing) {
    const std::vector<Move> moves{{MoveKind::kTurn, 0.3},     {MoveKind::kAdvance, -0.1},
                                  {MoveKind::kTurn, -0.7},    {MoveKind::kAdvance, 0.2},
                                  {MoveKind::kLateral, 0.05}, {MoveKind::kTurn, 0.1}};
    const auto segments = segments_of(moves);
    ASSERT_EQ(segments.size(), 5u);
    for (std::size_t i = 1; i < segments.size(); ++i) {
        EXPECT_NEAR(distance(segments[i].start.position(), segments[i - 1].end.position()), 0,
                    1e-12);
    }
    const auto back = moves_of(segments);
    ASSERT_EQ(back.size(), moves.size());
    for (std::size_t i = 0; i < moves.size(); ++i) {
        EXPECT_EQ(back[i].kind, moves[i].kind);
        EXPECT_NEAR(back[i].size, moves[i].size, 1e-12);
    }
    EXPECT_LT(segments[1].length_m, 0);  // driven backwards
    const auto moved = placed({3, 4, kPi / 2}, segments);
    EXPECT_NEAR(moved[1].end.x_m, 3 - segments[1].end.y_m, 1e-12);
}

TEST(Adjustment, AnOmnidirectionalVehicleShiftsAndTurnsAtOnce) {
    const auto type = mecanum();
    Adjustment loop(type);
    const auto moves = loop.next({0.02, -0.01, radians(0.3)}, {});
    ASSERT_TRUE(moves);
    ASSERT_EQ(moves->size(), 2u);
    EXPECT_EQ((*moves)[0].kind, Kind::kStraight);
    EXPECT_NEAR((*moves)[0].direction_rad, std::atan2(-0.01, 0.02), 1e-9);
    EXPECT_NEAR((*moves)[1].end.heading_rad, radians(0.3), 1e-9);
}

TEST(Adjustment, WithRoomADifferentialVehicleRotatesAdvancesAndRotates) {
    const auto type = differential();
    AdjustmentLimits wide;
    wide.reach_m = 0.5;
    wide.reach_rad = kPi;
    Adjustment loop(type, wide);
    const auto moves = loop.next({0.15, 0.1, radians(-20)}, {});
    ASSERT_TRUE(moves);
    EXPECT_NEAR(distance(moves->back().end.position(), {0.15, 0.1}), 0, 1e-9);
    for (const Segment& segment : *moves) {
        if (segment.kind == Kind::kRotate) continue;
        EXPECT_NEAR(std::abs(std::sin(segment.direction_rad)), 0, 1e-9);
    }
}

TEST(Adjustment, NeitherDifferentialVehiclesNorTricyclesEverMoveSideways) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> share(-1, 1);
    for (const auto& type : {differential(), tricycle()}) {
        EXPECT_FALSE(moves_sideways(type));
        for (int i = 0; i < 300; ++i) {
            Adjustment loop(type);
            const auto moves = loop.next(
                {0.06 * share(random), 0.06 * share(random), radians(0.9) * share(random)}, {});
            if (!moves) continue;
            for (const Move& move : moves_of(*moves)) EXPECT_NE(move.kind, MoveKind::kLateral);
        }
    }
    EXPECT_TRUE(moves_sideways(mecanum()));
    EXPECT_TRUE(moves_sideways(pulseline::testing::platform()));
}

TEST(Adjustment, StaysWithinReachAtEveryMoment) {
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> share(-1, 1);
    const AdjustmentLimits limits;
    for (const auto& type : {differential(), mecanum()}) {
        int moved = 0;
        for (int i = 0; i < 500; ++i) {
            const Pose2 target{0.07 * share(random), 0.07 * share(random),
                               radians(0.95) * share(random)};
            Adjustment loop(type, limits);
            const auto moves = loop.next(target, {});
            if (!moves) continue;
            ++moved;
            visit_way(*moves, [&](const Pose2& at) {
                EXPECT_LE(distance(at.position(), target.position()), limits.reach_m + 1e-9);
                EXPECT_LE(std::abs(wrap(at.heading_rad - target.heading_rad)),
                          limits.reach_rad + 1e-9);
            });
        }
        EXPECT_GT(moved, 480);
    }
}

TEST(Adjustment, FiveMillimetresSidewaysAreMendedWithAlmostNoRoom) {
    const auto type = differential();
    for (const double sideways_m : {0.005, -0.005}) {
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            SimpleVehicle vehicle{1.02, 2e-4, radians(0.004)};
            vehicle.random.seed(seed);
            Adjustment loop(type);
            Pose2 target{0.001, sideways_m, radians(0.05)};
            const MotionCompensation none;
            for (;;) {
                const auto moves = loop.next(target, none);
                ASSERT_TRUE(moves) << moves.error().what;
                if (moves->empty()) break;
                target = inverse(vehicle.drive(*moves)) * target;
            }
            EXPECT_LE(norm(target.position()), 0.002);
            EXPECT_LE(loop.passes(), 5);
        }
    }
}

TEST(Adjustment, TheCompensationLearnedInTheLoopSavesPasses) {
    const auto type = differential();
    AdjustmentLimits limits;
    limits.reach_m = 0.4;
    limits.reach_rad = kPi;
    limits.good_m = 0.001;
    const auto passes = [&](bool learn) {
        SimpleVehicle vehicle{1.07, 1e-4, radians(0.003)};
        std::uniform_real_distribution<double> share(-1, 1);
        MotionCompensation compensation;
        int sum = 0;
        for (int run = 0; run < 40; ++run) {
            Pose2 target{0.15 * share(vehicle.random), 0.15 * share(vehicle.random),
                         share(vehicle.random)};
            Adjustment loop(type, limits);
            for (;;) {
                const auto moves = loop.next(target, compensation);
                if (!moves || moves->empty()) break;
                const Pose2 driven = vehicle.drive(*moves);
                target = inverse(driven) * target;
                if (learn) {
                    EXPECT_TRUE(compensation.learn({moves_of(*moves), driven, 5e-5, 5e-5}));
                }
            }
            EXPECT_TRUE(loop.is_good(target));
            sum += loop.passes();
        }
        return sum;
    };
    const int without = passes(false);
    const int with = passes(true);
    RecordProperty("passes_without", without);
    RecordProperty("passes_with", with);
    EXPECT_LT(with, 0.7 * without);
}

TEST(Adjustment, NothingIsMovedWhereItIsGood) {
    const auto type = differential();
    Adjustment loop(type);
    const auto moves = loop.next({0.001, -0.001, radians(0.02)}, {});
    ASSERT_TRUE(moves);
    EXPECT_TRUE(moves->empty());
    EXPECT_EQ(loop.passes(), 0);
}

TEST(Adjustment, RefusesWhatIsOutOfReach) {
    const auto type = mecanum();
    for (const Pose2& far : {Pose2{0.11, 0, 0}, Pose2{0.01, 0, radians(1.1)}}) {
        Adjustment loop(type);
        const auto moves = loop.next(far, {});
        ASSERT_FALSE(moves);
        EXPECT_EQ(moves.error().reason.code, "too_far_from_target");
    }
}

TEST(Adjustment, GivesUpAtItsBestWhenAVehicleComesNoNearer) {
    const auto type = mecanum();
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SimpleVehicle vehicle{1, 3e-3, radians(0.04)};  // far worse than it is taken for
        vehicle.random.seed(seed);
        AdjustmentLimits limits;
        limits.good_m = 5e-4;
        limits.passes = 12;
        Adjustment loop(type, limits);
        Pose2 target{0.03, 0.02, radians(0.2)};
        double least = badness_of(target, limits);
        for (;;) {
            const auto moves = loop.next(target, {});
            EXPECT_NEAR(badness_of(*loop.best(), limits),
                        std::min(least, badness_of(target, limits)), 1e-9);
            least = std::min(least, badness_of(target, limits));
            if (!moves) {
                EXPECT_EQ(moves.error().reason.code, "out_of_tolerance");
                EXPECT_LE(loop.passes(), limits.passes);
                if (loop.passes() < limits.passes) {
                    EXPECT_LE(badness_of(target, limits), 1.5 * least + 1e-9);
                }
                break;
            }
            if (moves->empty()) break;
            target = inverse(vehicle.drive(*moves)) * target;
        }
    }
}

TEST(Adjustment, FromOutsideOfWhatIsAcceptedAnyMoveIsBetterThanNone) {
    const auto type = mecanum();
    AdjustmentLimits limits;
    limits.good_m = 1.6e-4;
    const Pose2 off{1.0e-3, 1.0e-3, 0};  // what a vehicle nobody knows yet may miss a move by
    Adjustment careful(type, limits);
    ASSERT_FALSE(careful.next(off, {}));

    limits.accept_m = 4e-4;
    int refused = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        SimpleVehicle vehicle{1.03, 2e-4, radians(0.005)};
        vehicle.random.seed(seed);
        Adjustment loop(type, limits);
        MotionCompensation compensation;
        Pose2 target = off;
        for (;;) {
            const auto moves = loop.next(target, compensation);
            if (!moves || moves->empty()) break;
            const Pose2 moved = vehicle.drive(*moves);
            ASSERT_TRUE(compensation.learn({moves_of(*moves), moved, 1e-5, 1e-5}));
            target = inverse(moved) * target;
        }
        EXPECT_LE(loop.passes(), limits.passes_outside);
        refused += is_outside(target, limits) ? 1 : 0;
    }
    EXPECT_EQ(refused, 0);
}

// Within its reach a vehicle that cannot go sideways moves aside by three millimetres a pass.
TEST(Adjustment, FarOffItGoesOnAsLongAsEachPassComesNearer) {
    const auto type = differential();
    AdjustmentLimits limits;
    limits.accept_m = 5e-4;
    Adjustment loop(type, limits);
    SimpleVehicle vehicle{1, 0, 0};
    Pose2 target{-0.004, 0.04, radians(0.1)};
    for (;;) {
        const auto moves = loop.next(target, {});
        ASSERT_TRUE(moves) << moves.error().what;
        if (moves->empty() || !is_outside(target, limits)) break;
        target = inverse(vehicle.drive(*moves)) * target;
    }
    EXPECT_GT(loop.passes(), limits.passes_outside);
}

TEST(Adjustment, OutsideItEndsAllTheSameWhenAVehicleNeverComesInside) {
    const auto type = mecanum();
    AdjustmentLimits limits;
    limits.accept_m = 4e-4;
    SimpleVehicle vehicle{0, 0, 0};  // its wheels turn and it stays
    Adjustment loop(type, limits);
    Pose2 target{0.003, 0, 0};
    int passes = 0;
    for (;; ++passes) {
        const auto moves = loop.next(target, {});
        if (!moves) {
            EXPECT_EQ(moves.error().reason.code, "out_of_tolerance");
            break;
        }
        ASSERT_FALSE(moves->empty());
        target = inverse(vehicle.drive(*moves)) * target;
    }
    EXPECT_EQ(passes, limits.passes_outside);
}

TEST(Adjustment, ShiftsAloneWhereATurnWouldSpoilMoreThanItMends) {
    const auto type = mecanum();
    Adjustment loop(type);
    const auto segments = loop.next({0.0016, -0.0029, radians(-0.018)}, {});
    ASSERT_TRUE(segments);
    ASSERT_EQ(segments->size(), 1u);
    EXPECT_NE(segments->front().kind, Kind::kRotate);
}

TEST(Adjustment, DoesNotMoveWhenNoMoveIsExactEnoughToHelp) {
    const auto type = mecanum();
    AdjustmentLimits limits;
    limits.good_m = 1e-5;  // finer than any move repeats
    limits.good_rad = radians(1);
    Adjustment loop(type, limits);
    const auto moves = loop.next({2e-4, 2e-4, 0}, {});
    ASSERT_FALSE(moves);
    EXPECT_EQ(moves.error().reason.code, "out_of_tolerance");
    EXPECT_EQ(loop.passes(), 0);
}

}  // namespace
}  // namespace pulseline::control
