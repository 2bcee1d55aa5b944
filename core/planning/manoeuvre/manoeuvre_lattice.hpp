#pragma once

#include "core/planning/manoeuvre/manoeuvre_path.hpp"
#include "core/planning/room/disc_distances.hpp"

namespace pulseline::planning {

struct LatticeLimits {
    long work = 0;       // in tests of the room
    double below_m = 0;  // only ways of less cost; with one known already it looks for a short time
};

/// Best-first search over poses reached by short arcs, straights and turns (hybrid A*: Dolgov,
/// Thrun, Montemerlo, Diebel 2010, "Path planning for autonomous vehicles in unknown
/// semi-structured environments"), with the steering's own ways to the goal tried from every pose.
/// Guided by the greater of the steering's least cost and the way of the body's inner disc round
/// the obstacles. Deterministic; no more than `work_limit` tests of the room.
/// `left`: of that disc to the goal. `fineness` 1, 2, ..: steps of an arc of pi / 8 / fineness.
Moves lattice_search(const ManoeuvreTask& task, const DiscDistances& left, int fineness,
                     const LatticeLimits& limits);

}  // namespace pulseline::planning
