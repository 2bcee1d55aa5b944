#pragma once

#include "api/http/wire/message.hpp"
#include "api/localization/localization.hpp"
#include "core/base/result.hpp"
#include "core/fleet/fleet.hpp"

namespace pulseline::api {

Result<localization::LocalizationQuestion> read_localization(const Request& request);
Result<fleet::StopQuery> read_stop_query(const Request& request);
Result<fleet::UnmeasuredQuery> read_unmeasured_query(const Request& request);

}  // namespace pulseline::api
