#pragma once

#include <string>
#include <vector>

#include "core/fleet/state/new_order.hpp"

/// JSON texts of what an order carries. Private to db, as leg_json.hpp.
namespace pulseline::db {

std::string actions_to_json(const std::vector<fleet::StepAction>& actions);
std::vector<fleet::StepAction> actions_from_json(const std::string& text);
std::string dependencies_to_json(const std::vector<fleet::Dependency>& dependencies);
std::vector<fleet::Dependency> dependencies_from_json(const std::string& text);
std::string seconds_to_json(const std::vector<int>& seconds);
std::vector<int> seconds_from_json(const std::string& text);
/// What a schedule repeats: no times, no dependencies, nobody's key.
std::string body_to_json(const fleet::NewOrder& order);
fleet::NewOrder body_from_json(const std::string& text);

}  // namespace pulseline::db
