#pragma once

#include "api/http/wire/common_json.hpp"
#include "core/planning/legs/leg_chain.hpp"

namespace pulseline::api {

/// MarkerChain of openapi.yaml: the chain, or why there is none.
Json chain_json(const Result<planning::LegChain>& chain);

}  // namespace pulseline::api
