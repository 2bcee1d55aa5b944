#include "core/control/motion_compensation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace pulseline::control {
namespace {

/// A vehicle whose moves come to something else than commanded, by known lines.
struct InexactVehicle {
    std::array<MoveLine, 3> lines{{{1.06, -0.0008}, {0.93, 0.0004}, {0.96, radians(0.12)}}};
    double noise_m = 2e-4;
    double noise_rad = radians(0.005);
    std::mt19937_64 random{7};

    double normal(double sigma) { return sigma * std::normal_distribution<double>()(random); }
    double uniform(double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    }
    Pose2 drive(std::span<const Move> moves) {
        Pose2 body;
        for (const Move& move : moves) {
            const MoveLine& line = lines[static_cast<std::size_t>(move.kind)];
            const double way = line.gain * move.size + (move.size < 0 ? -1 : 1) * line.offset;
            switch (move.kind) {
                case MoveKind::kAdvance:
                    body = body * Pose2{way + normal(noise_m), normal(noise_m), 0};
                    break;
                case MoveKind::kLateral:
                    body = body * Pose2{normal(noise_m), way + normal(noise_m), 0};
                    break;
                case MoveKind::kTurn:
                    body = body * Pose2{0, 0, way + normal(noise_rad)};
                    break;
            }
        }
        return body;
    }
    DrivenPass pass(std::vector<Move> moves) {
        const Pose2 measured = drive(moves);
        return {std::move(moves), measured, 5e-5, 5e-5};
    }
    /// As Li's vehicle adjusts: only the pose before and after is known.
    DrivenPass rotate_advance_rotate() {
        return pass({{MoveKind::kTurn, uniform(-0.8, 0.8)},
                     {MoveKind::kAdvance, uniform(-0.15, 0.15)},
                     {MoveKind::kTurn, uniform(-0.8, 0.8)}});
    }
    DrivenPass shift_and_turn() {
        return pass({{MoveKind::kAdvance, uniform(-0.05, 0.05)},
                     {MoveKind::kLateral, uniform(-0.05, 0.05)},
                     {MoveKind::kTurn, uniform(-0.02, 0.02)}});
    }
};

void expect_learned(const MotionCompensation& learned, const InexactVehicle& vehicle, MoveKind kind,
                    double gain_tolerance, double offset_tolerance) {
    const MoveLine& line = learned.line(kind);
    const MoveLine& truth = vehicle.lines[static_cast<std::size_t>(kind)];
    EXPECT_NEAR(line.gain, truth.gain, gain_tolerance);
    EXPECT_NEAR(line.offset, truth.offset, offset_tolerance);
    EXPECT_LT(std::abs(line.gain - truth.gain), 4 * line.sigma_gain);
    EXPECT_LT(std::abs(line.offset - truth.offset), 4 * line.sigma_offset);
}

TEST(MotionCompensation, RecoversGainsAndOffsetsFromWholePasses) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        InexactVehicle vehicle;
        vehicle.random.seed(seed);
        MotionCompensation learned;
        for (int i = 0; i < 20; ++i) {
            ASSERT_TRUE(learned.learn(vehicle.rotate_advance_rotate()));
        }
        expect_learned(learned, vehicle, MoveKind::kAdvance, 0.005, 4e-4);
        expect_learned(learned, vehicle, MoveKind::kTurn, 0.002, radians(0.05));
        EXPECT_EQ(learned.line(MoveKind::kLateral).gain, 1);  // never moved so
    }
}

TEST(MotionCompensation, RecoversThemForAVehicleThatMovesSideways) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        InexactVehicle vehicle;
        vehicle.random.seed(seed);
        MotionCompensation learned;
        for (int i = 0; i < 20; ++i) ASSERT_TRUE(learned.learn(vehicle.shift_and_turn()));
        expect_learned(learned, vehicle, MoveKind::kAdvance, 0.012, 5e-4);
        expect_learned(learned, vehicle, MoveKind::kLateral, 0.012, 5e-4);
        expect_learned(learned, vehicle, MoveKind::kTurn, 0.012, radians(0.03));
    }
}

TEST(MotionCompensation, KnowsMoreTheMoreItHasSeen) {
    InexactVehicle vehicle;
    MotionCompensation learned;
    const auto sigma = [&] { return learned.line(MoveKind::kTurn).sigma_gain; };
    const double at_first = sigma();
    for (int i = 0; i < 4; ++i) ASSERT_TRUE(learned.learn(vehicle.rotate_advance_rotate()));
    const double soon = sigma();
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(learned.learn(vehicle.rotate_advance_rotate()));
    EXPECT_LT(soon, at_first / 2);
    EXPECT_LT(sigma(), 0.7 * soon);
}

