#pragma once

#include "api/http/wire/contexts.hpp"
#include "api/http/wire/message.hpp"

namespace pulseline::api {

Response localize(const HistoryContext& context, const Request& request);

}  // namespace pulseline::api
