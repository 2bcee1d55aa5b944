#include "core/fleet/views/start_checks.hpp"

#include <algorithm>
#include <cmath>

#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/interlocks.hpp"
#include "core/fleet/vehicle/readiness.hpp"

// What is looked at before a move; the screen shows each with its number and its limit.
namespace pulseline::fleet {
namespace {

constexpr double kWarmWheel_c = 65;
constexpr double kGravity = 9.80665;

Check check(std::string code, Check::Result result, Params params) {
    return {std::move(code), result, std::move(params), std::nullopt};
}

Check link_check(const FleetState& fleet, const VehicleRun& run, Time now) {
    const auto result =
        run.link == Link::kLive && run.connected ? Check::Result::kPass : Check::Result::kFail;
    return check("link", result,
                 {{"link", to_string(run.link)}, {"silent_s", seconds(silence(fleet, run, now))}});
}

Check pose_check(const FleetState& fleet, const VehicleRun& run) {
    if (!run.record.pose_known) return check("pose", Check::Result::kFail, {});
    Params params{{"x_m", run.record.pose.x_m},
                  {"y_m", run.record.pose.y_m},
                  {"heading_rad", run.record.pose.heading_rad}};
    if (const auto* station = plant::find_station(fleet.plant, run.record.at_station)) {
        params.push_back({"station", std::int64_t{station->number}});
        params.push_back({"dx_m", run.record.pose.x_m - station->pose.x_m});
        params.push_back({"dy_m", run.record.pose.y_m - station->pose.y_m});
        params.push_back(
            {"dheading_rad", wrap(run.record.pose.heading_rad - station->pose.heading_rad)});
    }
    return check("pose", Check::Result::kPass, std::move(params));
}

std::optional<Check> load_check(const VehicleRun& run) {
    if (run.state.brackets.empty()) return std::nullopt;
    double total_n = 0;
    for (const auto& bracket : run.state.brackets) total_n += bracket.force_a_n + bracket.force_b_n;
    const auto bracket = worst_bracket(run);
    const double worst = bracket ? std::abs(bracket->share) : 0;
    const bool too_heavy = total_n > run.type->max_load_kg * kGravity;
    const auto result =
        too_heavy || worst > kBracketBalance ? Check::Result::kFail : Check::Result::kPass;
    return check("load", result,
                 {{"total_n", total_n},
                  {"unbalance", worst},
                  {"limit", kBracketBalance},
                  {"max_load_kg", run.type->max_load_kg}});
}

std::optional<Check> feet_check(const VehicleRun& run) {
    if (run.state.parking_feet.empty()) return std::nullopt;
    double furthest_m = 0;
    for (const auto& foot : run.state.parking_feet) {
        furthest_m = std::max(furthest_m, foot.extension_m);
    }
    return check("parking_feet",
                 furthest_m > kFootLowered_m ? Check::Result::kFail : Check::Result::kPass,
                 {{"furthest_m", furthest_m},
                  {"feet", static_cast<std::int64_t>(run.state.parking_feet.size())}});
}

std::optional<Check> codes_check(const VehicleRun& run) {
    if (run.type->cameras.empty()) return std::nullopt;
    Params params;
    std::size_t found = 0;
    for (const auto& camera : run.state.cameras) {
        if (!camera.found) continue;
        ++found;
        params.push_back({camera.camera, camera.payload});
    }
    params.push_back({"found", static_cast<std::int64_t>(found)});
    params.push_back({"cameras", static_cast<std::int64_t>(run.type->cameras.size())});
    const bool all = found == run.type->cameras.size();
    return check("codes_in_view", all ? Check::Result::kPass : Check::Result::kNote,
                 std::move(params));
}

Check station_check(const FleetState& fleet, const VehicleRun& run, const plant::Station& target) {
    Params params{{"station", std::int64_t{target.number}}};
    for (const auto& [id, other] : fleet.vehicles) {
        if (id == run.record.id) continue;
        const bool there = other.record.at_station == target.id;
        const bool coming = other.has_leg() && other.leg().station == target.id;
        if (!there && !coming) continue;
        params.push_back({"vehicle", id.str()});
        params.push_back({"how", there ? "occupied" : "reserved"});
        return check("station", Check::Result::kNote, std::move(params));
    }
    return check("station", Check::Result::kPass, std::move(params));
}

Check clearance_check(const VehicleRun& run, const planning::LegPlan& plan) {
    const bool near_vehicle = plan.clearance_m < run.type->clearance_m;
    return check("clearance", near_vehicle ? Check::Result::kNote : Check::Result::kPass,
                 {{"clearance_m", plan.clearance_m},
                  {"limit_m", run.type->clearance_m},
                  {"nearest", plan.nearest}});
}

std::optional<Check> wheels_check(const VehicleRun& run) {
    if (run.state.wheels.empty()) return std::nullopt;
    Params params{{"wheels", static_cast<std::int64_t>(run.state.wheels.size())}};
    for (const auto& wheel : run.state.wheels) {
        if (wheel.fault.empty()) continue;
        params.push_back({"wheel", wheel.name});
        params.push_back({"fault", wheel.fault});
        return check("wheels", Check::Result::kFail, std::move(params));
    }
    for (const auto& wheel : run.state.wheels) {
        if (wheel.temperature_c < kWarmWheel_c) continue;
        params.push_back({"wheel", wheel.name});
        params.push_back({"temperature_c", wheel.temperature_c});
        return check("wheels", Check::Result::kNote, std::move(params));
    }
    return check("wheels", Check::Result::kPass, std::move(params));
}

Check battery_check(const VehicleRun& run) {
    const double percent = run.state.battery_percent;
    const plant::BatteryLimits& limits = run.type->battery;
    const bool critical = percent < limits.critical_percent;
    const auto result = critical                       ? Check::Result::kFail
                        : percent < limits.low_percent ? Check::Result::kNote
                                                       : Check::Result::kPass;
    return check("battery", result,
                 {{"percent", percent},
                  {"limit_percent", critical ? limits.critical_percent : limits.low_percent}});
}

Check safety_check(const VehicleRun& run) {
    const bool stopped = run.state.e_stop != "NONE" || run.state.field_violation;
    return check("safety", stopped ? Check::Result::kFail : Check::Result::kPass,
                 {{"e_stop", run.state.e_stop}, {"field_violation", run.state.field_violation}});
}

Check mode_check(const FleetState& fleet, const VehicleRun& run, Time now) {
    const auto barred = not_ready(fleet, run, now);
    Params params{{"operating_mode", run.state.operating_mode}};
    if (barred) {
        params.push_back({"reason", barred->reason.code});
        for (const auto& param : barred->reason.params) params.push_back(param);
    }
    return check("mode", barred ? Check::Result::kNote : Check::Result::kPass, std::move(params));
}

}  // namespace

std::vector<Check> start_checks(const FleetState& fleet, const VehicleRun& run,
                                const plant::Station* target,
                                const std::optional<planning::LegPlan>& plan, Time now) {
    std::vector<Check> checks{link_check(fleet, run, now)};
    checks.push_back(pose_check(fleet, run));
    if (!run.state_at) return checks;
    const auto add = [&](std::optional<Check> found) {
        if (found) checks.push_back(std::move(*found));
    };
    add(load_check(run));
    add(feet_check(run));
    add(codes_check(run));
    if (target) checks.push_back(station_check(fleet, run, *target));
    if (plan) checks.push_back(clearance_check(run, *plan));
    add(wheels_check(run));
    checks.push_back(battery_check(run));
    checks.push_back(safety_check(run));
    checks.push_back(mode_check(fleet, run, now));
    const double age_s = seconds(now - *run.state_at);
    for (auto& found : checks) {
        if (found.code != "station" && found.code != "clearance") found.age_s = age_s;
    }
    return checks;
}

}  // namespace pulseline::fleet
