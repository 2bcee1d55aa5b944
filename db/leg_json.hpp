#pragma once

#include <string>

#include "core/fleet/state/job_order.hpp"

/// JSON texts inside rows. Private to db: nobody else reads them. Doubles come back bit for bit; a
/// value that is not finite, or a text that is damaged, throws db::Error.
namespace pulseline::db {

std::string params_to_json(const Params& params);
Params params_from_json(const std::string& text);
std::string texts_to_json(const std::vector<std::string>& texts);
std::vector<std::string> texts_from_json(const std::string& text);
std::string names_to_json(const plant::Names& names);
plant::Names names_from_json(const std::string& text);
std::string leg_to_json(const fleet::Leg& leg);
fleet::Leg leg_from_json(const std::string& text);

/// The value, or db::Error naming it when it is not finite.
double finite(double value, const char* name);

}  // namespace pulseline::db
