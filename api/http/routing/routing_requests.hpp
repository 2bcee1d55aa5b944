#pragma once

#include "api/http/wire/message.hpp"
#include "core/base/result.hpp"
#include "core/fleet/fleet.hpp"
#include "core/planning/roads/what_if.hpp"

namespace pulseline::api {

Result<fleet::NewClosure> read_new_closure(const Request& request);
Result<planning::WhatIf> read_what_if(const Request& request);

}  // namespace pulseline::api
