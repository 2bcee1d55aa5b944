#include "core/planning/room/footprint_check.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/planning/room/obstacles.hpp"

namespace pulseline::planning {
namespace {

using geometry::Polygon;
using geometry::Pose2;

/// A hall with a corner cut off, a no-go area, a thin obstacle and marks on a map.
plant::Plant cluttered_hall(std::mt19937_64& random) {
    plant::Plant plant;
    plant::Hall hall;
    hall.id = plant::HallId("hall");
    hall.outline = {{0, 0}, {60, 0}, {60, 25}, {50, 40}, {0, 40}};
    hall.grid.width = 590;  // a little smaller than the hall
    hall.grid.height = 400;
    hall.grid.resolution_m = 0.1;
    hall.grid.occupied.assign(590 * 400, 0);
    for (int i = 0; i < 15; ++i) {
        const auto col = random() % 570;
        const auto row = random() % 380;
        for (std::size_t y = row; y < row + 1 + random() % 18; ++y) {
            for (std::size_t x = col; x < col + 1 + random() % 18; ++x) {
                hall.grid.occupied[y * 590 + x] = 1;
            }
        }
    }
    plant.halls.push_back(hall);
    plant.areas.push_back({plant::AreaId("no-go"),
                           plant::AreaKind::kNoGo,
                           "no-go",
                           hall.id,
                           {{20, 8}, {30, 8}, {24, 12}, {30, 18}, {20, 18}},
                           {}});
    plant.areas.push_back({plant::AreaId("rope"),
                           plant::AreaKind::kObstacle,
                           "rope",
                           hall.id,
                           {{35, 25}, {45, 31}, {35, 25.02}},
                           {}});
    plant.areas.push_back({plant::AreaId("lane"),
                           plant::AreaKind::kLane,
                           "lane",
                           hall.id,
                           {{0, 0}, {60, 0}, {60, 40}},
                           {}});
    return plant;
}

const Polygon kPlatform = geometry::rectangle(10.5, 2.5);
const Polygon kParked = geometry::transformed({12, 30, 0.7}, geometry::rectangle(3.2, 2.1));

struct Body {
    std::vector<Polygon> pieces;
    double clearance_m;
};
const std::vector<Body> kBodies{
    {{kPlatform}, 0.5},
    {{geometry::rectangle(1.6, 1.1)}, 0.2},
    {{geometry::rectangle(2.4, 1.4)}, 0.0},
    {{{{0, -1}, {4, -1}, {4, 1}, {0, 1}}, {{-3, -4}, {0, -4}, {0, 4}, {-3, 4}}}, 0.35}};

class Judge {
public:
    Judge(const plant::Plant& plant, const Body& body)
        : obstacles_(plant, plant.halls.front()), body_(body) {}

