#pragma once

#include <random>
#include <span>
#include <vector>

#include "core/control/scan.hpp"
#include "core/geometry/polygon.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::simulation {

/// A simulated scanner on a vehicle: sees the edges of polygons from the true pose, the nearest one
/// along each ray. Every edge covers an interval of rays, so a scan costs its returns and not rays
/// times edges.
class Lidar {
public:
    /// `fixed`: hall walls and obstacles, hall frame.
    Lidar(plant::LaserScanner scanner, std::span<const geometry::Polygon> fixed);

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

    plant::LaserScanner scanner_;
    std::vector<Edge> fixed_;
    std::vector<geometry::Point2> rays_;  // sensor frame
};

}  // namespace pulseline::simulation
