#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/planning/roads/roadmap_index.hpp"

namespace pulseline::planning {

/// Floor that people have closed for a while, or below a load that stands or hangs there.
struct ClosedFloor {
    std::string id;  // of the closure, or, with to_loads_only, of the load
    std::string name;
    plant::HallId hall;
    std::vector<geometry::Polygon> pieces;  // convex, hall frame
    double margin_m = 0;                    // bodies keep this far away
    bool stands_only = false;               // a vehicle that may have left by the time one comes
    bool to_loads_only = false;             // who carries nothing passes below
};

/// Those that bar a body, with a load on it or without.
std::vector<ClosedFloor> closed_to(bool loaded, const std::vector<ClosedFloor>& closures);

/// Text that no other closed floor has.
std::string key_of(const ClosedFloor& closed);

/// The closures that a motion of the body would drive over, by their place in `closures`.
std::vector<std::size_t> driven_over(const std::vector<ClosedFloor>& closures,
                                     const plant::HallId& hall,
                                     const std::vector<geometry::Polygon>& swept);

/// By arc the closures that the body would drive over on it, by their place in `closures`; none for
/// arcs that it cannot use anyway.
std::vector<std::vector<std::size_t>> closures_over_arcs(const RoadmapIndex& roads,
                                                         const Passage& passage,
                                                         const std::vector<ClosedFloor>& closures);

}  // namespace pulseline::planning
