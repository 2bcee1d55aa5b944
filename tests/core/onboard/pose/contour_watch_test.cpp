#include "core/onboard/pose/contour_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/mapping/mapped_hall.hpp"
#include "tests/core/mapping/wide_hall.hpp"
#include "tests/core/onboard/pose/straight_drive.hpp"

namespace pulseline::onboard {
namespace {

std::shared_ptr<const mapping::MatchedMap> hall_map() {
    static const auto kMap = mapping::prepare(mapping::testing::mapped());
    return kMap;
}

constexpr double kWall_m = -3.025;  // in the middle of a cell

/// A wall of 200 m beside the way, and nothing else.
plant::Plant hall_of_one_wall() {
    plant::Plant plant = mapping::testing::hall_with_jigs();
    plant.areas.clear();
    plant.halls.front().outline = {{-100, kWall_m}, {100, kWall_m}, {100, 100}, {-100, 100}};
    return plant;
}

std::shared_ptr<const mapping::MatchedMap> wall_map() {
    mapping::OccupancyMap map;
    map.corner = {-100, -5};
    map.columns = 4000;
    map.rows = 200;
    map.free.assign(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows),
                    255);
    const int wall = static_cast<int>(std::floor((kWall_m - map.corner.y_m) / map.cell_m));
    for (int column = 0; column < map.columns; ++column) {
        map.free[static_cast<std::size_t>(wall * map.columns + column)] = 0;
    }
    return mapping::prepare(std::move(map));
}

/// How often the scanners were asked.
class CountedScanners : public Scanners {
public:
    explicit CountedScanners(Scanners& scanners) : scanners_(scanners) {}
    void scan(std::vector<control::Scan>& scans) override {
        ++looks;
        scanners_.scan(scans);
    }
    int looks = 0;

private:
    Scanners& scanners_;
};

/// A vehicle that drives along x in a hall that has been mapped.
class Looking : public testing::StraightDrive {
public:
    explicit Looking(std::uint64_t seed, const geometry::Pose2& true_pose = {},
                     plant::Plant plant = mapping::testing::hall_with_jigs(),
                     std::shared_ptr<const mapping::MatchedMap> map = hall_map(),
                     const plant::VehicleType& of = pulseline::testing::mecanum())
        : StraightDrive(of, std::move(plant), true_pose, seed),
          scanners(world, plant::HallId("hall"), type, drive.true_pose(), seed),
          counted(scanners),
          contours(counted, drive, estimate, watch.trail(), std::move(map), seed) {}

    void look(bool located) override { contours.step(kStep_s, located); }

    simulation::SimulatedScanners scanners;
    CountedScanners counted;
    ContourWatch contours;
};

TEST(ContourWatch, ADriveIsSteeredByWhatStandsAround) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        Looking looking(seed, {0.02, -0.02, 0.01});
        double worst_m = 0;
        double most_sigmas = 0;
        looking.run(15, [&] {
            if (looking.drive.true_pose().x_m < 3) return;
            worst_m = std::max(worst_m, looking.off_m());
            most_sigmas = std::max(most_sigmas, looking.off_m() / looking.estimate.sigma_xy_m());
        });
        EXPECT_TRUE(looking.contours.newest());
        EXPECT_EQ(looking.contours.lacks(), ContourWatch::Lacks::kNothing);
        EXPECT_LT(worst_m, 0.05) << seed;
        EXPECT_LT(most_sigmas, 4) << seed;
        EXPECT_LT(std::abs(looking.drive.true_pose().y_m), 0.05) << seed;
    }
}

TEST(ContourWatch, DrivingItLooksTwentyTimesASecond) {
    Looking looking(3);
    double driving_s = 0;
    int looks = 0;
    looking.run(12.5, [&, before = 0]() mutable {
        if (std::abs(looking.drive.velocity_mps()) > 0.5) {
            driving_s += Looking::kStep_s;
            looks += looking.counted.looks - before;
        }
        before = looking.counted.looks;
    });
    EXPECT_GT(driving_s, 5);
    EXPECT_NEAR(looks / driving_s, 20, 0.5);
}

TEST(ContourWatch, APersonsPlaceOf10CentimetresAnd5DegreesIsEnough) {
    int found = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const double angle_rad = static_cast<double>(seed);
        Looking looking(seed, {0.1 * std::cos(angle_rad), 0.1 * std::sin(angle_rad),
                               (seed % 2 == 0 ? 1 : -1) * radians(5.0)});
        looking.stand(6);
        const double turned_rad =
            wrap(looking.estimate.pose().heading_rad - looking.drive.true_pose().heading_rad);
        found += looking.off_m() < 0.04 && std::abs(turned_rad) < 0.01;
        EXPECT_LT(looking.off_m(), 4 * looking.estimate.sigma_xy_m()) << seed;
    }
    EXPECT_EQ(found, 20);
}

/// 25 m away rays are 0.1 m apart and more: one look knows little, and the next ones see anew.
TEST(ContourWatch, LooksOfOneThatStandsFarFromAllWallsAddUp) {
    const auto plant = mapping::testing::wide_hall();
    const auto map = mapping::prepare(mapping::testing::drawn(plant.halls.front()));
    double first_m = 0;
    double last_m = 0;
    double most_sigmas = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const double angle_rad = static_cast<double>(seed);
        Looking looking(seed, {0.1 * std::cos(angle_rad), 0.1 * std::sin(angle_rad), radians(-5.0)},
                        plant, map, mapping::testing::sees_far());
        while (!looking.contours.newest()) looking.step();
        first_m += looking.estimate.sigma_xy_m();
        looking.stand(8);
        last_m += looking.estimate.sigma_xy_m();
        most_sigmas = std::max(most_sigmas, looking.off_m() / looking.estimate.sigma_xy_m());
    }
    EXPECT_LT(last_m, 0.5 * first_m);
    EXPECT_LT(most_sigmas, 3.5);
}

