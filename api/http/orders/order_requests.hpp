#pragma once

#include "api/http/wire/message.hpp"
#include "core/base/result.hpp"
#include "core/fleet/fleet.hpp"

namespace pulseline::api {

/// Body, Idempotency-Key and who asks.
Result<fleet::NewOrder> read_new_order(const Request& request);
/// The same of who asks for an order of a template.
Status read_asker_of_instance(const Request& request, fleet::NewOrder& order);
Result<fleet::ControlRequest> read_job_control(const Request& request);
Result<bool> read_dry_run(const Request& request);
Result<fleet::OrderQuery> read_order_query(const Request& request);

}  // namespace pulseline::api
