#pragma once

#include "api/http/wire/contexts.hpp"

namespace pulseline::api {

Response list_stop_records(const HistoryContext& context, const Request& request);
Response list_unmeasured_stops(const HistoryContext& context, const Request& request);
Response get_stop_record(const HistoryContext& context, const Request& request);

}  // namespace pulseline::api
