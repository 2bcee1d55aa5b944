#pragma once

#include "api/http/wire/common_json.hpp"
#include "api/http/wire/message.hpp"
#include "core/base/result.hpp"
#include "core/fleet/state/standing_orders.hpp"

namespace pulseline::api {

Result<fleet::NewSchedule> read_new_schedule(const Request& request);
Json schedule_json(const fleet::Schedule& schedule);

}  // namespace pulseline::api
