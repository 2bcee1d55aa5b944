#include "core/onboard/pose/light_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/simulation/world/receivers.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/onboard/pose/straight_drive.hpp"

namespace pulseline::onboard {
namespace {

using namespace simulation;

constexpr double kStep_s = LightWatch::kFineStep_s;
static_assert(kStep_s == testing::StraightDrive::kStep_s);

plant::VehicleType mover() {
    plant::VehicleType type = pulseline::testing::mecanum();
    type.receivers = {{"front left", {1.1, 0.6}, 0.55},
                      {"front right", {1.1, -0.6}, 0.55},
                      {"rear left", {-1.1, 0.6}, 0.55},
                      {"rear right", {-1.1, -0.6}, 0.55}};
    return type;
}

/// A hall of 30 m x 16 m about the way along x, with a transmitter in each corner.
plant::Plant cell() {
    plant::Plant plant;
    plant::Hall hall;
    hall.id = plant::HallId("cell");
    hall.outline = {{-5, -8}, {25, -8}, {25, 8}, {-5, 8}};
    plant.halls = {hall};
    const std::vector<geometry::Point2> corners{
        {-4.5, -7.5}, {24.5, -7.5}, {24.5, 7.5}, {-4.5, 7.5}};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        plant::Transmitter transmitter;
        transmitter.id = plant::TransmitterId("tx-" + std::to_string(i + 1));
        transmitter.hall = hall.id;
        transmitter.position = corners[i];
        transmitter.heading_rad = static_cast<double>(i);
        transmitter.rate_hz = 38 + static_cast<double>(i);
        plant.transmitters.push_back(transmitter);
    }
    return plant;
}

/// A vehicle that drives along x in the light.
class Lit : public testing::StraightDrive {
public:
    explicit Lit(std::uint64_t seed, plant::Plant plant = cell(), const Pose2& true_pose = {})
        : StraightDrive(mover(), std::move(plant), true_pose, seed),
          receivers(world, plant::HallId("cell"), type, drive.true_pose(), seed),
          light(receivers, drive, estimate, watch.trail()),
          known(world.plant.transmitters) {}

    void look(bool located) override { light.step(kStep_s, known, located); }

    SimulatedReceivers receivers;
    LightWatch light;
    std::vector<plant::Transmitter> known;
};

TEST(LightWatch, ADriveIsSteeredByTheLight) {
    Lit lit(3, cell(), {0.004, -0.006, 0.002});
    double worst_m = 0;
    double most_sigmas = 0;
    int lit_steps = 0;
    lit.run(20, [&] {
        // It is led onto its line little by little, and sways when it has come to rest.
        if (lit.drive.true_pose().x_m < 3 || lit.drive.true_pose().x_m > 18) return;
        worst_m = std::max(worst_m, lit.off_m());
        most_sigmas = std::max(most_sigmas, lit.off_m() / lit.estimate.sigma_xy_m());
        lit_steps += lit.light.steers();
    });
    EXPECT_GT(lit_steps, 100);
    EXPECT_LT(worst_m, 0.001);
    EXPECT_LT(most_sigmas, 5);
    EXPECT_LT(std::abs(lit.drive.true_pose().y_m), 0.002);
}

TEST(LightWatch, TwentyTimesASecondItIsCorrected) {
    Lit lit(4);
    int fixes = 0;
    Pose2 before;
    double time_s = 0;
    lit.run(10, [&] {
        time_s += kStep_s;
        if (!lit.light.newest()) return;
        const Pose2& newest = lit.light.newest()->fix.pose;
        fixes += newest != before;
        before = newest;
    });
    EXPECT_GT(fixes / time_s, 20);
}

TEST(LightWatch, StandingItsMeanIsNearerThanOneLook) {
    double one2 = 0;
    double mean2 = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Lit lit(seed);
        for (auto& transmitter : lit.world.transmitters) transmitter.sigma_rad = 5e-5;
        lit.known = lit.world.transmitters;  // exactly known: what is left is noise
        lit.stand(0.06);
        const auto first = lit.light.mean();
        lit.stand(1.2);
        const auto last = lit.light.mean();
        ASSERT_TRUE(first && last);
        const auto off2 = [&](const localisation::IgpsFix& fix) {
            const double off_m =
                distance(fix.fix.pose.position(), lit.drive.true_pose().position());
            return off_m * off_m;
        };
        one2 += off2(*first);
        mean2 += off2(*last);
        EXPECT_LT(last->fix.sigma_xy_m, first->fix.sigma_xy_m);
    }
    EXPECT_LT(std::sqrt(mean2 / one2), 0.4);
}

