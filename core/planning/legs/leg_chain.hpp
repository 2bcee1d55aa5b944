#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/kinematics/motion.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::planning {

class CodeReach;

/// A segment marker of a leg, or its boundary marker. One sigma of the place of the body's middle,
/// both axes together.
struct LegChainMarker {
    plant::MarkerId marker;
    std::string payload;
    geometry::Point2 place;
    double at_m = 0;      // way of the leg until it comes into view
    double before_m = 0;  // sigma there
    double after_m = 0;   // sigma by it
    friend bool operator==(const LegChainMarker&, const LegChainMarker&) = default;
};

/// How a leg finds its way by codes (localisation::segment_chain): rough from marker to marker,
/// precise from the last one, the boundary marker. As many segments as markers lie before the
/// precise part.
struct LegChain {
    std::vector<LegChainMarker> markers;
    double arrival_m = 0;  // sigma where the leg ends, before anything is measured there
    double worst_m = 0;    // the largest under way
    double limit_m = 0;    // that it must not exceed
    friend bool operator==(const LegChain&, const LegChain&) = default;
};

/// Sigma that a leg may have anywhere: three of it stay on the floor that traffic keeps beside a
/// vehicle.
inline constexpr double kChainLimit_m = 0.1 / 3;

/// The chain of a leg over these segments to `station` (nullptr: to a place without one). Fails
/// with no_marker_chain {gap_m, at_most_m, x_m, y_m}: the stretch without a code that exceeds most
/// what may lie there, and its middle, where a marker would help. nullopt for bodies without
/// cameras or plants without codes, and for bodies that find their way by beacons.
std::optional<Result<LegChain>> leg_chain(const plant::Plant& plant, const plant::HallId& hall,
                                          const CodeReach& reach, const plant::Station* station,
                                          std::span<const kinematics::Segment> segments);

}  // namespace pulseline::planning
