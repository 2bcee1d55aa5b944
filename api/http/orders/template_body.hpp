#pragma once

#include <map>
#include <string>

#include "api/http/wire/common_json.hpp"
#include "api/http/wire/message.hpp"
#include "core/base/result.hpp"
#include "core/fleet/state/standing_orders.hpp"

/// Order bodies in which "${name}" stands for a value that is given when an order is made of them.
namespace pulseline::api {

Result<fleet::OrderTemplate> read_template(const Request& request);
Json template_json(const fleet::OrderTemplate& one);

/// An order made of a template, and which field of it came from which parameter.
struct FromTemplate {
    fleet::NewOrder order;
    std::map<std::string, std::string> parameter_of;  // "/steps/0/station" -> "station"
};
Result<FromTemplate> read_instance(const fleet::OrderTemplate& one, const Request& request);
/// The error with its field named as the caller knows it: "/parameters/station".
Error in_terms_of_parameters(Error error, const FromTemplate& instance);

}  // namespace pulseline::api
