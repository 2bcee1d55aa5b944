#include "core/geometry/polygon.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pulseline::geometry {
namespace {

Polygon square(double x_m, double y_m, double side_m) {
    return transformed({x_m, y_m, 0}, rectangle(side_m, side_m));
}

double total_area(const std::vector<Polygon>& rings) {
    double sum = 0;
    for (const Polygon& ring : rings) sum += area_m2(ring);
    return sum;
}

TEST(Polygon, RectangleIsCentredAndCounterClockwise) {
    const Polygon r = rectangle(10.5, 2.5);

    EXPECT_DOUBLE_EQ(area_m2(r), 26.25);
    EXPECT_GT(cross(r[1] - r[0], r[2] - r[1]), 0);
    EXPECT_DOUBLE_EQ(bounding_box(r).max.x_m, 5.25);
    EXPECT_DOUBLE_EQ(bounding_box(r).min.y_m, -1.25);
}

TEST(Polygon, TransformKeepsAreaAndDistances) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-100, 100);
    for (int i = 0; i < 100; ++i) {
        const Pose2 pose{any(random), any(random), wrap(any(random))};
        const Polygon moved = transformed(pose, rectangle(4, 2));

        EXPECT_NEAR(area_m2(moved), 8, 1e-9);
        EXPECT_NEAR(distance(moved[0], moved[2]), std::hypot(4, 2), 1e-9);
        EXPECT_TRUE(contains(moved, pose.position()));
    }
}

TEST(Polygon, OnlyAWayThroughAnEdgeCrossesIt) {
    const Polygon square = rectangle(2, 2);
    EXPECT_TRUE(crosses(square, {-3, 0.2}, {3, 0.1}));
    EXPECT_TRUE(crosses(square, {0, 0}, {0, 5})) << "out of it";
    EXPECT_FALSE(crosses(square, {-0.5, 0}, {0.5, 0.3})) << "inside";
    EXPECT_FALSE(crosses(square, {-3, 2}, {3, 2})) << "beside";
    EXPECT_FALSE(crosses(square, {-3, 1}, {3, 1})) << "along an edge";
    EXPECT_FALSE(crosses(square, {0, 3}, {0, 1})) << "up to it";
    EXPECT_FALSE(crosses({}, {0, 0}, {1, 1}));
}

TEST(Polygon, BoundaryCountsAsInside) {
    const Polygon s = square(0, 0, 2);

    EXPECT_TRUE(contains(s, {1, 0.3}));
    EXPECT_TRUE(contains(s, {1, 1}));
    EXPECT_FALSE(contains(s, {1.001, 0}));
    EXPECT_FALSE(contains({}, {0, 0}));
}

TEST(Polygon, ContainsKnowsTheNotchOfAConcavePolygon) {
    const Polygon u = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};

    EXPECT_FALSE(contains(u, {1.5, 2}));
    EXPECT_TRUE(contains(u, {0.5, 2}));
}

TEST(Polygon, TouchingPolygonsIntersectAtDistanceZero) {
    EXPECT_TRUE(intersects(square(0, 0, 2), square(2, 0, 2)));
    EXPECT_EQ(distance(square(0, 0, 2), square(2, 0, 2)), 0);
    EXPECT_TRUE(intersects(square(0, 0, 2), square(2, 2, 2)));
}

TEST(Polygon, OneInsideTheOtherIntersects) {
    EXPECT_TRUE(intersects(square(0, 0, 10), square(1, 1, 1)));
    EXPECT_TRUE(intersects(square(1, 1, 1), square(0, 0, 10)));
    EXPECT_EQ(distance(square(0, 0, 10), square(1, 1, 1)), 0);
}

TEST(Polygon, CrossWithoutContainedCornersIntersects) {
    EXPECT_TRUE(intersects(rectangle(10, 1), rectangle(1, 10)));
    EXPECT_EQ(distance(rectangle(10, 1), rectangle(1, 10)), 0);
}

TEST(Polygon, DistanceIsSymmetricAndExactForBoxes) {
    EXPECT_DOUBLE_EQ(distance(square(0, 0, 2), square(5, 0, 2)), 3);
    EXPECT_DOUBLE_EQ(distance(square(5, 6, 2), square(0, 0, 2)), 5);
    EXPECT_FALSE(intersects(square(0, 0, 2), square(2.01, 0, 2)));
}

