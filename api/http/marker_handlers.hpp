#pragma once

#include "api/http/contexts.hpp"
#include "api/http/message.hpp"

namespace pulseline::api {

Response print_markers(const HistoryContext& context, const Request& request);

}  // namespace pulseline::api
