#include "core/geometry/convex.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace pulseline::geometry {
namespace {

bool convex(const Polygon& p) {
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Point2 a = p[i];
        const Point2 b = p[(i + 1) % p.size()];
        const Point2 c = p[(i + 2) % p.size()];
        if (cross(b - a, c - b) < 0) return false;
    }
    return p.size() >= 3;
}

TEST(IsSimple, SeesCrossingFoldingAndRepeatedPoints) {
    EXPECT_TRUE(is_simple({{0, 0}, {1, 0}, {1, 1}}));
    EXPECT_FALSE(is_simple({{0, 0}, {1, 0}}));
    EXPECT_FALSE(is_simple({{0, 0}, {1, 1}, {1, 0}, {0, 1}}));
    EXPECT_FALSE(is_simple({{0, 0}, {0, 0}, {1, 0}, {1, 1}}));
    EXPECT_FALSE(is_simple({{0, 0}, {2, 0}, {1, 0}, {1, 1}}));
    EXPECT_FALSE(is_simple({{0, 0}, {1, 1}, {2, 2}}));
}

TEST(ConvexPieces, ConvexPolygonStaysWhole) {
    EXPECT_EQ(convex_pieces(rectangle(3, 2)).size(), 1u);
}

TEST(ConvexPieces, StarShapesAreCoveredExactly) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> radius(1, 6);
    for (int run = 0; run < 200; ++run) {
        Polygon star;
        const int n = 5 + run % 20;
        for (int i = 0; i < n; ++i) {
            const double a = 2 * kPi * i / n;
            const double r = radius(random);
            star.push_back({r * std::cos(a), r * std::sin(a)});
        }
        double sum = 0;
        for (const Polygon& piece : convex_pieces(star)) {
            EXPECT_TRUE(convex(piece));
            sum += area_m2(piece);
        }
        EXPECT_NEAR(sum, area_m2(star), 1e-9);
    }
}

TEST(ConvexPieces, ClockwiseInputIsTurnedRound) {
    Polygon u = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
    std::reverse(u.begin(), u.end());
    double sum = 0;
    const auto pieces = convex_pieces(u);
    for (const Polygon& piece : pieces) {
        EXPECT_TRUE(convex(piece));
        sum += area_m2(piece);
    }

    EXPECT_NEAR(sum, 7, 1e-12);
    EXPECT_LE(pieces.size(), 4u);
}

TEST(ConvexPieces, CrossedOutlineFallsBackToItsHull) {
    const auto pieces = convex_pieces({{0, 0}, {1, 1}, {1, 0}, {0, 1}});

    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_NEAR(area_m2(pieces[0]), 1, 1e-12);
}

TEST(Convex, ClippedKeepsWhatLiesInTheBox) {
    const Box box{{0, 0}, {4, 2}};

    EXPECT_DOUBLE_EQ(area_m2(clipped({{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, box)), 8);
    EXPECT_DOUBLE_EQ(area_m2(clipped({{1, 1}, {2, 1}, {2, 2}}, box)), 0.5);
    EXPECT_DOUBLE_EQ(area_m2(clipped({{0, 0}, {4, 0}, {0, 4}}, box)), 6);
    EXPECT_TRUE(clipped({{5, 5}, {6, 5}, {6, 6}}, box).empty());
}

}  // namespace
}  // namespace pulseline::geometry
