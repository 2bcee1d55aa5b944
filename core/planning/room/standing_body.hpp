#pragma once

#include <vector>

#include "core/plant/plant.hpp"

namespace pulseline::planning {

/// A vehicle (or what it carries) that stands in the way.
struct StandingBody {
    plant::VehicleId vehicle;
    std::vector<geometry::Polygon> outline;  // hall frame, convex pieces
};

/// Least distance of the body from convex pieces, `enough_m` when it is no less.
double distance_to(const StandingBody& body, const std::vector<geometry::Polygon>& pieces,
                   double enough_m);

}  // namespace pulseline::planning
