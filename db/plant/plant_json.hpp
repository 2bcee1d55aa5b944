#pragma once

#include <string>
#include <vector>

#include "core/plant/plant.hpp"

/// Lists inside plant rows as JSON text. Private to db. Damaged text throws db::Error.
namespace pulseline::db {

std::string polygon_to_json(const plant::Polygon& polygon);
plant::Polygon polygon_from_json(const std::string& text);
std::string names_to_json(const std::vector<plant::EdgeId>& edges);
std::vector<plant::EdgeId> edges_from_json(const std::string& text);
std::string wheels_to_json(const std::vector<plant::Wheel>& wheels);
std::vector<plant::Wheel> wheels_from_json(const std::string& text);
std::string cameras_to_json(const std::vector<plant::Camera>& cameras);
std::vector<plant::Camera> cameras_from_json(const std::string& text);
std::string receivers_to_json(const std::vector<plant::Receiver>& receivers);
std::vector<plant::Receiver> receivers_from_json(const std::string& text);
std::string scanners_to_json(const std::vector<plant::LaserScanner>& scanners);
std::vector<plant::LaserScanner> scanners_from_json(const std::string& text);
std::string scanner_to_json(const std::optional<plant::NavigationScanner>& scanner);
std::optional<plant::NavigationScanner> scanner_from_json(const std::string& text);
std::string brackets_to_json(const std::vector<plant::Bracket>& brackets);
std::vector<plant::Bracket> brackets_from_json(const std::string& text);
std::string parking_to_json(const std::optional<plant::ParkingGear>& parking);
std::optional<plant::ParkingGear> parking_from_json(const std::string& text);
/// "null" becomes the rules of a type that states none.
std::string load_rules_to_json(const plant::LoadRules& rules);
plant::LoadRules load_rules_from_json(const std::string& text);
/// "null" becomes the lift of a type that states none.
std::string bracket_lift_to_json(const plant::BracketLift& lift);
plant::BracketLift bracket_lift_from_json(const std::string& text);

std::string casters_to_json(const std::vector<plant::Caster>& casters);
std::vector<plant::Caster> casters_from_json(const std::string& text);
/// "null" becomes the control of a type that states none.
std::string control_to_json(const plant::AxisControl& control);
plant::AxisControl control_from_json(const std::string& text);

}  // namespace pulseline::db
