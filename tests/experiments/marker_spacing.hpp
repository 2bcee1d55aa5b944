#pragma once

#include <cstdint>

#include "core/plant/plant.hpp"

namespace pulseline::experiments {

/// Li 2022, eq. 5, driven: `drives` machines of this type drive from one code to another as far off
/// as the printed equation allows, and as many as far as the corrected one allows, 12 mm being the
/// limit and 2 % of the way what they get lost by at 95 %. Prints how many were off by more than
/// the limit. False when more than 5 % are at the corrected spacing or no more than 5 % at the
/// printed one, or the second code was not seen.
bool drive_equation_5(const plant::VehicleType& type, int drives, std::uint64_t seed);

}  // namespace pulseline::experiments
