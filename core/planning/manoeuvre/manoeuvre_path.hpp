#pragma once

#include <cstdint>
#include <vector>

#include "core/planning/manoeuvre/manoeuvre_room.hpp"

/// Paths of a free manoeuvre: moves one after the other from its start.
namespace pulseline::planning {

/// What a search works for.
struct ManoeuvreTask {
    const Steering& steering;
    const ManoeuvreRoom& room;
    geometry::Pose2 start;
    geometry::Pose2 goal;
};

/// What Steering::ways or least_cost_m costs in tests of the body.
constexpr long kWaysWork = 6;
/// Of the ways between two places, cheapest first, how many are tested for room.
constexpr std::size_t kWaysTried = 4;

using Moves = std::vector<Move>;

/// True when the vehicle goes on from `a` into `b` without a stop.
bool same_motion(const Move& a, const Move& b);
/// Appends a move; one that goes on as the last did only lengthens it.
void append(Moves& moves, const Move& move);
/// The same path driven the other way round.
Moves reversed(const Moves& moves);
/// Sum of the moves and of a stop between any two.
double cost_m(const Steering& steering, const Moves& moves);

/// Joins places of the path by cheaper ways, as long as these are free: first its corners in order,
/// then `rounds` pairs of random places. Never costs more than before. Deterministic by seed.
Moves shortened(const ManoeuvreTask& task, Moves moves, int rounds, std::uint64_t seed);

}  // namespace pulseline::planning
