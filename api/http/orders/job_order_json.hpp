#pragma once

#include "api/http/wire/common_json.hpp"
#include "core/fleet/state/job_order.hpp"

namespace pulseline::api {

/// The plant gives the stations' numbers.
Json job_order_json(const plant::Plant& plant, const fleet::JobOrder& order);
Json stop_record_json(const fleet::StopRecord& stop);
Json event_json(const fleet::Event& event);

}  // namespace pulseline::api
