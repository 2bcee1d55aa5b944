#pragma once

#include "api/http/contexts.hpp"
#include "api/http/message.hpp"

namespace pulseline::api {

Response localize(const HistoryContext& context, const Request& request);

}  // namespace pulseline::api
