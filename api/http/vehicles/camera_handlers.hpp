#pragma once

#include "api/http/wire/contexts.hpp"
#include "api/http/wire/message.hpp"

namespace pulseline::api {

/// GET /vehicles/{id}/cameras/{camera}
Response get_camera_image(const InlineContext& context, const Request& request);
/// GET /vehicles/{id}/cameras/{camera}/steps/{step}
FleetAnswer get_camera_step(FleetContext& context, const Request& request);

}  // namespace pulseline::api
