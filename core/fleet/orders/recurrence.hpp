#pragma once

#include <optional>

#include "core/fleet/state/standing_orders.hpp"

/// The times of a schedule.
namespace pulseline::fleet {

/// First time after `after`; nullopt: there is none any more.
std::optional<Time> next_time(const Recurrence& recurrence, Time after);
/// Last time not after `now`; nullopt: it has not begun.
std::optional<Time> last_time(const Recurrence& recurrence, Time now);

}  // namespace pulseline::fleet
