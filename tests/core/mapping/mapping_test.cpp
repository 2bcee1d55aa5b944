#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "tests/core/mapping/mapped_hall.hpp"

namespace pulseline::mapping {
namespace {

using geometry::Point2;
using geometry::Pose2;
using testing::Scanning;
using testing::sigmas;

const OccupancyMap& hall_map() {
    static const OccupancyMap kMap = testing::mapped();
    return kMap;
}

double off_m(const geometry::Polygon& polygon, Point2 place) {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 from = polygon[i];
        const Point2 way = polygon[(i + 1) % polygon.size()] - from;
        const double share = std::clamp(dot(place - from, way) / dot(way, way), 0.0, 1.0);
        nearest_m = std::min(nearest_m, distance(place, from + share * way));
    }
    return nearest_m;
}

TEST(MapBuilder, WhatItMapsIsWhereTheDrawingHasIt) {
    const auto plant = testing::hall_with_jigs();
    const OccupancyMap& map = hall_map();
    std::vector<double> offs;
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            if (!map.occupied(column, row)) continue;
            const Point2 place = map.middle_of(column, row);
            double nearest_m = off_m(plant.halls.front().outline, place);
            for (const auto& area : plant.areas)
                nearest_m = std::min(nearest_m, off_m(area.outline, place));
            offs.push_back(nearest_m);
        }
    }
    ASSERT_GT(offs.size(), 1000u) << "walls of 92 m by 5 cm";
    std::ranges::sort(offs);
    EXPECT_LT(offs[offs.size() / 2], 0.03);
    EXPECT_LT(offs[offs.size() * 95 / 100], 0.08);
}

TEST(MonteCarlo, FollowsADriveAndKnowsHowWell) {
    const auto map = prepare(hall_map());
    int inside = 0;
    int all = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        Scanning scanning(seed);
        std::mt19937_64 random(seed);
        std::normal_distribution<double> normal;
        MonteCarlo particles(map, seed);
        Pose2 truth{0.03 * normal(random), 0.03 * normal(random), 0.02 * normal(random)};
        particles.begin_at({}, sigmas(0.05, 0.03));
        for (int i = 0; i < 100; ++i) {
            const Pose2 moved{0.15, 0, 0};
            const Pose2 told{0.15 + 1e-3 * normal(random), 1e-3 * normal(random),
                             5e-4 * normal(random)};
            truth = truth * moved;
            const auto cloud = particles.step(told, sigmas(1e-3, 5e-4), scanning.from(truth));
            if (i < 5) continue;
            EXPECT_LT(distance(cloud.pose.position(), truth.position()), 0.06) << seed;
            EXPECT_LT(std::abs(wrap(cloud.pose.heading_rad - truth.heading_rad)), 0.02) << seed;
            EXPECT_GT(cloud.explained, 0.9);
            EXPECT_LT(cloud.through, 0.03);
            // The map's own error is not in it: half a cell.
            inside += std::abs(cloud.pose.x_m - truth.x_m) <=
                      1.96 * std::hypot(std::sqrt(cloud.covariance(0, 0)), 0.012);
            ++all;
        }
    }
    EXPECT_GT(inside, 0.9 * all);
}

TEST(MonteCarlo, SeesThatItStandsSomewhereElse) {
    MonteCarlo particles(prepare(hall_map()), 1);
    Scanning scanning(1);
    particles.begin_at({}, sigmas(0.05, 0.03));
    const auto cloud = particles.step({}, sigmas(1e-3, 1e-3), scanning.from({13, -3.5, 1.2}));
    EXPECT_GT(cloud.returns, 50);
    EXPECT_LT(cloud.explained, 0.5);
    EXPECT_GT(cloud.through, 0.2);
}

TEST(MonteCarlo, WhereNothingStandsNearItSaysSo) {
    auto empty = testing::hall_with_jigs();
    empty.areas.clear();
    empty.halls.front().outline = {{-100, -100}, {100, -100}, {100, 100}, {-100, 100}};
    Scanning scanning(1, empty);
    MonteCarlo particles(prepare(hall_map()), 1);
    particles.begin_at({}, sigmas(0.05, 0.03));
    const auto cloud = particles.step({}, sigmas(1e-3, 1e-3), scanning.from({}));
    EXPECT_EQ(cloud.returns, 0);
    EXPECT_GT(std::sqrt(cloud.covariance(0, 0)), 0.03) << "it has learned nothing";
}

TEST(MonteCarlo, TheSameSeedGivesTheSamePoses) {
    std::vector<Pose2> poses[2];
    for (auto& run : poses) {
        Scanning scanning(1);
        MonteCarlo particles(prepare(hall_map()), 5);
        MonteCarlo other(prepare(hall_map()), 6);  // draws between them
        particles.begin_at({}, sigmas(0.05, 0.03));
        other.begin_at({}, sigmas(0.05, 0.03));
        for (int i = 0; i < 5; ++i) {
            const auto& scans = scanning.from({0.15 * i, 0, 0});
            run.push_back(particles.step({0.15, 0, 0}, sigmas(1e-3, 1e-3), scans).pose);
            if (&run == &poses[1]) other.step({0.15, 0, 0}, sigmas(1e-3, 1e-3), scans);
        }
    }
    EXPECT_EQ(poses[0], poses[1]);
}

}  // namespace
}  // namespace pulseline::mapping
