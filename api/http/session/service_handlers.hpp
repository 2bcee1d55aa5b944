#pragma once

#include "api/http/wire/contexts.hpp"

namespace pulseline::api {

Response get_plant(const InlineContext& context, const Request& request);
Response get_hall_grid(const InlineContext& context, const Request& request);
Response get_openapi(const InlineContext& context, const Request& request);
Response health(const InlineContext& context, const Request& request);
Response ready(const InlineContext& context, const Request& request);
Response metrics(const InlineContext& context, const Request& request);

}  // namespace pulseline::api
