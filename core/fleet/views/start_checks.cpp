#include "core/fleet/views/start_checks.hpp"

#include <algorithm>
#include <cmath>

#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/interlocks.hpp"
#include "core/fleet/vehicle/readiness.hpp"

// What is looked at before a move; the screen shows each with its number and its limit.
namespace pulseline::fleet {
namespace {

Check check(std::string code, Check::Result result, Params params) {
    return {std::move(code), result, std::move(params), std::nullopt};
}

Check link_check(const FleetState& fleet, const LiveVehicle& live, Time now) {
    const auto result =
        live.link == Link::kLive && live.connected ? Check::Result::kPass : Check::Result::kFail;
    return check(
        "link", result,
        {{"link", to_string(live.link)}, {"silent_s", seconds(silence(fleet, live, now))}});
}

Check pose_check(const FleetState& fleet, const LiveVehicle& live) {
    if (!live.record.pose_known) return check("pose", Check::Result::kFail, {});
    Params params{{"x_m", live.record.pose.x_m},
                  {"y_m", live.record.pose.y_m},
                  {"heading_rad", live.record.pose.heading_rad}};
    if (const auto* station = plant::find_station(fleet.plant, live.record.at_station)) {
        params.push_back({"station", std::int64_t{station->number}});
        params.push_back({"dx_m", live.record.pose.x_m - station->pose.x_m});
        params.push_back({"dy_m", live.record.pose.y_m - station->pose.y_m});
        params.push_back(
            {"dheading_rad", wrap(live.record.pose.heading_rad - station->pose.heading_rad)});
    }
    return check("pose", Check::Result::kPass, std::move(params));
}

std::optional<Check> load_check(const FleetState& fleet, const LiveVehicle& live) {
    if (live.state.brackets.empty()) return std::nullopt;
    const LoadView load = load_view(fleet, live);
    Params params{{"total_n", load.force_n}};
    if (load.fault) {
        params.push_back({"reason", load.fault->code});
        for (const Param& param : load.fault->params) params.push_back(param);
        return check("load", Check::Result::kFail, std::move(params));
    }
    params.push_back({"unbalance", load.worst ? std::abs(load.worst->share) : 0});
    params.push_back({"limit", live.type->load_rules.most_unbalance});
    params.push_back({"max_load_kg", live.type->max_load_kg});
    return check("load", Check::Result::kPass, std::move(params));
}

std::optional<Check> feet_check(const LiveVehicle& live) {
    if (live.state.parking_feet.empty()) return std::nullopt;
    double furthest_m = 0;
    for (const auto& foot : live.state.parking_feet) {
        furthest_m = std::max(furthest_m, foot.extension_m);
    }
    return check("parking_feet",
                 furthest_m > plant::kFootDown_m ? Check::Result::kFail : Check::Result::kPass,
                 {{"furthest_m", furthest_m},
                  {"feet", static_cast<std::int64_t>(live.state.parking_feet.size())}});
}

std::optional<Check> codes_check(const LiveVehicle& live) {
    if (live.type->cameras.empty()) return std::nullopt;
    Params params;
    std::size_t found = 0;
    for (const auto& camera : live.state.cameras) {
        if (!camera.found) continue;
        ++found;
        params.push_back({camera.camera, camera.payload});
    }
    params.push_back({"found", static_cast<std::int64_t>(found)});
    params.push_back({"cameras", static_cast<std::int64_t>(live.type->cameras.size())});
    const bool all = found == live.type->cameras.size();
    return check("codes_in_view", all ? Check::Result::kPass : Check::Result::kNote,
                 std::move(params));
}

Check station_check(const FleetState& fleet, const LiveVehicle& live,
                    const plant::Station& target) {
    Params params{{"station", std::int64_t{target.number}}};
    for (const auto& [id, other] : fleet.vehicles) {
        if (id == live.record.id) continue;
        const bool there = other.record.at_station == target.id;
        const bool coming = other.has_leg() && other.leg().station == target.id;
        if (!there && !coming) continue;
        params.push_back({"vehicle", id.str()});
        params.push_back({"how", there ? "occupied" : "reserved"});
        return check("station", Check::Result::kNote, std::move(params));
    }
    return check("station", Check::Result::kPass, std::move(params));
}

Check clearance_check(const LiveVehicle& live, const planning::LegPlan& plan) {
    const bool near_vehicle = plan.clearance_m < live.type->clearance_m;
    return check("clearance", near_vehicle ? Check::Result::kNote : Check::Result::kPass,
                 {{"clearance_m", plan.clearance_m},
                  {"limit_m", live.type->clearance_m},
                  {"nearest", plan.nearest}});
}

std::optional<Check> wheels_check(const LiveVehicle& live) {
    if (live.state.wheels.empty()) return std::nullopt;
    Params params{{"wheels", static_cast<std::int64_t>(live.state.wheels.size())}};
    for (const auto& wheel : live.state.wheels) {
        if (wheel.fault.empty()) continue;
        params.push_back({"wheel", wheel.name});
        params.push_back({"fault", wheel.fault});
        return check("wheels", Check::Result::kFail, std::move(params));
    }
    for (const auto& wheel : live.state.wheels) {
        if (wheel.temperature_c < live.type->drive_temperatures.warm_c) continue;
        params.push_back({"wheel", wheel.name});
        params.push_back({"temperature_c", wheel.temperature_c});
        return check("wheels", Check::Result::kNote, std::move(params));
    }
    return check("wheels", Check::Result::kPass, std::move(params));
}

Check battery_check(const LiveVehicle& live) {
    const double percent = live.state.battery_percent;
    const plant::BatteryLimits& limits = live.type->battery;
    const bool critical = percent < limits.critical_percent;
    const auto result = critical                       ? Check::Result::kFail
                        : percent < limits.low_percent ? Check::Result::kNote
                                                       : Check::Result::kPass;
    return check("battery", result,
                 {{"percent", percent},
                  {"limit_percent", critical ? limits.critical_percent : limits.low_percent}});
}

Check safety_check(const LiveVehicle& live) {
    const bool stopped = live.state.e_stop != "NONE" || live.state.field_violation;
    return check("safety", stopped ? Check::Result::kFail : Check::Result::kPass,
                 {{"e_stop", live.state.e_stop}, {"field_violation", live.state.field_violation}});
}

Check mode_check(const FleetState& fleet, const LiveVehicle& live, Time now) {
    const auto barred = not_ready(fleet, live, now);
    Params params{{"operating_mode", live.state.operating_mode}};
    if (barred) {
        params.push_back({"reason", barred->reason.code});
        for (const auto& param : barred->reason.params) params.push_back(param);
    }
    return check("mode", barred ? Check::Result::kNote : Check::Result::kPass, std::move(params));
}

}  // namespace

std::vector<Check> start_checks(const FleetState& fleet, const LiveVehicle& live,
                                const plant::Station* target,
                                const std::optional<planning::LegPlan>& plan, Time now) {
    std::vector<Check> checks{link_check(fleet, live, now)};
    checks.push_back(pose_check(fleet, live));
    if (!live.state_at) return checks;
    // What the vehicle's report says is as old as the report; what the plant and the plan say is
    // not.
    const double age_s = seconds(now - *live.state_at);
    for (auto& check : checks) check.age_s = age_s;
    const auto add = [&](std::optional<Check> found) {
        if (!found) return;
        found->age_s = age_s;
        checks.push_back(std::move(*found));
    };
    add(load_check(fleet, live));
    add(feet_check(live));
    add(codes_check(live));
    if (target) checks.push_back(station_check(fleet, live, *target));
    if (plan) checks.push_back(clearance_check(live, *plan));
    add(wheels_check(live));
    add(battery_check(live));
    add(safety_check(live));
    add(mode_check(fleet, live, now));
    return checks;
}

}  // namespace pulseline::fleet
