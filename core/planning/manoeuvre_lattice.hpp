#pragma once

#include "core/planning/manoeuvre_path.hpp"

namespace pulseline::planning {

struct LatticeAnswer {
    Moves moves;            // empty: none found
    bool cut_off = false;   // no way at all: even the body's inner disc does not get through
    double at_least_m = 0;  // rough lower bound of the way's cost
};

/// Best-first search over poses reached by short arcs, straights and turns (hybrid A*: Dolgov,
/// Thrun, Montemerlo, Diebel 2010, "Path planning for autonomous vehicles in unknown
/// semi-structured environments"), with the steering's own ways to the goal tried from every pose.
/// Guided by the greater of the steering's least cost and the way of the body's inner disc round
/// the obstacles. Deterministic; no more than `work_limit` tests of the room.
LatticeAnswer lattice_search(const ManoeuvreTask& task, long work_limit);

}  // namespace pulseline::planning