TEST(ContourWatch, WhatCodesHaveToldBetterIsOnlyChecked) {
    Looking looking(3);
    looking.knows_exactly();
    const auto before = looking.estimate.covariance();
    looking.stand(5);
    ASSERT_TRUE(looking.contours.newest());
    EXPECT_TRUE(looking.estimate.covariance().isApprox(before));
}

TEST(ContourWatch, WhereItIsNotAsSaidItIsLostAndStaysWithWhatItKnows) {
    Looking looking(4, {13, -3.5, 1.2});
    looking.stand(5.5);
    EXPECT_TRUE(looking.contours.lost());
    EXPECT_FALSE(looking.contours.newest());
    ASSERT_TRUE(looking.contours.why_not());
    EXPECT_EQ(looking.contours.why_not()->reason.code, "contours_lost");
    EXPECT_LT(distance(looking.estimate.pose().position(), {}), 0.2);
}

TEST(ContourWatch, CarriedOffWhileItStandsItIsLost) {
    Looking looking(4, {0.02, -0.02, 0.01});
    looking.stand(20);
    ASSERT_FALSE(looking.contours.lost());
    ASSERT_LT(looking.off_m(), 0.05);
    looking.drive.carry({5, 2, 0.7});
    looking.stand(8);
    EXPECT_TRUE(looking.contours.lost());
}

TEST(ContourWatch, CarriedOffWhileItDrivesItIsLostWithinThreeMetres) {
    Looking looking(4, {0.02, -0.02, 0.01});
    double carried_at_m = 0;
    double doubts_after_m = 0;
    double lost_after_m = 0;
    looking.run(15, [&] {
        if (carried_at_m == 0 && looking.drive.believed_pose().x_m > 4) {
            carried_at_m = looking.drive.believed_pose().x_m;
            looking.drive.carry({4, -2, 1.0});
        }
        const double since_m = looking.drive.believed_pose().x_m - carried_at_m;
        if (carried_at_m == 0) return;
        if (doubts_after_m == 0 && looking.contours.doubts()) doubts_after_m = since_m;
        if (lost_after_m == 0 && looking.contours.lost()) lost_after_m = since_m;
    });
    EXPECT_GT(doubts_after_m, 0);
    EXPECT_LT(doubts_after_m, 1) << "it has to brake, too";
    EXPECT_GT(lost_after_m, 0);
    EXPECT_LT(lost_after_m, 3);
}

TEST(ContourWatch, WhereCodesTellOtherwiseTheMapIsOld) {
    auto rebuilt = mapping::testing::hall_with_jigs();
    for (auto& corner : rebuilt.halls.front().outline) corner = 1.5 * corner;
    rebuilt.areas.clear();
    Looking looking(4, {}, rebuilt);
    looking.stand(1);
    looking.knows_exactly();
    looking.stand(20);
    EXPECT_TRUE(looking.contours.why_not());
    EXPECT_FALSE(looking.contours.lost());
}

TEST(ContourWatch, PeopleAroundItDoNotMoveIt) {
    Looking looking(5, {0.02, -0.02, 0.01});
    for (int i = 0; i < 6; ++i) {
        const geometry::Pose2 beside{2.0 * i, i % 2 == 0 ? 2.0 : -2.0, 0};
        looking.scanners.put(geometry::transformed(beside, geometry::rectangle(0.5, 0.5)));
    }
    looking.run(12.5, [] {});
    EXPECT_LT(looking.off_m(), 0.05);
}

TEST(ContourWatch, AWallWithoutFeaturesTellsNothingAlongIt) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        Looking looking(seed, {0.02, -0.02, 0.01}, hall_of_one_wall(), wall_map());
        double most_sigmas = 0;
        looking.run(50, [&] {
            const auto off =
                looking.estimate.pose().position() - looking.drive.true_pose().position();
            const auto covariance = looking.estimate.covariance();
            most_sigmas = std::max({most_sigmas, std::abs(off.x_m) / std::sqrt(covariance(0, 0)),
                                    std::abs(off.y_m) / std::sqrt(covariance(1, 1))});
        });
        EXPECT_LT(most_sigmas, 4) << seed;
        EXPECT_FALSE(looking.contours.lost());
        EXPECT_EQ(looking.contours.lacks(), ContourWatch::Lacks::kFeatures);
        EXPECT_LT(std::abs(looking.estimate.pose().y_m - looking.drive.true_pose().y_m), 0.05);
        EXPECT_GT(std::sqrt(looking.estimate.covariance()(0, 0)), 0.04) << "what a person told";
    }
}

TEST(ContourWatch, WithoutAPoseItDoesNothing) {
    Looking looking(6);
    for (int i = 0; i < 200; ++i) looking.step(false);
    EXPECT_FALSE(looking.contours.newest());
    EXPECT_FALSE(looking.contours.explained());
}

}  // namespace
}  // namespace pulseline::onboard
