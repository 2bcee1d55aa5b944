#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/plant/grid_blocks.hpp"
#include "tests/core/mapping/mapped_hall.hpp"
#include "tests/core/mapping/wide_hall.hpp"

namespace pulseline::mapping {
namespace {

using geometry::Point2;
using geometry::Pose2;
using testing::Scanning;
using testing::sigmas;
using testing::wide_hall;

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

const Eigen::Matrix3d kNone = Eigen::Matrix3d::Zero();

/// Where it was held to be, and what a look says of that, fused as a filter does.
struct Held {
    Pose2 pose;
    Eigen::Matrix3d covariance;

    void fuse(const MonteCarlo::Told& look) {
        const Eigen::Matrix3d gain = covariance * (covariance + look.covariance).inverse();
        const Eigen::Vector3d off(look.pose.x_m - pose.x_m, look.pose.y_m - pose.y_m,
                                  wrap(look.pose.heading_rad - pose.heading_rad));
        const Eigen::Vector3d by = gain * off;
        pose = {pose.x_m + by[0], pose.y_m + by[1], wrap(pose.heading_rad + by[2])};
        covariance -= gain * covariance;
    }
};

/// Walls and columns 20 m to 30 m away: half a step between rays is 5 cm there.
TEST(MapBuilder, WhatItSeesFromAfarIsWhereTheDrawingHasIt) {
    const auto plant = wide_hall();
    const auto type = testing::sees_far();
    Scanning scanning(3, plant, type);
    const Pose2 start{-5, 0, 0};
    MapBuilder builder(start, 30);
    Pose2 at = start;
    builder.take({}, sigmas(1e-4, 1e-5), scanning.from(at));
    for (int i = 0; i < 24; ++i) {
        const Pose2 moved{0.15, 0, kPi / 12};
        at = at * moved;
        builder.take(moved, sigmas(1e-4, 1e-5), scanning.from(at));
        builder.stands_at(at, sigmas(1e-4, 1e-5));
    }
    auto outlines = plant::grid_blocks(plant.halls.front());
    outlines.push_back(plant.halls.front().outline);
    const OccupancyMap map = builder.map();
    std::vector<double> offs;
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            if (!map.occupied(column, row)) continue;
            const Point2 place = map.middle_of(column, row);
            double nearest_m = std::numeric_limits<double>::infinity();
            for (const auto& outline : outlines) {
                nearest_m = std::min(nearest_m, off_m(outline, place));
            }
            offs.push_back(nearest_m);
        }
    }
    ASSERT_GT(offs.size(), 500u);
    std::ranges::sort(offs);
    EXPECT_LT(offs[offs.size() * 8 / 10], 0.03);
}

/// A person errs by 5 deg: seen from there, a wall 25 m away ends 2 m beside where it stands.
TEST(MonteCarlo, FarFromAllWallsNoLookIsLostFromADecimetreAndFiveDegreesOff) {
    const auto plant = wide_hall();
    const auto map = prepare(testing::drawn(plant.halls.front()));
    const auto type = testing::sees_far();
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Scanning scanning(seed, plant, type);
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> x(-10, 10);
        std::uniform_real_distribution<double> y(-3, 3);
        std::uniform_real_distribution<double> angle(-kPi, kPi);
        const Pose2 truth{x(random), y(random), angle(random)};
        const double away_rad = angle(random);
        const Pose2 told{truth.x_m + 0.1 * std::cos(away_rad), truth.y_m + 0.1 * std::sin(away_rad),
                         wrap(truth.heading_rad + radians(seed % 2 == 0 ? 5 : -5))};
        MonteCarlo particles(map, seed);
        Held held{told, sigmas(0.05, 0.044)};
        for (int i = 0; i < 12; ++i) {
            const auto look =
                particles.look(held.pose, held.covariance, kNone, kNone, scanning.from(truth));
            EXPECT_GT(look.explained, 0.85) << seed;
            EXPECT_LT(look.through, 0.05) << seed;
            held.fuse(look.news);
        }
        EXPECT_LT(distance(held.pose.position(), truth.position()), 0.06) << seed;
        EXPECT_LT(std::abs(wrap(held.pose.heading_rad - truth.heading_rad)), radians(0.3)) << seed;
    }
}

