#include "core/fleet/vehicle/interlocks.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/fleet/state/fleet_state.hpp"
#include "core/plant/load_rules.hpp"

namespace pulseline::fleet {
namespace {

using Kind = Interlock::Kind;

std::vector<plant::BracketForce> forces_on(const LiveVehicle& live) {
    std::vector<plant::BracketForce> forces;
    for (const auto& bracket : live.state.brackets) {
        forces.push_back({bracket.name, bracket.force_a_n + bracket.force_b_n});
    }
    return forces;
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

LoadView load_view(const LiveVehicle& live) {
    const auto forces = forces_on(live);
    LoadView view;
    for (const auto& one : forces) view.force_n += one.force_n;
    if (const auto load = plant::load_on(*live.type, forces)) view.centre = load->centre;
    view.worst = plant::worst_bracket(*live.type, forces);
    view.fault = plant::load_fault(*live.type, forces);
    return view;
}

std::optional<Interlock> interlock(const FleetState& fleet, const LiveVehicle& live) {
    double furthest_m = 0;
    for (const auto& foot : live.state.parking_feet) {
        furthest_m = std::max(furthest_m, foot.extension_m);
    }
    if (furthest_m > kFootLowered_m) {
        return Interlock{Kind::kFeetDown, {"parking_feet_down", {{"furthest_m", furthest_m}}}};
    }
    if (auto fault = plant::load_fault(*live.type, forces_on(live))) {
        return Interlock{Kind::kLoad, std::move(*fault)};
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
