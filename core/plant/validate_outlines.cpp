#include <algorithm>
#include <cmath>

#include "core/geometry/convex.hpp"
#include "core/plant/validate_parts.hpp"

namespace pulseline::plant::detail {
namespace {

/// A rule may be narrower than the wheels, never wider: beyond them the vehicle tips.
void check_load_centre(const VehicleType& type, const std::string& element, Faults& faults) {
    if (type.load_rules.centre.empty()) return;
    if (type.brackets.empty()) {
        faults.add(element, "without_brackets", "Without brackets nobody sees where its load lies.",
                   "List the type's brackets, or leave the rule out.");
    }
    check_outline(type.load_rules.centre, element, faults);
    const Polygon base = wheel_base(type);
    if (base.size() < 3) return;
    const bool within = std::ranges::all_of(
        type.load_rules.centre, [&](Point2 corner) { return geometry::contains(base, corner); });
    if (within) return;
    faults.add(element, "outside_wheel_base", "A load whose centre lies there would tip it.",
               "Keep every corner between the places of the wheels.");
}

}  // namespace

void check_outline(const Polygon& outline, const std::string& element, Faults& faults) {
    if (!std::all_of(outline.begin(), outline.end(),
                     [](Point2 p) { return std::isfinite(p.x_m) && std::isfinite(p.y_m); })) {
        faults.add(element, "not_finite", "A corner is no finite number.", "Write a number.");
    } else if (outline.size() < 3) {
        faults.add(element, "too_few_points", "An outline needs at least three corners.",
                   "List all corners, the first one once.");
    } else if (!geometry::is_simple(outline)) {
        faults.add(element, "not_simple", "The outline crosses or touches itself.",
                   "List the corners in order round the outline, each once.");
    } else {
        double twice = 0;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            twice += cross(outline[i] - outline[0], outline[(i + 1) % outline.size()] - outline[0]);
        }
        if (twice < 0) {
            faults.add(element, "clockwise", "The corners run clockwise.",
                       "List them counter-clockwise.");
        }
    }
}

void check_outlines(const Plant& plant, Faults& faults) {
    for (std::size_t i = 0; i < plant.halls.size(); ++i) {
        check_outline(plant.halls[i].outline, at("halls", i, "/outline"), faults);
    }
    for (std::size_t i = 0; i < plant.areas.size(); ++i) {
        check_outline(plant.areas[i].outline, at("areas", i, "/outline"), faults);
    }
    for (std::size_t i = 0; i < plant.loads.size(); ++i) {
        if (plant.loads[i].outline.empty()) continue;
        check_outline(plant.loads[i].outline, at("loads", i, "/outline"), faults);
    }
    for (std::size_t i = 0; i < plant.vehicle_types.size(); ++i) {
        const VehicleType& type = plant.vehicle_types[i];
        check_outline(type.footprint, at("vehicle_types", i, "/footprint"), faults);
        if (!type.load_footprint.empty()) {
            check_outline(type.load_footprint, at("vehicle_types", i, "/load_footprint"), faults);
        }
        check_load_centre(type, at("vehicle_types", i, "/load_rules/centre"), faults);
        if (type.footprint.size() >= 3 && !geometry::contains(type.footprint, {0, 0})) {
            faults.add(at("vehicle_types", i, "/footprint"), "centre_outside",
                       "The body's origin lies outside its footprint.",
                       "Give the corners in the body frame, x forward, y to the left.");
        }
    }
}

}  // namespace pulseline::plant::detail
