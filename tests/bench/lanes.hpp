#pragma once

#include "core/plant/plant.hpp"

namespace pulseline::bench {

/// A hall with a lane for each of `count` vehicles V1, V2, ..: home of Vi is station 2i - 1 at one
/// end, station 2i lies at the other.
plant::Plant lanes(int count);

}  // namespace pulseline::bench
