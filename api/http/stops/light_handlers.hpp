#pragma once

#include "api/http/wire/contexts.hpp"
#include "api/http/wire/message.hpp"

/// Receivers of iGPS that are on no vehicle, such as a ball on a jig. The transmitters are the
/// plant's, which all share; what is measured belongs to whoever asks (Wang, section 2: system
/// layer and task layer), and nothing of it is kept here.
namespace pulseline::api {

Response measure_by_light(const HistoryContext& context, const Request& request);

}  // namespace pulseline::api
