#pragma once

#include <random>
#include <span>
#include <vector>

#include "core/control/scan.hpp"
#include "core/geometry/polygon.hpp"

namespace pulseline::simulation {

/// A scanner of the class of Li 2022's Hokuyo UST-10LX. Its data sheet, and the paper in section
/// 5.1, say an accuracy of +-40 mm; section 5.2 prints +-4 mm, which is that of the NAV350 beside
/// it and wrong here.
struct LidarType {
    double field_rad = radians(270.0);
    double step_rad = radians(0.25);
    double range_m = 10;
    double least_range_m = 0.06;
    double sigma_m = 0.012;
    double most_error_m = 0.04;  // no return is farther off than that
};

/// A simulated scanner on a vehicle: sees the edges of polygons from the true pose, the nearest one
/// along each ray. Every edge covers an interval of rays, so a scan costs its returns and not rays
/// times edges.
class Lidar {
public:
    /// `fixed`: hall walls and obstacles, hall frame.
    Lidar(const geometry::Pose2& body_from_sensor, std::span<const geometry::Polygon> fixed,
          const LidarType& type = {});

    /// Writes what is seen from `hall_from_body` among the fixed and the `other` polygons
    /// (vehicles, people; hall frame; without the own body). Rays without a return have range
    /// infinity.
    void scan(const geometry::Pose2& hall_from_body, std::span<const geometry::Polygon> others,
              std::mt19937_64& random, control::Scan& scan) const;

private:
    struct Edge {
        geometry::Point2 from;
        geometry::Point2 to;
    };

    /// All in the sensor's frame.
    void cover_edge(geometry::Point2 a, geometry::Point2 b, std::vector<float>& ranges_m) const;
    void cover_rays(double from_rad, double to_rad, geometry::Point2 from, geometry::Point2 along,
                    std::vector<float>& ranges_m) const;

    geometry::Pose2 body_from_sensor_;
    LidarType type_;
    std::vector<Edge> fixed_;
    std::vector<geometry::Point2> rays_;  // sensor frame
};

}  // namespace pulseline::simulation