    /// Exactly: the body keeps `clearance_m` at the pose.
    bool keeps(const Pose2& pose, double clearance_m) const {
        std::vector<Polygon> pieces;
        for (const Polygon& piece : body_.pieces) {
            pieces.push_back(geometry::transformed(pose, piece));
        }
        for (const Polygon& piece : pieces) {
            if (geometry::distance(piece, kParked) < clearance_m) return false;
        }
        return obstacles_.keeps(pieces, obstacles_.limits(clearance_m));
    }

private:
    Obstacles obstacles_;
    const Body& body_;
};

Pose2 random_pose(std::mt19937_64& random) {
    std::uniform_real_distribution<double> x(-2, 62);
    std::uniform_real_distribution<double> y(-2, 42);
    std::uniform_real_distribution<double> turn(-kPi, kPi);
    return {x(random), y(random), turn(random)};
}

TEST(FootprintCheck, NeverFindsFreeWhatTheExactTestBlocks) {
    std::mt19937_64 random(3);
    const auto plant = cluttered_hall(random);
    FloorField field(plant, plant.halls.front(), 2.5);
    field.add({kParked});
    for (const Body& body : kBodies) {
        const FootprintCheck check(body.pieces, body.clearance_m, field);
        const Judge judge(plant, body);
        int free = 0;
        for (int i = 0; i < 10'000; ++i) {
            const Pose2 pose = random_pose(random);
            if (!check.is_free(field, pose)) continue;
            ++free;
            ASSERT_TRUE(judge.keeps(pose, body.clearance_m))
                << "body " << &body - kBodies.data() << " at " << pose.x_m << ' ' << pose.y_m << ' '
                << pose.heading_rad;
        }
        EXPECT_GT(free, 2000);
        EXPECT_LT(free, 9000);
    }
}

TEST(FootprintCheck, FindsFreeWhatKeepsTheStatedExcess) {
    std::mt19937_64 random(4);
    const auto plant = cluttered_hall(random);
    FloorField field(plant, plant.halls.front(), 2.5);
    field.add({kParked});
    for (const Body& body : kBodies) {
        const FootprintCheck check(body.pieces, body.clearance_m, field);
        const Judge judge(plant, body);
        const double kept_m = body.clearance_m + check.excess_m();
        int free = 0;
        for (int i = 0; i < 4000; ++i) {
            const Pose2 pose = random_pose(random);
            // The exact test keeps no clearance to the border of the map at x = 59.
            if (pose.x_m > 58.4 - check.reach_m() || !judge.keeps(pose, kept_m)) continue;
            ++free;
            EXPECT_TRUE(check.is_free(field, pose));
        }
        EXPECT_GT(free, 500);
    }
    EXPECT_NEAR(FootprintCheck({kPlatform}, 0.5, field).excess_m(), 0.015, 0.0005);
}

TEST(FootprintCheck, MovesNoFartherThanTheSlackStayFree) {
    std::mt19937_64 random(5);
    const auto plant = cluttered_hall(random);
    FloorField field(plant, plant.halls.front(), 2.5);
    field.add({kParked});
    const Body& body = kBodies.front();
    const FootprintCheck check(body.pieces, body.clearance_m, field);
    const Judge judge(plant, body);
    std::uniform_real_distribution<double> share(-1, 1);
    int moved = 0;
    while (moved < 2000) {
        const Pose2 pose = random_pose(random);
        const double slack = check.slack_m(field, pose);
        if (slack < 0) continue;
        ++moved;
        // A turn by half the slack and a way of half the slack.
        const double bearing = kPi * share(random);
        const Pose2 to{pose.x_m + slack / 2 * std::cos(bearing),
                       pose.y_m + slack / 2 * std::sin(bearing),
                       pose.heading_rad + share(random) * slack / 2 / check.reach_m()};
        EXPECT_TRUE(judge.keeps(to, body.clearance_m));
    }
}

TEST(FloorField, ACopyWithABodyLeavesTheOriginalAlone) {
    std::mt19937_64 random(6);
    const auto plant = cluttered_hall(random);
    const FloorField field(plant, plant.halls.front(), 2.5);
    const double before = field.distance_m({12, 30});

    FloorField with = field;
    with.add({kParked});

    EXPECT_EQ(with.distance_m({12, 30}), 0);
    EXPECT_EQ(field.distance_m({12, 30}), before);
    EXPECT_GT(before, 0);
}

TEST(FloorField, IsZeroOutsideTheHallAndOffItsMap) {
    std::mt19937_64 random(7);
    const auto plant = cluttered_hall(random);
    const FloorField field(plant, plant.halls.front(), 2.5);
    for (const geometry::Point2 at : {geometry::Point2{-1, 5},
                                      {-1e9, 5},
                                      {58, 39},
                                      {59.5, 10},
                                      {10, 41},
                                      {24, 10},
                                      {1e12, 1e12}}) {
        EXPECT_LT(field.distance_m(at), field.needed_m(0)) << at.x_m << ' ' << at.y_m;
    }
    EXPECT_GT(field.distance_m({10, 20}), 0);
}

}  // namespace
}  // namespace pulseline::planning
