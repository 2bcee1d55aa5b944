#pragma once

#include "api/http/wire/contexts.hpp"

namespace pulseline::api {

Response get_session(const InlineContext& context, const Request& request);
Response sign_in(const WorkerContext& context, const Request& request);
Response sign_out(const WorkerContext& context, const Request& request);

}  // namespace pulseline::api
