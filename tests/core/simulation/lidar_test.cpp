#include "core/simulation/world/lidar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pulseline::simulation {
namespace {

using geometry::Point2;
using geometry::Polygon;
using geometry::Pose2;

const Polygon kRoom{{0, 0}, {12, 0}, {12, 8}, {0, 8}};
const std::vector<Polygon> kRooms{kRoom};

plant::LaserScanner exact(const Pose2& mount = {}) {
    plant::LaserScanner scanner;
    scanner.body_from_scanner = mount;
    scanner.sigma_m = 0;
    return scanner;
}

Point2 place_of(const control::Scan& scan, std::size_t i, const Pose2& hall_from_body) {
    const double angle = scan.first_rad + static_cast<double>(i) * scan.step_rad;
    return hall_from_body * scan.body_from_sensor *
           Point2{scan.ranges_m[i] * std::cos(angle), scan.ranges_m[i] * std::sin(angle)};
}

/// Distance from the origin of a ray to the nearest edge, by trying every edge.
double nearest(Point2 from, double angle, const std::vector<Polygon>& polygons) {
    const Point2 ray{std::cos(angle), std::sin(angle)};
    double least = std::numeric_limits<double>::infinity();
    for (const Polygon& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Point2 a = polygon[i] - from;
            const Point2 way = polygon[(i + 1) % polygon.size()] - polygon[i];
            const double parallel = cross(ray, way);
            if (parallel == 0) continue;
            const double range = cross(a, way) / parallel;
            const double share = cross(a, ray) / parallel;
            if (range > 0 && share >= 0 && share <= 1) least = std::min(least, range);
        }
    }
    return least;
}

TEST(Lidar, SeesTheNearestEdgeAlongEveryRay) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> share(0, 1);
    for (int run = 0; run < 50; ++run) {
        std::vector<Polygon> fixed{kRoom};
        std::vector<Polygon> others;
        for (int i = 0; i < 12; ++i) {
            const Pose2 at{12 * share(random), 8 * share(random), 6 * share(random)};
            auto& where = i % 2 == 0 ? fixed : others;
            where.push_back(transformed(at, geometry::rectangle(1.2, 0.4)));
        }
        const Pose2 mount{0.3, -0.1, 0.7};
        const Pose2 body{1 + 10 * share(random), 1 + 6 * share(random), 6 * share(random)};
        const Lidar lidar(exact(mount), fixed);
        control::Scan scan;
        lidar.scan(body, others, random, scan);
        ASSERT_EQ(scan.ranges_m.size(), 1081u);

        std::vector<Polygon> all = fixed;
        all.insert(all.end(), others.begin(), others.end());
        const Pose2 sensor = body * mount;
        for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
            const double angle =
                sensor.heading_rad + scan.first_rad + static_cast<double>(i) * scan.step_rad;
            const double range = nearest(sensor.position(), angle, all);
            if (range < 0.06 || range > 10) {
                ASSERT_FALSE(std::isfinite(scan.ranges_m[i]));
            } else {
                ASSERT_NEAR(scan.ranges_m[i], range, 1e-4) << run << " ray " << i;
            }
        }
    }
}

TEST(Lidar, ErrsByTheStatedNoiseAndNeverMore) {
    const Lidar lidar(plant::LaserScanner{}, kRooms);
    std::mt19937_64 random(3);
    control::Scan scan;
    double sum = 0;
    double sum2 = 0;
    int n = 0;
    for (int run = 0; run < 20; ++run) {
        const Pose2 body{6, 4, 0.3 * run};
        lidar.scan(body, {}, random, scan);
        for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
            const double angle =
                body.heading_rad + scan.first_rad + static_cast<double>(i) * scan.step_rad;
            const double error = scan.ranges_m[i] - nearest(body.position(), angle, kRooms);
            ASSERT_LE(std::abs(error), 0.0401);
            sum += error;
            sum2 += error * error;
            ++n;
        }
    }
    EXPECT_NEAR(sum / n, 0, 5e-4);
    EXPECT_NEAR(std::sqrt(sum2 / n), plant::LaserScanner{}.sigma_m, 5e-4);
}

TEST(Lidar, LooksBackNoFartherThanItsField) {
    const Polygon behind = transformed({-2, 0, 0}, geometry::rectangle(0.2, 1.0));
    const Polygon aside = transformed({0, 2, 0}, geometry::rectangle(0.2, 0.2));
    std::mt19937_64 random(4);
    control::Scan scan;
    Lidar(exact(), std::vector<Polygon>{behind}).scan({}, {}, random, scan);
    for (const float range : scan.ranges_m) EXPECT_FALSE(std::isfinite(range));
    Lidar(exact(), std::vector<Polygon>{aside}).scan({}, {}, random, scan);
    int seen = 0;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
        if (!std::isfinite(scan.ranges_m[i])) continue;
        ++seen;
        EXPECT_NEAR(place_of(scan, i, {}).y_m, 1.9, 1e-4);
    }
    EXPECT_NEAR(seen, degrees(2 * std::atan2(0.1, 1.9)) / 0.25, 1.5);
}

TEST(Lidar, TheSameSeedSeesTheSame) {
    const Lidar lidar(plant::LaserScanner{}, kRooms);
    control::Scan first;
    control::Scan second;
    std::mt19937_64 one(9);
    std::mt19937_64 two(9);
    lidar.scan({3, 3, 1}, {}, one, first);
    lidar.scan({3, 3, 1}, {}, two, second);
    EXPECT_EQ(first.ranges_m, second.ranges_m);
}

}  // namespace
}  // namespace pulseline::simulation
