#include "core/kinematics/past_poses.hpp"

#include <gtest/gtest.h>

namespace pulseline::kinematics {
namespace {

TEST(PastPoses, LieBetweenThoseThatWereAdded) {
    PastPoses past;
    past.add({0, 0, 0}, 0, 1);
    past.add({1, 0, 0.2}, 0.1, 1);
    past.add({3, 0, 0.2}, 0.1, 1);
    EXPECT_EQ(past.at(0), (geometry::Pose2{3, 0, 0.2}));
    EXPECT_NEAR(distance(past.at(0.05).position(), {2, 0}), 0, 1e-12);
    EXPECT_NEAR(past.at(0.15).heading_rad, 0.1, 1e-12);
    EXPECT_NEAR(distance(past.at(0.2).position(), {0, 0}), 0, 1e-12);
    EXPECT_TRUE(past.reach_back(0.2));
    EXPECT_FALSE(past.reach_back(0.21));
    EXPECT_EQ(past.at(5), (geometry::Pose2{0, 0, 0}));
}

TEST(PastPoses, ReachBackAsFarAsTheyAreKept) {
    PastPoses past;
    EXPECT_FALSE(past.reach_back(0));
    for (int i = 0; i < 100; ++i) past.add({0.1 * i, 0, 0}, 0.03, 0.2);
    EXPECT_TRUE(past.reach_back(0.2));
    EXPECT_FALSE(past.reach_back(0.25));
    past.clear();
    EXPECT_FALSE(past.reach_back(0));
}

}  // namespace
}  // namespace pulseline::kinematics
