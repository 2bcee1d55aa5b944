#pragma once

#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/traffic/move_graph.hpp"

namespace pulseline::traffic {

/// What vehicles of one class may do in a layout.
struct LayoutClass {
    std::string name;
    const MoveGraph* graph = nullptr;  // its resting places are those with `resting`
    std::vector<PlaceIndex> goals;     // places that tasks may name
    std::size_t vehicles = 0;
    std::vector<std::string> place_names;  // for the reasons; empty: numbers
};

inline constexpr const char* kLayoutUnreachable = "unreachable";

struct LayoutViolation {
    Reason reason;
};

/// The condition under which admission is complete ("well-formed", Cap et al., ICAPS 2015): with
/// vehicles standing on the resting places, each vehicle can still get from its own to every goal,
/// and from there to every resting place of its class, without crossing a third one where another
/// vehicle can rest (a class's only vehicle is not in its own way, a class without vehicles in
/// nobody's); and there are resting places for all, no two of which share floor with vehicles on
/// both. Reasons, each once per class and resting place in the way: unreachable {class, from, to,
/// count, crossing?} with an example of the `count` pairs of places and no `crossing` when the
/// graph itself has no way; too_few_resting_places {class, resting_places, vehicles}. 0-1
/// breadth-first search from every resting place and goal.
std::vector<LayoutViolation> check_layout(const std::vector<LayoutClass>& classes);

}  // namespace pulseline::traffic
