#pragma once

#include "api/http/wire/common_json.hpp"
#include "api/json/object_reader.hpp"
#include "core/fleet/state/new_order.hpp"

/// What an order says, wherever it is written: in a creation, an Update, a template, a schedule.
namespace pulseline::api {

enum class OrderUse {
    kCreate,
    kUpdate,    // no name of its own, no start: it exists
    kSchedule,  // no name, no times and no dependencies: it is made again and again
};
/// Reads its fields from `in` and refuses all others.
fleet::NewOrder read_order_body(json::ObjectReader& in, OrderUse use);

Json actions_json(const std::vector<fleet::StepAction>& actions);
/// As it was written, for a schedule.
Json order_body_json(const fleet::NewOrder& order);

}  // namespace pulseline::api
