#include "core/planning/manoeuvre/reeds_shepp.hpp"

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>

#include <cmath>
#include <random>

namespace pulseline::planning {
namespace {

using geometry::Pose2;

Pose2 random_goal(std::mt19937_64& random, double extent) {
    std::uniform_real_distribution<double> x(-extent, extent);
    std::uniform_real_distribution<double> turn(-kPi, kPi);
    return {x(random), x(random), turn(random)};
}

TEST(ReedsShepp, EveryPathEndsAtTheGoal) {
    std::mt19937_64 random(1);
    std::vector<RsPath> paths;
    for (int i = 0; i < 5000; ++i) {
        const Pose2 goal = random_goal(random, i % 2 == 0 ? 8 : 1.5);
        reeds_shepp_paths(goal, paths);
        ASSERT_FALSE(paths.empty());
        for (const RsPath& path : paths) {
            Pose2 at;
            double length = 0;
            for (int k = 0; k < path.count; ++k) {
                const RsPiece& piece = path.pieces[static_cast<std::size_t>(k)];
                at = at * rs_moved(piece, piece.length);
                length += std::abs(piece.length);
            }
            EXPECT_NEAR(at.x_m, goal.x_m, 1e-9);
            EXPECT_NEAR(at.y_m, goal.y_m, 1e-9);
            EXPECT_NEAR(wrap(at.heading_rad - goal.heading_rad), 0, 1e-9);
            EXPECT_NEAR(path.length, length, 1e-12);
            EXPECT_GE(path.length, paths.front().length);
        }
    }
}

TEST(ReedsShepp, TheShortestIsAsShortAsOmplsOwn) {
    ompl::base::ReedsSheppStateSpace space(1.0);
    std::mt19937_64 random(2);
    std::vector<RsPath> paths;
    for (int i = 0; i < 5000; ++i) {
        const Pose2 goal = random_goal(random, i % 2 == 0 ? 8 : 1.5);
        auto* from = space.allocState()->as<ompl::base::SE2StateSpace::StateType>();
        auto* to = space.allocState()->as<ompl::base::SE2StateSpace::StateType>();
        from->setXY(0, 0);
        from->setYaw(0);
        to->setXY(goal.x_m, goal.y_m);
        to->setYaw(goal.heading_rad);
        reeds_shepp_paths(goal, paths);
        ASSERT_FALSE(paths.empty());
        EXPECT_NEAR(paths.front().length, space.distance(from, to), 1e-9);
        EXPECT_NEAR(reeds_shepp_length(goal), paths.front().length, 1e-9);
        space.freeState(from);
        space.freeState(to);
    }
}

TEST(ReedsShepp, FindsAPathWhereCirclesTouch) {
    std::vector<RsPath> paths;
    for (int x = -8; x <= 8; ++x) {
        for (int y = -8; y <= 8; ++y) {
            for (int eighth = -3; eighth <= 4; ++eighth) {
                const Pose2 goal{x / 2.0, y / 2.0, eighth * kPi / 4};
                reeds_shepp_paths(goal, paths);
                ASSERT_FALSE(paths.empty());
                // The shortest one may fall to rounding there, but not to a much longer one.
                EXPECT_LT(paths.front().length, reeds_shepp_length(goal) + 2.0)
                    << x << ' ' << y << ' ' << eighth;
            }
        }
    }
}

TEST(ReedsShepp, StraightAheadBehindAndInPlace) {
    std::vector<RsPath> paths;

    reeds_shepp_paths({7, 0, 0}, paths);
    ASSERT_FALSE(paths.empty());
    EXPECT_EQ(paths.front().count, 1);
    EXPECT_NEAR(paths.front().pieces[0].length, 7, 1e-12);

    reeds_shepp_paths({-7, 0, 0}, paths);
    ASSERT_FALSE(paths.empty());
    EXPECT_EQ(paths.front().count, 1);
    EXPECT_NEAR(paths.front().pieces[0].length, -7, 1e-12);

    reeds_shepp_paths({0, 0, kPi}, paths);  // half a turn in place: three arcs of 60 deg
    ASSERT_FALSE(paths.empty());
    EXPECT_NEAR(paths.front().length, kPi, 1e-9);
    EXPECT_GT(paths.front().reversals, 0);
}

}  // namespace
}  // namespace pulseline::planning
