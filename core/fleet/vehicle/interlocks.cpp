#include "core/fleet/vehicle/interlocks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/base/gravity.hpp"
#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {
namespace {

using Kind = Interlock::Kind;

constexpr double kEmpty = 0.01;  // of the largest load: bracket forces below it are noise

struct Load {
    double force_n = 0;
    geometry::Point2 centre;  // body frame
    bool present = false;
};

Load load_of(const LiveVehicle& live) {
    Load load;
    for (const auto& reported : live.state.brackets) {
        const double force_n = reported.force_a_n + reported.force_b_n;
        load.force_n += force_n;
        for (const auto& bracket : live.type->brackets) {
            if (bracket.name == reported.name)
                load.centre = load.centre + force_n * bracket.position;
        }
    }
    if (live.state.brackets.empty()) return load;
    load.present = load.force_n > kEmpty * live.type->max_load_kg * kGravity_mps2;
    if (load.present) load.centre = (1 / load.force_n) * load.centre;
    return load;
}

bool inside_wheel_base(const LiveVehicle& live, geometry::Point2 centre) {
    std::vector<geometry::Point2> wheels;
    for (const auto& wheel : live.type->wheels) wheels.push_back(wheel.position);
    return wheels.size() < 3 || geometry::contains(geometry::convex_hull(wheels), centre);
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

std::optional<BracketShare> worst_bracket(const LiveVehicle& live) {
    const auto& places = live.type->brackets;
    const Load load = load_of(live);
    if (places.empty() || !load.present) return std::nullopt;
    double middle_m = 0;
    for (const auto& place : places) {
        middle_m += place.position.x_m / static_cast<double>(places.size());
    }
    struct Force {
        std::string bracket;
        double force_n;
    };
    std::map<bool, std::vector<Force>> ends;  // whether in front of the middle
    for (const auto& reported : live.state.brackets) {
        const auto place = std::ranges::find(places, reported.name, &plant::Bracket::name);
        if (place == places.end()) continue;
        ends[place->position.x_m > middle_m].push_back(
            {reported.name, reported.force_a_n + reported.force_b_n});
    }
    const double mean_n = load.force_n / static_cast<double>(live.state.brackets.size());
    std::optional<BracketShare> worst;
    std::pair<double, double> most{-1, -1};
    for (const auto& [in_front, forces] : ends) {
        double end_n = 0;
        for (const Force& one : forces) end_n += one.force_n / static_cast<double>(forces.size());
        if (end_n <= 0) continue;  // it all hangs on the other end
        for (const Force& one : forces) {
            const double share = one.force_n / end_n - 1;
            const std::pair departs{std::round(1e6 * std::abs(share)),
                                    std::abs(one.force_n - mean_n)};
            if (departs <= most) continue;
            most = departs;
            worst = BracketShare{one.bracket, share};
        }
    }
    return worst;
}

std::optional<Interlock> interlock(const FleetState& fleet, const LiveVehicle& live) {
    double furthest_m = 0;
    for (const auto& foot : live.state.parking_feet) {
        furthest_m = std::max(furthest_m, foot.extension_m);
    }
    if (furthest_m > kFootLowered_m) {
        return Interlock{Kind::kFeetDown, {"parking_feet_down", {{"furthest_m", furthest_m}}}};
    }
    const Load load = load_of(live);
    if (load.force_n > live.type->max_load_kg * kGravity_mps2) {
        return Interlock{
            Kind::kLoad,
            {"load_too_heavy",
             {{"load_kg", load.force_n / kGravity_mps2}, {"max_load_kg", live.type->max_load_kg}}}};
    }
    if (const auto worst = worst_bracket(live); worst && std::abs(worst->share) > kBracketBalance) {
        return Interlock{Kind::kLoad,
                         {"load_unbalanced",
                          {{"bracket", worst->bracket},
                           {"unbalance", std::abs(worst->share)},
                           {"limit", kBracketBalance}}}};
    }
    if (load.present && !inside_wheel_base(live, load.centre)) {
        return Interlock{
            Kind::kLoad,
            {"load_outside_wheel_base", {{"x_m", load.centre.x_m}, {"y_m", load.centre.y_m}}}};
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
