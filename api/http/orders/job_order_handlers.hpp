#pragma once

#include <functional>
#include <string>

#include "api/http/wire/contexts.hpp"

namespace pulseline::api {

/// What is done with an order, and the answer when it is refused.
using Act = std::function<Result<Response>(FleetContext&, const fleet::NewOrder&)>;
using Refuse = std::function<Response(const FleetContext&, const Error&)>;
/// Acts; when the order takes long to plan, after that was done beside the fleet. `field`: where
/// the order stands in the body; `self`: the order that is to be updated.
FleetAnswer planned_ahead(FleetContext& context, const fleet::NewOrder& order,
                          const std::string& field, const Act& act, const Refuse& refuse,
                          fleet::JobOrderId self = {});

/// An error as whoever asked can understand it.
using InTheirTerms = std::function<Error(const Error&)>;
/// Creates the order; 201 with it and where it is, or why there is none.
FleetAnswer create_planned(FleetContext& context, const Request& request,
                           const fleet::NewOrder& order, const InTheirTerms& told);

FleetAnswer create_job_order(FleetContext& context, const Request& request);
FleetAnswer control_job_order(FleetContext& context, const Request& request);
FleetAnswer pause_job_order(FleetContext& context, const Request& request);
FleetAnswer resume_job_order(FleetContext& context, const Request& request);
FleetAnswer cancel_job_order(FleetContext& context, const Request& request);
Response list_job_orders(const HistoryContext& context, const Request& request);
Response get_job_order(const HistoryContext& context, const Request& request);

}  // namespace pulseline::api
