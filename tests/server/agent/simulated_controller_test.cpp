#include "server/agent/simulated_controller.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/server/agent/machine_rig.hpp"

// The controller of a machine and its protocol: frames in, frames out.
namespace pulseline::agent {
namespace {

TEST_F(ControllerTest, WantsToKnowWhoItIsAndSaysWhatItHas) {
    EXPECT_EQ(refusal(points(Mode::kBraked)), "hello_first");
    EXPECT_EQ(refusal(Hello{kVersion + 1, 0.01, 0.1, {}}), "unknown_version");
    auto other = hello();
    other.cycle_s = 0.02;
    EXPECT_EQ(refusal(other), "unknown_cycle");
    other = hello();
    other.axes.pop_back();
    EXPECT_EQ(refusal(other), "wrong_axes");
    other = hello();
    other.axes[3].name = "fifth/steering";
    EXPECT_EQ(refusal(other), "unknown_axis");
    other = hello();
    other.axes[0].position_gain_per_s = 4;
    EXPECT_EQ(refusal(other), "other_gain");
    const auto answers = controller.handle(hello());
    const auto& told = std::get<Description>(answers.at(0));
    ASSERT_EQ(told.wheels.size(), type.wheels.size());
    EXPECT_EQ(told.wheels[0], type.wheels[0].name);
    EXPECT_EQ(told.brackets.size(), 4u);
    EXPECT_EQ(told.feet.size(), 4u);
    EXPECT_EQ(told.cameras, (std::vector<std::string>{"front", "back"}));
}

/// A program that says anything at any time.
class AnyProgram {
public:
    AnyProgram(std::uint64_t seed, Hello hello, std::size_t wheels)
        : random_(seed), hello_(std::move(hello)), wheels_(wheels) {}

    Frame next() {
        switch (pick(30)) {
            case 0:
                return hello_;
            case 1:
                return Lift{number(), Lift::What(pick(5)), part(), anything(), speed()};
            case 2:
                return Lift{number(), Lift::What::kBracketHeight, part(), 0.05, {}};
            case 3:
                return pick(3) == 0 ? Frame(StopLifts{}) : Frame(Look{number()});
            case 4:
                return SwitchOff{static_cast<std::uint8_t>(pick(8))};
            case 5:
                return pick(60) == 0 ? Frame(Expose{number(), static_cast<std::uint8_t>(pick(3))})
                                     : Frame(Look{number()});
            case 6:
                return pick(10) == 0 ? Frame(Feedback{}) : points();
            default:
                return points();
        }
    }

private:
    std::uint32_t pick(std::uint32_t below) {
        return static_cast<std::uint32_t>(random_() % below);
    }
    std::uint32_t number() { return static_cast<std::uint32_t>(random_()); }
    std::optional<std::uint8_t> part() {
        return pick(3) == 0 ? std::nullopt : std::optional(static_cast<std::uint8_t>(pick(6)));
    }
    std::optional<double> speed() {
        return pick(2) == 0 ? std::nullopt : std::optional(anything());
    }
    double anything() {
        constexpr double kValues[] = {0, -1, 0.1, -0.3, 1e-9, 3, 1e6, -1e6, 1e300};
        return kValues[pick(9)];
    }
    Frame points() {
        SetPoints points;
        points.cycle = number();
        points.mode = Mode(pick(3));
        const std::size_t count = points.mode == Mode::kBraked ? 0 : wheels_;
        points.wheels.resize(pick(50) == 0 ? pick(9) : count);
        const double mps = pick(20) == 0 ? anything() : 0.3;
        for (auto& wheel : points.wheels) wheel = {mps, pick(20) == 0 ? anything() : 0};
        return points;
    }

