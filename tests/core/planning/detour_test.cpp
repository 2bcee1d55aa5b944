#include "core/planning/detour/detour.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/core/planning/detour_world.hpp"

namespace pulseline::planning {
namespace {

using namespace testing;
using geometry::Polygon;
using kinematics::Segment;

constexpr double kRounding_m = 2e-3;
constexpr double kBefore_m = 0.4;  // of a thing, where the fields stop a vehicle

std::string why(const Result<Detour>& detour) {
    return detour ? "found" : detour.error().reason.code;
}

/// Some band of an edge not yet passed holds the point with the margin.
bool in_a_band(const DetourWorld& world, std::size_t passed, Point2 p) {
    const double reach = reach_m(world.type);
    for (std::size_t i = passed; i < world.stretch.size(); ++i) {
        const double from_m = i > 0 ? world.ends_m[i - 1] : 0;
        const auto& room = world.stretch[i].corridor;
        if (p.x_m >= from_m - reach && p.x_m <= world.ends_m[i] + reach &&
            p.y_m <= room.left_m - kBandMargin_m + kRounding_m &&
            p.y_m >= -room.right_m + kBandMargin_m - kRounding_m) {
            return true;
        }
    }
    return false;
}

Polygon fine(const Polygon& outline) {
    Polygon points;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point2 along = outline[(i + 1) % outline.size()] - outline[i];
        for (double s = 0; s < 1; s += 0.25 / norm(along)) points.push_back(outline[i] + s * along);
    }
    return points;
}

/// The laws of detour.hpp, by places some centimetres apart.
void expect_lawful(const DetourWorld& world, const DetourRequest& request, const Detour& detour) {
    const Pose2 line_from_hall = inverse(world.hall_from_line);
    const Polygon outline = fine(world.type.footprint);
    ASSERT_FALSE(detour.pieces.empty());
    ASSERT_GE(detour.edges, 1u);
    const double goal_m = world.ends_m[detour.edges - 1];
    EXPECT_EQ(detour.pieces.back().segment.end, world.stretch[detour.edges - 1].end);
    EXPECT_LT(distance(detour.pieces.front().segment.start.position(), request.start.position()),
              1e-9);
    std::size_t passed = 0;
    for (std::size_t i = 0; i < detour.pieces.size(); ++i) {
        const Segment& segment = detour.pieces[i].segment;
        if (i > 0) {
            const Pose2& before = detour.pieces[i - 1].segment.end;
            EXPECT_LT(distance(before.position(), segment.start.position()), 1e-6);
            EXPECT_LT(std::abs(wrap(before.heading_rad - segment.start.heading_rad)), 1e-6);
        }
        const double way_m = std::abs(segment.length_m) + 6 * std::abs(segment.turn_rad);
        const int steps = 1 + static_cast<int>(way_m / 0.03);
        for (int k = 0; k <= steps; ++k) {
            const Pose2 at = line_from_hall * kinematics::pose_at(segment, double(k) / steps);
            ASSERT_LE(at.x_m, goal_m + kRounding_m) << "past the end";
            const double kept_m = passed > 0 ? world.ends_m[passed - 1] : 0;
            ASSERT_GE(at.x_m, kept_m - kRounding_m) << "behind a node that was passed";
            for (const Point2& p : geometry::transformed(at, outline)) {
                ASSERT_TRUE(in_a_band(world, passed, p)) << p.x_m << ", " << p.y_m;
            }
            const Polygon body = geometry::transformed(at, world.type.footprint);
            for (const Polygon& thing : world.things) {
                ASSERT_GE(geometry::distance(body, thing), kDetourClearance_m - 1e-9);
            }
        }
        passed += detour.pieces[i].nodes_passed;
    }
    EXPECT_EQ(passed, detour.edges);
}

class DetourTest : public ::testing::TestWithParam<std::size_t> {
protected:
    plant::VehicleType type = families()[GetParam()];
    double thing_m = 8 + front_m(type);  // along the line, where it stands
    Pose2 start{thing_m - 0.25 - kBefore_m - front_m(type), 0.003, 0.0005};
};

TEST_P(DetourTest, GoesRoundABoxOnItsLine) {
    for (const double y_m : {-0.8, -0.3, 0.0, 0.3, 0.8}) {
        DetourWorld world(type);
        if (std::abs(y_m) > half_width_m(type)) continue;
        world.put_box(thing_m, y_m);
        const auto request = world.request(start);
        const auto detour = plan_detour(request);
        ASSERT_TRUE(detour) << why(detour) << " at " << y_m;
        expect_lawful(world, request, *detour);
        EXPECT_EQ(detour->sideways, GetParam() < 2);
        if (y_m == 0) continue;
        EXPECT_EQ(detour->beside_m > 0, y_m < 0) << "the nearer side";
    }
}

TEST_P(DetourTest, TakesTheSideThatHasRoom) {
    DetourWorld world(type, 0);
    for (int i = 0; i < 8; ++i)
        world.add_edge(4, half_width_m(type) + 0.6, half_width_m(type) + 3.5);
    world.put_box(thing_m, -0.1);
    const auto request = world.request(start);
    const auto detour = plan_detour(request);
    ASSERT_TRUE(detour) << why(detour);
    EXPECT_LT(detour->beside_m, 0);
}

TEST_P(DetourTest, FindsNoRoomInANarrowCorridor) {
    DetourWorld world(type, 8, 0.3);
    world.put_box(thing_m, 0);
    EXPECT_EQ(why(plan_detour(world.request(start))), "no_room");
}

TEST_P(DetourTest, FindsNoRoomBesideAWall) {
    DetourWorld world(type);
    world.put({{thing_m, -4}, {thing_m + 0.2, -4}, {thing_m + 0.2, 4}, {thing_m, 4}});
    EXPECT_EQ(why(plan_detour(world.request(start))), "no_room");
}

TEST_P(DetourTest, NeedsAPlaceOnTheLineBehindTheThing) {
    DetourWorld world(type, 0);
    world.add_edge(thing_m - 2, 4, 4);
    world.add_edge(2 + front_m(type), 4, 4);
    world.put_box(thing_m, 0);
    EXPECT_EQ(why(plan_detour(world.request(start))), "ends_too_near");
}

TEST_P(DetourTest, PlansNothingWithoutAReasonOrACorridor) {
    DetourWorld world(type);
    EXPECT_EQ(why(plan_detour(world.request(start))), "nothing_in_the_way");
    world.stretch.clear();
    EXPECT_EQ(why(plan_detour(world.request(start))), "no_corridor");
}

TEST_P(DetourTest, PlansAnewFromBesideTheLine) {
    DetourWorld world(type);
    world.put_box(thing_m, 0);
    const auto first = plan_detour(world.request(start));
    ASSERT_TRUE(first) << why(first);
    Pose2 there;
    for (std::size_t i = 0; std::abs(there.y_m) < 0.3; ++i)
        there = inverse(world.hall_from_line) * first->pieces.at(i).segment.end;
    const double side = first->beside_m > 0 ? 1 : -1;
    // Behind the first thing there is another one, beside the line.
    world.put_box(thing_m + 1.2, side * 0.4);
    const auto request = world.request(there);
    const auto again = plan_detour(request);
    ASSERT_TRUE(again) << why(again);
    expect_lawful(world, request, *again);
}

TEST_P(DetourTest, HoldsItsLawsAmongThingsAtRandom) {
    std::mt19937_64 random(17);
    const auto uniform = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    int found = 0;
    for (int i = 0; i < 40; ++i) {
        DetourWorld world(type, 0);
        while (world.end_m() < 32) {
            const double half_m = half_width_m(type);
            world.add_edge(uniform(1, 4), half_m + uniform(2, 4), half_m + uniform(2, 4));
        }
        world.put_box(thing_m, uniform(-0.5, 0.5), uniform(0.2, 0.8));
        for (int k = 0; k < 2; ++k)
            world.put_box(thing_m + uniform(1, 8), uniform(-3, 3), uniform(0.2, 0.8));
        const auto request = world.request(start);
        const auto detour = plan_detour(request);
        if (!detour) continue;
        ++found;
        expect_lawful(world, request, *detour);
        if (HasFatalFailure()) return;
        const auto again = plan_detour(request);
        ASSERT_TRUE(again);
        EXPECT_EQ(again->length_m, detour->length_m);
    }
    EXPECT_GE(found, 15);
}

INSTANTIATE_TEST_SUITE_P(Families, DetourTest, ::testing::Values(0, 1, 2));

TEST(Detour, ALoadStaysInsideTheBandToo) {
    DetourWorld world(families()[1]);
    world.type.load_footprint = geometry::rectangle(3, 2.6);
    world.put_box(10, 0);
    auto request = world.request({10 - 0.25 - kBefore_m - 1.5, 0, 0});
    request.loaded = true;
    const auto detour = plan_detour(request);
    ASSERT_TRUE(detour) << why(detour);
    world.type.footprint = world.type.load_footprint;  // which holds it
    expect_lawful(world, request, *detour);
}

TEST(Detour, AVehicleThatDrivesSidewaysAlongItsLineGoesRoundAsWell) {
    DetourWorld world(families()[1], 0);
    for (int i = 0; i < 8; ++i) world.add_edge(4, 3.5, 3.5);
    for (auto& edge : world.stretch) {
        edge.start.heading_rad = wrap(edge.start.heading_rad + kPi / 2);
        edge.end.heading_rad = wrap(edge.end.heading_rad + kPi / 2);
    }
    world.put_box(10, 0.2);
    const auto request = world.request({10 - 0.25 - kBefore_m - 0.7, 0, kPi / 2});
    const auto detour = plan_detour(request);
    ASSERT_TRUE(detour) << why(detour);
    expect_lawful(world, request, *detour);
}

}  // namespace
}  // namespace pulseline::planning
