#pragma once

#include <optional>

#include "core/base/error.hpp"
#include "core/plant/plant.hpp"

/// Who may carry what. How what is carried has to lie: load_rules.hpp.
namespace pulseline::plant {

/// Why vehicles of the type may not carry the load: load_not_for_type {load, type}, load_too_heavy
/// {load_kg, max_load_kg}, load_too_large {load, type}: it reaches beyond the outline that the
/// type is planned with.
std::optional<Reason> cannot_carry(const VehicleType& type, const Load& load);

}  // namespace pulseline::plant
