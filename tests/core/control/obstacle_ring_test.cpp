#include "core/control/obstacle_ring.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::control {
namespace {

using geometry::Point2;
using geometry::Pose2;

TEST(ObstacleRing, NeverPromisesMoreRoomThanThereIs) {
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> share(-1, 1);
    for (const auto& type : {pulseline::testing::differential(), pulseline::testing::mecanum(),
                             pulseline::testing::platform()}) {
        ObstacleRing ring(type.footprint);
        const auto box = geometry::bounding_box(type.footprint);
        for (int run = 0; run < 400; ++run) {
            ring.clear(0.5);
            std::vector<Point2> obstacles;
            while (obstacles.size() < 300) {
                const Point2 p{(box.max.x_m + 0.4) * share(random),
                               (box.max.y_m + 0.4) * share(random)};
                if (ring.outline_distance_m(p) < 0.05) continue;
                obstacles.push_back(p);
                ring.add(p);
            }
            const Pose2 motion{0.1 * share(random), 0.1 * share(random), 0.03 * share(random)};
            double promised_m = 0.5;
            for (const auto& place : ring.places()) {
                promised_m = std::min(promised_m, ObstacleRing::distance_after(place, motion));
            }
            double real_m = 0.5;
            for (int i = 0; i <= 10; ++i) {
                const double s = i / 10.0;
                const Pose2 at{s * motion.x_m, s * motion.y_m, s * motion.heading_rad};
                for (const Point2 p : obstacles) {
                    real_m = std::min(real_m, ring.outline_distance_m(inverse(at) * p));
                }
            }
            ASSERT_LE(promised_m, real_m + 1e-9);
        }
        EXPECT_LE(ring.places().size(), 200u);
    }
}

TEST(ObstacleRing, AStraightShiftTowardsAWallIsExact) {
    ObstacleRing ring(geometry::rectangle(2, 1));
    ring.clear(0.5);
    for (int i = -40; i <= 40; ++i) ring.add({1.3, 0.01 * i});
    double left_m = 1;
    for (const auto& place : ring.places()) {
        left_m = std::min(left_m, ObstacleRing::distance_after(place, {0.2, 0, 0}));
    }
    EXPECT_NEAR(left_m, 0.1, 1e-9);
}

TEST(ObstacleRing, AllowsForThePointsItLeavesOut) {
    ObstacleRing ring(geometry::rectangle(2, 1));
    ring.clear(0.5);
    const Point2 corner{1, 0.5};
    const auto at = [&](double angle_deg, double distance_m) {
        const double angle = radians(angle_deg);
        return corner + distance_m * Point2{std::cos(angle), std::sin(angle)};
    };
    const Point2 left_out = at(5.5, 0.1001);
    ring.add(at(0.5, 0.1));
    ring.add(left_out);
    ASSERT_EQ(ring.places().size(), 1u);

    const Pose2 motion{0, 0.01, 0};
    EXPECT_LE(ObstacleRing::distance_after(ring.places()[0], motion),
              ring.outline_distance_m(inverse(motion) * left_out));
}

TEST(ObstacleRing, LeavesOutWhatIsFarOrNoNumber) {
    ObstacleRing ring(geometry::rectangle(2, 1));
    ring.clear(0.5);
    const double infinity = std::numeric_limits<double>::infinity();
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const Point2 p : {Point2{1.6, 0}, Point2{1.4, 0.9}, Point2{infinity, 0}, Point2{none, 0},
                           Point2{0, none}}) {
        ring.add(p);
        EXPECT_TRUE(ring.places().empty());
    }
    ring.add({0.9, 0.1});  // inside
    ASSERT_EQ(ring.places().size(), 1u);
    EXPECT_EQ(ring.places()[0].distance_m, 0);
}

}  // namespace
}  // namespace pulseline::control