/// Standing in the light of transmitters that are surveyed as plants have them, machine by machine.
TEST(LightWatch, WhatItStatesOfItsPlaceHolds) {
    int inside = 0;
    int outside = 0;
    double most = 0;
    constexpr int kMachines = 300;
    for (std::uint64_t seed = 1; seed <= kMachines; ++seed) {
        plant::Plant plant = cell();
        for (auto& transmitter : plant.transmitters) {
            transmitter.position.x_m += static_cast<double>(seed % 7) - 3;
        }
        Lit lit(seed, plant, {0.01, -0.02, 0.01});
        lit.stand(1.5);
        const geometry::Pose2 off = inverse(lit.drive.true_pose()) * lit.estimate.pose();
        const auto covariance = lit.estimate.covariance();
        inside += std::abs(off.x_m) <= 1.96 * std::sqrt(covariance(0, 0));
        inside += std::abs(off.y_m) <= 1.96 * std::sqrt(covariance(1, 1));
        const double range = norm(off.position()) / std::sqrt(covariance(0, 0) + covariance(1, 1));
        outside += range > 3;
        most = std::max(most, range);
    }
    std::printf("[ light    ] %d of %d inside, %d outside of the range, most %.2f\n", inside,
                2 * kMachines, outside, most);
    EXPECT_GE(inside, 0.92 * 2 * kMachines);
    EXPECT_EQ(outside, 0);
}

TEST(LightWatch, WithoutAPoseItTellsWhatItsReceiversSee) {
    Lit lit(5, cell(), {12, 3, 0.6});
    for (int i = 0; i < 10; ++i) lit.step(false);
    EXPECT_EQ(lit.estimate.pose(), (Pose2{0, 0, 0})) << "nobody has told it yet";
    ASSERT_EQ(lit.light.readings().size(), 4u);
    for (const auto& reading : lit.light.readings()) {
        ASSERT_TRUE(reading.found);
        const auto receiver =
            std::ranges::find(lit.type.receivers, reading.receiver, &plant::Receiver::name);
        EXPECT_LT(distance(reading.place, lit.drive.true_pose() * receiver->position), 1e-3);
        EXPECT_EQ(reading.transmitters.size(), 4u);
    }
}

TEST(LightWatch, SaysWhyWhenTheLightGoesOut) {
    Lit lit(6);
    lit.stand(0.2);
    ASSERT_TRUE(lit.light.newest());
    for (const char* id : {"tx-1", "tx-2", "tx-3"}) lit.receivers.cover(plant::TransmitterId(id));
    lit.stand(0.2);
    EXPECT_FALSE(lit.light.newest());
    ASSERT_TRUE(lit.light.why_not());
    EXPECT_EQ(lit.light.why_not()->reason.code, "too_few_receivers");
    lit.receivers.uncover();
    lit.stand(0.2);
    EXPECT_TRUE(lit.light.newest());
    EXPECT_FALSE(lit.light.why_not());
}

/// It was pushed: the light says so again and again, its wheels know nothing of it.
TEST(LightWatch, LightThatKeepsContradictingTheWheelsIsBelieved) {
    Lit lit(7, cell(), {0.25, 0.1, 0.05});
    lit.knows_exactly();
    lit.stand(0.1);
    EXPECT_GT(lit.off_m(), 0.2) << "two looks may be wrong";
    lit.stand(0.4);
    EXPECT_LT(lit.off_m(), 1e-3);
}

TEST(LightWatch, AnotherVehicleInTheLightsWayTakesIt) {
    Lit lit(8, cell(), {10, 0, 0});
    lit.receivers.see([](geometry::Point2, std::vector<geometry::Polygon>& bodies) {
        bodies.push_back(geometry::transformed({10, -1.6, 0}, geometry::rectangle(6, 0.8)));
    });
    lit.stand(0.2);
    ASSERT_TRUE(lit.light.newest());
    std::size_t seen = 0;
    for (const auto& reading : lit.light.readings()) seen += reading.transmitters.size();
    EXPECT_LT(seen, 16u);
    EXPECT_GE(seen, 8u);
}

}  // namespace
}  // namespace pulseline::onboard
