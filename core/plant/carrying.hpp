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

/// Why not by the load's papers: the same, and by where they say its centre of gravity to be
/// (load_rules.hpp). What truly lies on its brackets a vehicle feels.
std::optional<Reason> cannot_carry_by_papers(const VehicleType& type, const Load& load);
/// Why no vehicle type of the plant may: of the one that comes nearest.
std::optional<Reason> nobody_can_carry(const Plant& plant, const Load& load);

}  // namespace pulseline::plant