TEST(MotionCompensation, ACommandedMoveComesToWhatWasWanted) {
    InexactVehicle vehicle;
    MotionCompensation learned;
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(learned.learn(vehicle.shift_and_turn()));
    vehicle.noise_m = vehicle.noise_rad = 0;
    for (const double wanted : {0.04, -0.04, 0.01, -0.003}) {
        const Move move{MoveKind::kAdvance, learned.commanded(MoveKind::kAdvance, wanted)};
        EXPECT_NEAR(vehicle.drive(std::vector{move}).x_m, wanted, 4e-4);
    }
    EXPECT_EQ(learned.commanded(MoveKind::kLateral, 1e-5), 0);  // coasts farther than that
}

TEST(MotionCompensation, OneOutlierDoesNotSpoilIt) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        InexactVehicle vehicle;
        vehicle.random.seed(seed);
        MotionCompensation learned;
        for (int i = 0; i < 12; ++i) {
            DrivenPass pass = vehicle.rotate_advance_rotate();
            if (i == static_cast<int>(seed % 12)) {  // slipped on a cable
                pass.measured = pass.measured * Pose2{0.03, -0.02, radians(4)};
            }
            ASSERT_TRUE(learned.learn(std::move(pass)));
        }
        EXPECT_NEAR(learned.line(MoveKind::kAdvance).gain, 1.06, 0.012);
        EXPECT_NEAR(learned.line(MoveKind::kTurn).gain, 0.96, 0.004);
    }
}

TEST(MotionCompensation, IsTheIdentityBeforeEnoughMoves) {
    InexactVehicle vehicle;
    MotionCompensation learned;
    const auto expect_identity = [&] {
        for (const MoveKind kind : {MoveKind::kAdvance, MoveKind::kLateral, MoveKind::kTurn}) {
            EXPECT_EQ(learned.commanded(kind, 0.02), 0.02);
        }
    };
    expect_identity();
    ASSERT_TRUE(learned.learn(vehicle.shift_and_turn()));
    ASSERT_TRUE(learned.learn(vehicle.shift_and_turn()));
    expect_identity();
    ASSERT_TRUE(learned.learn(vehicle.shift_and_turn()));
    EXPECT_NE(learned.commanded(MoveKind::kAdvance, 0.02), 0.02);
}

TEST(MotionCompensation, StaysInsideItsBoundsWhateverItSees) {
    InexactVehicle vehicle;
    vehicle.lines = {{{2.5, 0.02}, {0.2, -0.02}, {3, radians(10)}}};
    MotionCompensation learned;
    for (int i = 0; i < 24; ++i) ASSERT_TRUE(learned.learn(vehicle.shift_and_turn()));
    for (const double wanted : {0.1, -0.1}) {
        for (const MoveKind kind : {MoveKind::kAdvance, MoveKind::kLateral}) {
            const double size = learned.commanded(kind, wanted) / wanted;
            EXPECT_GE(size, (1 - kMostOffset_m / 0.1) / kMostGain - 1e-12);
            EXPECT_LE(size, (1 + kMostOffset_m / 0.1) * kMostGain + 1e-12);
        }
    }
}

TEST(MotionCompensation, IsTheSameAfterBeingStored) {
    InexactVehicle vehicle;
    MotionCompensation learned;
    for (int i = 0; i < 40; ++i) ASSERT_TRUE(learned.learn(vehicle.rotate_advance_rotate()));
    const auto again = MotionCompensation::restored(learned.passes());
    ASSERT_TRUE(again);
    for (const MoveKind kind : {MoveKind::kAdvance, MoveKind::kLateral, MoveKind::kTurn}) {
        EXPECT_EQ(again->commanded(kind, 0.0123), learned.commanded(kind, 0.0123));
    }
}

TEST(MotionCompensation, RefusesStoredNonsense) {
    const DrivenPass good{{{MoveKind::kAdvance, 0.1}}, {0.1, 0, 0}, 1e-4, 1e-4};
    DrivenPass infinite = good;
    infinite.measured.x_m = std::numeric_limits<double>::infinity();
    DrivenPass negative = good;
    negative.sigma_m = -1;
    for (const DrivenPass& bad : {DrivenPass{}, infinite, negative}) {
        const auto restored = MotionCompensation::restored({good, bad});
        ASSERT_FALSE(restored);
        EXPECT_EQ(restored.error().reason.code, "bad_compensation");
        EXPECT_FALSE(MotionCompensation().learn(bad));
    }
}

}  // namespace
}  // namespace pulseline::control