TEST(MonteCarlo, FromADecimetreAndFiveDegreesOffLooksTellWhereItIsAndHowWell) {
    const auto map = prepare(hall_map());
    int inside = 0;
    int all = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Scanning scanning(seed);
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> place(-5, 17);
        std::uniform_real_distribution<double> off(-1, 1);
        std::normal_distribution<double> normal;
        MonteCarlo particles(map, seed);
        const Pose2 truth{place(random), 0, 3 * normal(random)};
        const Pose2 told{truth.x_m + 0.07 * off(random), truth.y_m + 0.07 * off(random),
                         wrap(truth.heading_rad + 0.087 * off(random))};
        Held held{told, sigmas(0.05, 0.04)};
        for (int i = 0; i < 12; ++i) {
            const auto look =
                particles.look(held.pose, held.covariance, kNone, kNone, scanning.from(truth));
            EXPECT_GT(look.explained, i == 0 ? 0.3 : 0.85) << seed;
            EXPECT_LT(look.through, 0.05) << seed;
            held.fuse(look.news);
        }
        EXPECT_LT(distance(held.pose.position(), truth.position()), 0.05) << seed;
        EXPECT_LT(std::abs(wrap(held.pose.heading_rad - truth.heading_rad)), 0.01) << seed;
        // The map's own error is not in it: half a cell.
        for (const auto& [away, variance] :
             {std::pair{held.pose.x_m - truth.x_m, held.covariance(0, 0)},
              std::pair{held.pose.y_m - truth.y_m, held.covariance(1, 1)}}) {
            inside += std::abs(away) <= 1.96 * std::hypot(std::sqrt(variance), 0.015);
            ++all;
        }
    }
    EXPECT_GT(inside, 0.85 * all);
}

/// Nothing says that a corner is a multiple of the cell.
TEST(MonteCarlo, AMapMayLieAnywhere) {
    const geometry::Point2 away{1000.021, -300.013};
    auto moved = hall_map();
    moved.corner = moved.corner + away;
    MonteCarlo here(prepare(hall_map()), 1);
    MonteCarlo there(prepare(moved), 1);
    Scanning scanning(1);
    const Pose2 at{2, 0, 0.3};
    const auto& scans = scanning.from(at);
    const Pose2 at_there{at.x_m + away.x_m, at.y_m + away.y_m, at.heading_rad};
    const auto one = here.look(at, sigmas(0.05, 0.03), kNone, kNone, scans).check;
    const auto two = there.look(at_there, sigmas(0.05, 0.03), kNone, kNone, scans).check;
    ASSERT_TRUE(one.anything);
    EXPECT_LT(distance(one.pose.position() + away, two.pose.position()), 1e-6);
}

TEST(MonteCarlo, SeesThatItStandsSomewhereElse) {
    MonteCarlo particles(prepare(hall_map()), 1);
    Scanning scanning(1);
    const auto look =
        particles.look({}, sigmas(0.05, 0.03), kNone, kNone, scanning.from({13, -3.5, 1.2}));
    EXPECT_GT(look.returns, 50);
    EXPECT_LT(look.explained, 0.5);
    EXPECT_GT(look.through, 0.1);
}

TEST(MonteCarlo, WhereNothingStandsNearItTellsNothing) {
    auto empty = testing::hall_with_jigs();
    empty.areas.clear();
    empty.halls.front().outline = {{-100, -100}, {100, -100}, {100, 100}, {-100, 100}};
    Scanning scanning(1, empty);
    MonteCarlo particles(prepare(hall_map()), 1);
    const auto look = particles.look({}, sigmas(0.05, 0.03), kNone, kNone, scanning.from({}));
    EXPECT_EQ(look.returns, 0);
    EXPECT_FALSE(look.news.anything);
    EXPECT_GT(std::sqrt(look.news.covariance(0, 0)), 1) << "it has learned nothing";
}

TEST(MonteCarlo, TheSameSeedGivesTheSamePoses) {
    std::vector<Pose2> poses[2];
    for (auto& run : poses) {
        Scanning scanning(1);
        MonteCarlo particles(prepare(hall_map()), 5);
        MonteCarlo other(prepare(hall_map()), 6);  // draws between them
        for (int i = 0; i < 5; ++i) {
            const Pose2 at{0.15 * i, 0, 0};
            const auto& scans = scanning.from(at);
            run.push_back(particles.look(at, sigmas(0.05, 0.03), kNone, kNone, scans).check.pose);
            if (&run == &poses[1]) other.look(at, sigmas(0.05, 0.03), kNone, kNone, scans);
        }
    }
    EXPECT_EQ(poses[0], poses[1]);
}

}  // namespace
}  // namespace pulseline::mapping
