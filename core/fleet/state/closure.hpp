#pragma once

#include <string>
#include <vector>

#include "core/base/id.hpp"
#include "core/base/time.hpp"
#include "core/geometry/polygon.hpp"
#include "core/plant/plant.hpp"

/// Floor that people close for a while: an area, or lanes of the roadmap.
namespace pulseline::fleet {

using ClosureId = Id<struct ClosureTag>;

struct Closure {
    ClosureId id;
    std::string name;  // what people call it, e.g. "Wet paint at door 3"
    plant::HallId hall;
    geometry::Polygon outline;         // hall frame; empty: only lanes are closed
    std::vector<plant::EdgeId> edges;  // lanes, in both directions only when both are named
    std::string created_by;
    Time created;
};

struct NewClosure {
    std::string name;
    plant::HallId hall;
    geometry::Polygon outline;
    std::vector<plant::EdgeId> edges;
};

}  // namespace pulseline::fleet
