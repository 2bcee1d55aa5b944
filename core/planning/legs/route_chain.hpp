#pragma once

#include "core/planning/legs/leg_chain.hpp"
#include "core/planning/roads/what_if.hpp"

namespace pulseline::planning {

/// The chain of a leg along a route that answers the question (what_if), from standing in the
/// first station to standing in the second one; as leg_chain. It is no part of the route's cost:
/// what sigma is worth is nobody's to say but the plant's, and its routing has no figure for it.
std::optional<Result<LegChain>> route_chain(const plant::Plant& plant, const WhatIf& question,
                                            const WhatIfRoute& route);

}  // namespace pulseline::planning