    std::mt19937_64 random_;
    Hello hello_;
    std::size_t wheels_;
};

TEST_F(ControllerTest, WhateverAProgramSaysIsAnsweredOnceAndItStaysWhole) {
    int driven = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        AnyProgram program(seed, hello(), type.wheels.size());
        for (int i = 0; i < 2000; ++i) {
            const Frame frame = program.next();
            const auto answers = controller.handle(frame);
            const auto count = [&](auto is) { return std::ranges::count_if(answers, is); };
            const auto refused =
                count([](const Frame& f) { return f.index() == Frame(Refused{}).index(); });
            ASSERT_LE(refused, 1);
            if (const auto* points = std::get_if<SetPoints>(&frame); points && refused == 0) {
                ASSERT_EQ(count([&](const Frame& f) {
                              const auto* told = std::get_if<Feedback>(&f);
                              return told != nullptr && told->cycle == points->cycle;
                          }),
                          1);
            }
            for (const Frame& answer : answers) {
                ASSERT_TRUE(decode(encode(answer))) << "seed " << seed << ", frame " << i;
            }
            driven += controller.braked() ? 0 : 1;
            if (refused == 1) controller.part();
            if (i % 97 == 0) controller.wait(0.2);
            const auto& pose = controller.true_pose();
            ASSERT_TRUE(std::isfinite(pose.x_m + pose.y_m + pose.heading_rad))
                << "seed " << seed << ", frame " << i;
        }
        controller.part();
        EXPECT_TRUE(controller.braked());
    }
    EXPECT_GT(driven, 2000) << "else it was hardly talked with";
}

TEST_F(ControllerTest, DrivesWhatItIsToldAndBrakesWhenNobodyTells) {
    controller.handle(hello());
    for (int i = 0; i < 300; ++i) feedback(points(Mode::kRoll, 0.3));
    EXPECT_GT(controller.true_pose().x_m, 20.3);
    EXPECT_FALSE(controller.braked());
    controller.wait(0.05);
    EXPECT_FALSE(controller.braked());
    controller.wait(0.06);
    EXPECT_TRUE(controller.braked());
    const auto stands = controller.true_pose();
    const auto told = feedback(points(Mode::kBraked));
    EXPECT_EQ(told.cycle, cycle);
    EXPECT_EQ(told.wheels[0].speed_mps, 0);
    EXPECT_EQ(controller.true_pose(), stands);
}

TEST_F(ControllerTest, ShowsWhatItsScannersSeeAndWhatStandsInItsWay) {
    controller.handle(hello());
    const auto before = std::get<Scans>(controller.handle(Look{1}).at(0));
    controller.apply_faults(0.5);
    const auto early = std::get<Scans>(controller.handle(Look{2}).at(0));
    controller.apply_faults(0.6);
    const auto late = std::get<Scans>(controller.handle(Look{3}).at(0));
    const auto returns_near = [](const Scans& told) {
        std::size_t count = 0;
        for (const auto& scan : told.scans) {
            count += static_cast<std::size_t>(std::ranges::count_if(
                scan.ranges_m, [](float range_m) { return range_m > 0 && range_m < 2.5F; }));
        }
        return count;
    };
    EXPECT_EQ(late.id, 3u);
    EXPECT_EQ(late.scans.size(), type.scanners.size());
    EXPECT_EQ(returns_near(early), returns_near(before)) << "not yet";
    EXPECT_GT(returns_near(late), returns_near(before) + 10);
}

TEST_F(ControllerTest, AWheelWhoseBearingGrindsGetsTooHotAndItsDriveIsOffUntilItHasCooled) {
    Fault grinds;
    grinds.kind = Fault::Kind::kBearing;
    grinds.part = "front drive";
    SimulatedController grinding{
        world, world.plant.vehicles[0], type, {20, 10, 0}, {1, {}, false, {grinds}}};
    ASSERT_TRUE(SimulatedController::has(grinds.kind));
    grinding.apply_faults(0);
    grinding.handle(hello());
    const auto told = [&](Mode mode, double speed_mps) {
        return std::get<Feedback>(grinding.handle(points(mode, speed_mps)).back()).wheels[4];
    };
    Feedback::Wheel wheel;
    const double step_mps = type.max_accel_mps2 * type.control.cycle_s;
    for (int i = 0; i < 60'000 && wheel.fault.empty(); ++i) {
        wheel = told(Mode::kRoll, std::min(type.max_speed_mps, i * step_mps));
    }
    EXPECT_EQ(wheel.fault, "servo_overtemperature");
    EXPECT_GE(wheel.temperature_c, type.drive_temperatures.hot_c);
    for (int i = 0; i < 60'000 && !wheel.fault.empty(); ++i) wheel = told(Mode::kBraked, 0);
    EXPECT_EQ(wheel.fault, "");
    EXPECT_LT(wheel.temperature_c, type.drive_temperatures.warm_c);
}

TEST_F(ControllerTest, SetPointsForOtherWheelsThanItHasMoveNothing) {
    controller.handle(hello());
    auto wrong = points(Mode::kRoll, 0.3);
    wrong.wheels.pop_back();
    EXPECT_EQ(refusal(wrong), "wrong_wheels");
    EXPECT_EQ(controller.true_pose(), (geometry::Pose2{20, 10, 0}));
    EXPECT_EQ(refusal(SwitchOff{99}), "unknown_wheel");
    EXPECT_EQ(refusal(Expose{1, 9}), "unknown_camera");
    EXPECT_EQ(refusal(Refused{"me"}), "not_for_a_machine");
}

TEST_F(ControllerTest, LiftsOneThingAtATimeAndHoldsItWhenNobodyTells) {
    controller.handle(hello());
    const auto ended = [&](const Frame& frame) {
        const auto answers = controller.handle(frame);
        return answers.empty() ? std::nullopt : std::optional(std::get<LiftEnded>(answers.front()));
    };
    const auto until_ended = [&]() -> std::optional<LiftEnded> {
        for (int i = 0; i < 3000; ++i) {
            const auto answers = controller.handle(points(Mode::kBraked));
            if (answers.size() > 1) return std::get<LiftEnded>(answers.front());
        }
        return std::nullopt;
    };
    EXPECT_FALSE(ended(Lift{1, Lift::What::kBracketHeight, {}, 0.02, {}}));
    const auto second = ended(Lift{2, Lift::What::kLowerFeet, {}, 0, {}});
    ASSERT_TRUE(second);
    EXPECT_EQ(second->outcome, LiftEnded::Outcome::kRefused);
    EXPECT_EQ(second->why, "lifts_moving");
    const auto first = until_ended();
    ASSERT_TRUE(first);
    EXPECT_EQ(*first, (LiftEnded{1, LiftEnded::Outcome::kDone, {}}));
    EXPECT_NEAR(feedback(points(Mode::kBraked)).brackets[2].height_m, 0.02, 3e-4);

    EXPECT_EQ(ended(Lift{3, Lift::What::kBracketHeight, {}, 0.5, {}})->outcome,
              LiftEnded::Outcome::kRefused);
    EXPECT_EQ(ended(Lift{4, Lift::What::kRaiseFeet, 7, 0, {}})->outcome,
              LiftEnded::Outcome::kRefused);
    EXPECT_FALSE(ended(Lift{5, Lift::What::kBracketHeight, {}, 0.1, {}}));
    for (int i = 0; i < 100; ++i) feedback(points(Mode::kBraked));
    controller.wait(0.2);
    const auto held = until_ended();
    ASSERT_TRUE(held);
    EXPECT_LT(feedback(points(Mode::kBraked)).brackets[0].height_m, 0.08);
}

}  // namespace
}  // namespace pulseline::agent
