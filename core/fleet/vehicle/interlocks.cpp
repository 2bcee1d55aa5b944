#include "core/fleet/vehicle/interlocks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/gravity.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/plant/load_rules.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

using Kind = Interlock::Kind;

constexpr double kLowered_m = 0.01;  // brackets below it are down, whatever their sensors add
constexpr double kBelow_m = 0.005;   // of a support: who sets a load down ends 10 mm below

std::vector<plant::BracketForce> forces_on(const LiveVehicle& live) {
    std::vector<plant::BracketForce> forces;
    for (const auto& bracket : live.state.brackets) {
        forces.push_back({bracket.name, bracket.force_a_n + bracket.force_b_n});
    }
    return forces;
}

/// A transfer that was broken off leaves a part of the weight on the brackets, and a load that was
/// moved without a word is where nobody believes it.
std::optional<Reason> unlike_known(const FleetState& fleet, const LiveVehicle& live,
                                   const std::vector<plant::BracketForce>& forces) {
    if (forces.empty()) return std::nullopt;
    const auto felt = plant::load_on(*live.type, forces);
    const double measured_kg = felt ? felt->force_n / kGravity_mps2 : 0;
    const auto* load = load_on(fleet, live.record.id);
    if (!load) {
        if (!felt) return std::nullopt;
        return Reason{"load_unknown", {{"measured_kg", measured_kg}}};
    }
    if (plant::weighs_as_known(measured_kg, load->mass_kg)) return std::nullopt;
    return Reason{"load_differs",
                  {{"load", load->name}, {"load_kg", load->mass_kg}, {"measured_kg", measured_kg}}};
}

/// Empty brackets pass below loads that stand or hang in its hall; raised so far they would not.
std::optional<Reason> raised_into_loads(const FleetState& fleet, const LiveVehicle& live) {
    double highest_m = 0;
    for (const auto& bracket : live.state.brackets) {
        highest_m = std::max(highest_m, bracket.height_m.value_or(0));
    }
    if (highest_m <= kLowered_m || load_on(fleet, live.record.id)) return std::nullopt;
    for (const auto& [id, record] : fleet.loads) {
        const auto* station = plant::find_station(fleet.plant, record.station);
        if (!station || !station->support || station->hall.str() != hall_of(fleet, live)) continue;
        const double most_m = station->support->height_m - kBelow_m;
        if (highest_m <= most_m) continue;
        const auto* load = find_load(fleet, id);
        return Reason{"brackets_raised",
                      {{"load", load ? load->name : id.str()},
                       {"station", std::int64_t{station->number}},
                       {"height_m", highest_m},
                       {"most_m", most_m}}};
    }
    return std::nullopt;
}

std::optional<Reason> load_fault(const FleetState& fleet, const LiveVehicle& live,
                                 const std::vector<plant::BracketForce>& forces) {
    if (auto fault = plant::load_fault(*live.type, forces)) return fault;
    if (auto unlike = unlike_known(fleet, live, forces)) return unlike;
    // What it has begun only the vehicle knows.
    const auto half =
        std::ranges::find(live.state.errors, vda5050::kLoadHalfTaken, &vda5050::VehicleError::type);
    if (half == live.state.errors.end()) return std::nullopt;
    return Reason{"load_half_taken", {}};
}

/// A platform that was measured at a coded station leaves it only when both its cameras still see
/// the codes. Where it only made way to, nothing was measured and nothing has to be seen.
std::optional<Interlock> unseen_codes(const FleetState& fleet, const LiveVehicle& live) {
    const plant::StationId& at = live.record.at_station;
    if (live.type->brackets.empty() || at.empty() || at != live.record.last_stop_station) {
        return std::nullopt;
    }
    const auto* station = plant::find_station(fleet.plant, at);
    if (!station || station->markers.empty()) return std::nullopt;
    const auto found = std::count_if(live.state.cameras.begin(), live.state.cameras.end(),
                                     [](const auto& camera) { return camera.found; });
    const auto cameras = static_cast<std::int64_t>(live.type->cameras.size());
    if (found >= cameras) return std::nullopt;
    return Interlock{Kind::kCodes,
                     {"codes_not_seen", {{"found", std::int64_t{found}}, {"cameras", cameras}}}};
}

}  // namespace

LoadView load_view(const FleetState& fleet, const LiveVehicle& live) {
    const auto forces = forces_on(live);
    LoadView view;
    for (const auto& one : forces) view.force_n += one.force_n;
    if (const auto load = plant::load_on(*live.type, forces)) view.centre = load->centre;
    view.worst = plant::worst_bracket(*live.type, forces);
    view.fault = load_fault(fleet, live, forces);
    if (!view.fault) view.fault = raised_into_loads(fleet, live);
    return view;
}

std::optional<Reason> rule_broken(const LiveVehicle& live) {
    return plant::load_fault(*live.type, forces_on(live));
}

std::optional<Interlock> interlock(const FleetState& fleet, const LiveVehicle& live) {
    double furthest_m = 0;
    for (const auto& foot : live.state.parking_feet) {
        furthest_m = std::max(furthest_m, foot.extension_m);
    }
    if (furthest_m > plant::kFootDown_m) {
        return Interlock{Kind::kFeetDown, {"parking_feet_down", {{"furthest_m", furthest_m}}}};
    }
    if (auto fault = load_fault(fleet, live, forces_on(live))) {
        return Interlock{Kind::kLoad, std::move(*fault)};
    }
    if (auto raised = raised_into_loads(fleet, live)) {
        return Interlock{Kind::kBracketsRaised, std::move(*raised)};
    }
    for (const auto& wheel : live.state.wheels) {
        if (!wheel.fault.empty()) {
            return Interlock{Kind::kWheelFault,
                             {"wheel_fault", {{"wheel", wheel.name}, {"fault", wheel.fault}}}};
        }
    }
    return unseen_codes(fleet, live);
}

}  // namespace pulseline::fleet
