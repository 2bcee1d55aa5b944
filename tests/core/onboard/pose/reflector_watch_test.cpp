#include "core/onboard/pose/reflector_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/simulation/world/navigation_scanner.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/onboard/pose/straight_drive.hpp"

namespace pulseline::onboard {
namespace {

using namespace simulation;

plant::VehicleType scanning() {
    plant::VehicleType type = pulseline::testing::mecanum();
    type.navigation_scanner = plant::NavigationScanner{};
    type.navigation_scanner->body_from_scanner = {-0.8, 0, 0};
    return type;
}

/// A hall of 40 m x 16 m about the way along x.
plant::Plant walls() {
    plant::Plant plant;
    plant::Hall hall;
    hall.id = plant::HallId("hall");
    hall.outline = {{-10, -8}, {30, -8}, {30, 8}, {-10, 8}};
    plant.halls = {hall};
    for (const geometry::Point2 at :
         {geometry::Point2{-9.9, -3.1}, geometry::Point2{-9.9, 5.2}, geometry::Point2{-1.3, 7.9},
          geometry::Point2{11.4, 7.9}, geometry::Point2{29.9, 3.6}, geometry::Point2{29.9, -6.2},
          geometry::Point2{18.7, -7.9}, geometry::Point2{3.2, -7.9}}) {
        plant::Reflector one;
        one.id = plant::ReflectorId("r" + std::to_string(plant.reflectors.size() + 1));
        one.hall = hall.id;
        one.position = at;
        plant.reflectors.push_back(one);
    }
    return plant;
}

/// A vehicle that drives along x among reflectors.
class Looking : public testing::StraightDrive {
public:
    explicit Looking(std::uint64_t seed, plant::Plant plant = walls(), const Pose2& true_pose = {})
        : StraightDrive(scanning(), std::move(plant), true_pose, seed),
          scanner(world, plant::HallId("hall"), type, drive.true_pose(), seed),
          reflectors(scanner, drive, estimate, watch.trail()),
          known(world.plant.reflectors) {}

    void look(bool located) override { reflectors.step(kStep_s, known, located); }

    SimulatedNavigationScanner scanner;
    ReflectorWatch reflectors;
    std::vector<plant::Reflector> known;
};

TEST(ReflectorWatch, ADriveIsSteeredByReflectors) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        Looking looking(seed, walls(), {0.01, -0.008, 0.003});
        double worst_m = 0;
        double most_sigmas = 0;
        int fixes = 0;
        looking.run(20, [&] {
            if (looking.drive.true_pose().x_m < 3) return;
            worst_m = std::max(worst_m, looking.off_m());
            most_sigmas = std::max(most_sigmas, looking.off_m() / looking.estimate.sigma_xy_m());
            fixes += looking.reflectors.newest().has_value();
        });
        EXPECT_GT(fixes, 100);
        EXPECT_LT(worst_m, 0.008) << seed;
        EXPECT_LT(most_sigmas, 5) << seed;
        EXPECT_LT(std::abs(looking.drive.true_pose().y_m), 0.008) << seed;
    }
}

TEST(ReflectorWatch, WhatCodesHaveToldBetterIsOnlyCheckedByThem) {
    Looking looking(3);
    looking.knows_exactly();
    const double before_m = looking.off_m();
    looking.stand(2);
    ASSERT_TRUE(looking.reflectors.newest());
    EXPECT_LT(looking.off_m(), before_m + 1e-4);
    EXPECT_LT(looking.estimate.sigma_xy_m(), 2e-4);
}

/// The rays fall on the reflectors in the same way each turn: what they are off stays.
TEST(ReflectorWatch, StandingItKnowsNoBetterAfterAMinute) {
    int covered = 0;
    constexpr int kRuns = 60;
    for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
        Looking looking(seed, walls(), {0.005, -0.004, 0.002});
        looking.stand(0.3);
        ASSERT_TRUE(looking.reflectors.newest());
        const double first_m = looking.estimate.sigma_xy_m();
        looking.stand(60);
        EXPECT_NEAR(looking.estimate.sigma_xy_m(), first_m, 1e-9);
        covered += looking.off_m() <= 2.45 * looking.estimate.sigma_xy_m();  // 95 % of two axes
    }
    EXPECT_GE(covered, kRuns * 88 / 100);
}

/// A person's place is worth less than a turn, also when they say it while the vehicle stands.
TEST(ReflectorWatch, WhatAPersonSaysMeanwhileIsCorrected) {
    Looking looking(4);
    looking.stand(1);
    const double before_m = looking.estimate.sigma_xy_m();
    looking.estimate.start_at({0.015, -0.01, 0.003});
    looking.drive.set_believed({0.015, -0.01, 0.003});
    looking.stand(1);
    EXPECT_LT(looking.estimate.sigma_xy_m(), 1.2 * before_m);
    EXPECT_LT(looking.off_m(), 0.008);
}

TEST(ReflectorWatch, WithoutAPoseItTellsTheNearestThatItSees) {
    Looking looking(5, walls(), {12, 3, 0.6});
    for (int i = 0; i < 10; ++i) looking.step(false);
    EXPECT_EQ(looking.estimate.pose(), (Pose2{0, 0, 0})) << "nobody has told it yet";
    EXPECT_GE(looking.reflectors.sights().size(), 8u);
    double before_m = 0;
    for (const auto& sight : looking.reflectors.sights()) {
        const double away_m = std::hypot(sight.place.x_m, sight.place.y_m);
        EXPECT_GE(away_m, before_m);
        before_m = away_m;
    }
}

TEST(ReflectorWatch, SaysWhyWhenTheScannerIsCovered) {
    Looking looking(6);
    looking.stand(0.3);
    ASSERT_TRUE(looking.reflectors.newest());
    looking.scanner.cover();
    looking.stand(0.3);
    EXPECT_FALSE(looking.reflectors.newest());
    ASSERT_TRUE(looking.reflectors.why_not());
    EXPECT_EQ(looking.reflectors.why_not()->reason.code, "too_few_reflectors");
    EXPECT_TRUE(looking.reflectors.sights().empty());
}

/// Somebody lifted it elsewhere: what is around fits to another place of the hall, and keeps on.
TEST(ReflectorWatch, AKidnappedVehicleFindsItself) {
    for (const Pose2& elsewhere : {Pose2{0.3, 0.1, 0.05}, Pose2{14, -3, 2.2}, Pose2{-6, 5, -1}}) {
        Looking looking(7, walls(), elsewhere);
        looking.knows_exactly();
        looking.stand(0.3);
        EXPECT_GT(looking.off_m(), 0.2) << "two turns may be wrong";
        looking.stand(4);
        EXPECT_LT(looking.off_m(), 0.01);
    }
}

TEST(ReflectorWatch, AReflectorThatWasMovedMovesNothing) {
    Looking looking(8);
    for (auto& known : looking.known) {
        if (known.id.str() == "r4") known.position.x_m += 0.1;
    }
    looking.knows_exactly();
    looking.stand(1);
    ASSERT_TRUE(looking.reflectors.newest());
    const auto& by = looking.reflectors.newest()->fix.payloads;
    EXPECT_EQ(std::ranges::count(by, "r4"), 0);
    EXPECT_EQ(by.size(), 7u);
    EXPECT_LT(looking.off_m(), 0.005);
}

}  // namespace
}  // namespace pulseline::onboard
