#include "core/mapping/surfaces.hpp"

#include <gtest/gtest.h>

namespace pulseline::mapping {
namespace {

/// A face along x at `y_m`, of which rays tell y alone.
Met wall(double y_m) {
    Met met;
    met.across << 0, 1, 1, 0;
    met.worth = {1, 0};
    met.middle = {0, y_m};
    return met;
}

Eigen::Matrix<double, 2, 3> at(double x_m, double y_m) {
    Eigen::Matrix<double, 2, 3> moves;
    moves << 1, 0, -y_m, 0, 1, x_m;
    return moves;
}

void meet(Surfaces& surfaces, double y_m, int rays) {
    for (int i = 0; i < rays; ++i) surfaces.add(wall(y_m), at(i - (rays - 1) / 2.0, y_m));
}

/// Variance of y by these rays, of what the walls are off by one unit each.
double off2(const Surfaces& surfaces) {
    double sum = 0;
    for (const auto& answer : surfaces.answers()) {
        sum += answer.y() * answer.y();
    }
    return sum / (surfaces.information()(1, 1) * surfaces.information()(1, 1));
}

TEST(Surfaces, MoreRaysOnOneWallDoNotMakeItBetter) {
    for (const int rays : {1, 5, 40}) {
        Surfaces surfaces;
        meet(surfaces, 3, rays);
        EXPECT_NEAR(off2(surfaces), 1, 1e-9) << rays;
        EXPECT_NEAR(surfaces.information()(1, 1), rays, 1e-9);
        EXPECT_EQ(surfaces.information()(0, 0), 0) << "it tells nothing along itself";
    }
}

TEST(Surfaces, TwoWallsAreOffEachByItself) {
    Surfaces surfaces;
    meet(surfaces, 3, 20);
    meet(surfaces, -3, 20);
    EXPECT_NEAR(off2(surfaces), 0.5, 1e-9);
}

TEST(Surfaces, WhatLiesInOneLineIsOneWallThoughItsRowsOfCellsAreTwo) {
    Surfaces surfaces;
    meet(surfaces, 3, 20);
    meet(surfaces, 3.05, 20);
    EXPECT_EQ(surfaces.answers().size(), 1u);
    EXPECT_NEAR(off2(surfaces), 1, 1e-9);
}

TEST(Surfaces, AWallIsOneFromWhicheverSideItsFaceIsTold) {
    Surfaces surfaces;
    meet(surfaces, 3, 20);
    Met other = wall(3);
    other.across.col(0) = -other.across.col(0);
    for (int i = 0; i < 20; ++i) surfaces.add(other, at(i, 3));
    EXPECT_EQ(surfaces.answers().size(), 1u);
    EXPECT_NEAR(off2(surfaces), 1, 1e-9);
}

TEST(Surfaces, ACornerTellsBothWays) {
    Surfaces surfaces;
    Met corner = wall(3);
    corner.worth = {1, 0.5};
    surfaces.add(corner, at(2, 3));
    EXPECT_EQ(surfaces.answers().size(), 2u);
    EXPECT_NEAR(surfaces.information()(0, 0), 0.5, 1e-9);
    EXPECT_NEAR(surfaces.information()(1, 1), 1, 1e-9);
}

}  // namespace
}  // namespace pulseline::mapping
