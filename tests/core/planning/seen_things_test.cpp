#include "core/planning/detour/seen_things.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace pulseline::planning {
namespace {

using geometry::Point2;

bool held(const std::vector<StandingBody>& things, Point2 p) {
    return std::any_of(things.begin(), things.end(), [&](const StandingBody& thing) {
        return geometry::contains(thing.outline.front(), p);
    });
}

TEST(SeenThings, HoldEveryPointInSmallPieces) {
    std::vector<Point2> points;
    for (int i = 0; i < 100; ++i) points.push_back({i * 0.04, 1});
    for (int i = 0; i < 100; ++i) points.push_back({4, 1 + i * 0.04});
    const auto things = seen_things(points);
    for (const Point2& p : points) EXPECT_TRUE(held(things, p));
    EXPECT_FALSE(held(things, {2, 3})) << "the inner side of a corner is free";
    EXPECT_LE(things.size(), 32u);
    for (const auto& thing : things) {
        const auto box = geometry::bounding_box(thing.outline.front());
        EXPECT_LE(box.max.x_m - box.min.x_m, kPiece_m + kPoint_m + 1e-9);
    }
}

TEST(SeenThings, DoNotDependOnTheOrderOfThePoints) {
    std::vector<Point2> points;
    for (int i = 0; i < 30; ++i) points.push_back({(i * 7) % 30 * 0.1, (i * 11) % 30 * 0.1});
    const auto once = seen_things(points);
    std::reverse(points.begin(), points.end());
    const auto again = seen_things(points);
    ASSERT_EQ(once.size(), again.size());
    for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].outline, again[i].outline);
    EXPECT_TRUE(seen_things({}).empty());
}

}  // namespace
}  // namespace pulseline::planning