TEST(Polygon, HullHoldsAllPointsAndIsConvex) {
    std::mt19937 random(11);
    std::normal_distribution<double> any(0, 5);
    for (int run = 0; run < 50; ++run) {
        std::vector<Point2> points;
        for (int i = 0; i < 40; ++i) points.push_back({any(random), any(random)});
        const Polygon hull = convex_hull(points);

        for (const Point2& p : points) EXPECT_TRUE(contains(hull, p));
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const Point2 a = hull[i];
            const Point2 b = hull[(i + 1) % hull.size()];
            const Point2 c = hull[(i + 2) % hull.size()];
            EXPECT_GT(cross(b - a, c - b), 0);
        }
    }
}

TEST(Polygon, HullOfLinesAndPointsIsNoTrap) {
    EXPECT_TRUE(convex_hull({}).empty());
    EXPECT_EQ(convex_hull({{1, 1}, {1, 1}}).size(), 1u);
    EXPECT_EQ(convex_hull({{0, 0}, {1, 1}, {2, 2}, {3, 3}}).size(), 2u);
}

TEST(UnionOutline, OverlappingSquaresBecomeOneRing) {
    const auto rings = union_outline({square(0, 0, 2), square(1, 0, 2)});

    ASSERT_EQ(rings.size(), 1u);
    EXPECT_NEAR(area_m2(rings[0]), 6, 1e-6);
}

TEST(UnionOutline, ApartStaysApart) {
    const auto rings = union_outline({square(0, 0, 2), square(10, 0, 2)});

    EXPECT_EQ(rings.size(), 2u);
    EXPECT_NEAR(total_area(rings), 8, 1e-6);
}

TEST(UnionOutline, HolesAreFilled) {
    const auto rings = union_outline({transformed({0, 4, 0}, rectangle(10, 2)),
                                      transformed({0, -4, 0}, rectangle(10, 2)),
                                      transformed({4, 0, 0}, rectangle(2, 10)),
                                      transformed({-4, 0, 0}, rectangle(2, 10)), square(0, 0, 1)});

    ASSERT_EQ(rings.size(), 1u);
    EXPECT_NEAR(area_m2(rings[0]), 100, 1e-5);
}

TEST(UnionOutline, DegeneratePiecesAreDropped) {
    EXPECT_TRUE(union_outline({}).empty());
    EXPECT_TRUE(union_outline({{{0, 0}, {1, 1}}, {{0, 0}, {1, 1}, {2, 2}}}).empty());
    EXPECT_EQ(union_outline({square(0, 0, 1), {{std::nan(""), 0}, {1, 0}, {0, 1}}}).size(), 1u);
}

// Many nearly coincident pieces, as a slow sweep makes them: nothing may be lost, whatever rounding
// does to the touching edges.
TEST(UnionOutline, DenseSweepsLoseNothing) {
    std::mt19937 random(23);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int run = 0; run < 60; ++run) {
        const double turn = any(random) * (run % 3 == 0 ? 1e-7 : 0.03);
        const double step = any(random) * (run % 4 == 0 ? 0 : 0.1);
        Pose2 pose{100 * any(random), 100 * any(random), wrap(3 * any(random))};
        std::vector<Polygon> pieces;
        for (int i = 0; i < 60; ++i) {
            pieces.push_back(transformed(pose, rectangle(10.5, 2.5)));
            pieces.push_back(transformed(pose, {{-2, -5}, {1, -1.25}, {1, 1.25}, {-2, 5}}));
            pose = pose * Pose2{step, 0, turn};
        }
        const auto rings = union_outline(pieces);

        ASSERT_EQ(rings.size(), 1u) << run;
        const Polygon grown = rings[0];
        for (const Polygon& piece : pieces) {
            for (const Point2& p : piece) {
                EXPECT_TRUE(contains(grown, p) || distance(grown, {p, p, p}) < 5e-4) << run;
            }
        }
        EXPECT_LE(total_area(rings), area_m2(convex_hull([&] {
                                         std::vector<Point2> all;
                                         for (const Polygon& piece : pieces) {
                                             all.insert(all.end(), piece.begin(), piece.end());
                                         }
                                         return all;
                                     }())) +
                                         0.01);
    }
}

TEST(UnionOutline, GridOfTouchingSquaresIsOneRing) {
    std::vector<Polygon> pieces;
    for (int x = 0; x < 8; ++x) {
        for (int y = 0; y < 8; ++y) pieces.push_back(square(0.1 * x, 0.1 * y, 0.1));
    }
    const auto rings = union_outline(pieces);

    ASSERT_EQ(rings.size(), 1u);
    EXPECT_NEAR(area_m2(rings[0]), 0.64, 1e-3);
}

}  // namespace
}  // namespace pulseline::geometry
