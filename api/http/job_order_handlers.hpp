#pragma once

#include "api/http/contexts.hpp"

namespace pulseline::api {

/// 201 with the order and where it is, or why there is none.
Response created_answer(const FleetContext& context, const Request& request,
                        const Result<fleet::Created>& created);

/// Creates the order; one of many steps is planned beforehand, beside the fleet.
FleetAnswer create_planned(FleetContext& context, const Request& request,
                           const fleet::NewOrder& order);

FleetAnswer create_job_order(FleetContext& context, const Request& request);
FleetAnswer control_job_order(FleetContext& context, const Request& request);
FleetAnswer pause_job_order(FleetContext& context, const Request& request);
FleetAnswer resume_job_order(FleetContext& context, const Request& request);
FleetAnswer cancel_job_order(FleetContext& context, const Request& request);
Response list_job_orders(const HistoryContext& context, const Request& request);
Response get_job_order(const HistoryContext& context, const Request& request);

}  // namespace pulseline::api
