#pragma once

#include "api/http/common_json.hpp"
#include "core/fleet/state/standing_orders.hpp"

namespace pulseline::api {

Json schedule_json(const fleet::Schedule& schedule);

}  // namespace pulseline::api
