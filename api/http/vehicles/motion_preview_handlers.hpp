#pragma once

#include "api/http/wire/contexts.hpp"

namespace pulseline::api {

/// POST /api/v1/motion-previews: what a vehicle would do to get to a station or pose in every
/// motion mode, changing nothing. Plans on the history thread, not the fleet's.
FleetAnswer preview_motions(FleetContext& context, const Request& request);

}  // namespace pulseline::api
