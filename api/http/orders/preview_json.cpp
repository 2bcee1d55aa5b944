#include "api/http/orders/preview_json.hpp"

#include <cmath>

#include "api/http/wire/chain_json.hpp"

namespace pulseline::api {
namespace {

const char* text(fleet::Check::Result result) {
    switch (result) {
        case fleet::Check::Result::kPass:
            return "pass";
        case fleet::Check::Result::kNote:
            return "note";
        case fleet::Check::Result::kFail:
            return "fail";
    }
    return "fail";
}

Json check_json(const fleet::Check& check) {
    Json json = {{"code", check.code},
                 {"result", text(check.result)},
                 {"params", params_json(check.params)}};
    if (check.age_s) json["age_s"] = *check.age_s;
    return json;
}

Json segment_json(const kinematics::Segment& segment) {
    using Kind = kinematics::Segment::Kind;
    Json json = {{"start", pose_json(segment.start)},
                 {"end", pose_json(segment.end)},
                 {"turn_rad", segment.turn_rad},
                 {"length_m", segment.length_m},
                 {"duration_s", segment.duration_s}};
    switch (segment.kind) {
        case Kind::kRotate:
            json["kind"] = "rotate";
            break;
        case Kind::kStraight:
            json["kind"] = "straight";
            json["direction_rad"] = segment.direction_rad;
            break;
        case Kind::kArc:
            json["kind"] = "arc";
            json["centre"] = point_json(segment.centre);
            break;
        case Kind::kCombined:
            json["kind"] = "combined";
            json["direction_rad"] = segment.direction_rad;
            break;
    }
    return json;
}

constexpr int kStopsLookedAt = 100;
constexpr std::size_t kArrivalsOfMode = 20;  // older ones tell of another state of repair

}  // namespace

Arrivals arrivals_of(fleet::History& history, const plant::VehicleId& vehicle) {
    Arrivals arrivals;
    fleet::StopQuery query;
    query.vehicle = vehicle;
    query.limit = kStopsLookedAt;
    for (const fleet::StopRecord& stop : history.stops(query)) {
        if (!stop.arrival || stop.arrival->expected_m <= 0) continue;
        const fleet::Arrival& arrival = *stop.arrival;
        auto& of_mode = arrivals[stop.mode];
        if (of_mode.size() == kArrivalsOfMode) continue;
        of_mode.push_back({std::hypot(arrival.dx_m, arrival.dy_m),
                           std::abs(arrival.dheading_rad),
                           {arrival.expected_m, arrival.expected_rad}});
    }
    return arrivals;
}

Json mode_option_json(const planning::ModeOption& option, const Arrivals& arrivals) {
    Json json = {{"mode", plant::to_string(option.mode)},
                 {"feasible", option.plan.has_value()},
                 {"suggested", option.suggested}};
    if (!option.plan) {
        json["reason"] = reason_json(option.plan.error().reason);
        return json;
    }
    const planning::LegPlan& plan = *option.plan;
    json["segments"] = list_json(plan.segments, segment_json);
    json["route"] =
        list_json(plan.route, [](const plant::NodeId& node) { return Json(node.str()); });
    json["length_m"] = plan.length_m;
    json["turns"] = plan.turns;
    json["cost"] = plan.cost;
    json["duration_s"] = plan.duration_s;
    static const std::vector<kinematics::ArrivalMiss> kNone;
    const auto own = arrivals.find(option.mode);
    const auto& of_mode = own == arrivals.end() ? kNone : own->second;
    const auto expected = kinematics::learned_deviation(plan.expected, of_mode);
    json["expected_deviation"] = {{"position_m", expected.position_m},
                                  {"heading_rad", expected.heading_rad},
                                  {"arrivals", of_mode.size()}};
    if (!plan.closures.empty()) {
        json["closures"] = list_json(plan.closures, [](const std::string& id) { return Json(id); });
    }
    if (!plan.loads.empty()) {
        json["loads_in_the_way"] =
            list_json(plan.loads, [](const std::string& id) { return Json(id); });
    }
    if (std::isfinite(plan.blind.at_most_m)) {
        json["codes_on_way"] = {{"widest_gap_m", plan.blind.way_m},
                                {"at_most_m", plan.blind.at_most_m}};
    }
    if (plan.chain) json["marker_chain"] = chain_json(*plan.chain);
    json["clearance_m"] = plan.clearance_m;
    json["nearest"] = plan.nearest;
    json["swept_area_m2"] = plan.swept_area_m2;
    if (plan.wheels) {
        json["wheels"] = {{"max_speed_mps", plan.wheels->speed_mps},
                          {"max_steering_rad", plan.wheels->steering_rad}};
    }
    json["swept"] = rings_json(plan.swept);
    return json;
}

namespace {

const char* text(planning::LegAlternative::Reason reason) {
    using Reason = planning::LegAlternative::Reason;
    switch (reason) {
        case Reason::kLength:
            return "length";
        case Reason::kTurns:
            return "turns";
        case Reason::kAccuracy:
            return "accuracy";
        case Reason::kTime:
            return "time";
    }
    return "length";
}

Json alternative_json(const planning::LegAlternative& alternative) {
    const planning::LegPlan& plan = alternative.plan;
    return {{"route",
             list_json(plan.route, [](const plant::NodeId& node) { return Json(node.str()); })},
            {"length_m", plan.length_m},
            {"turns", plan.turns},
            {"cost", plan.cost},
            {"duration_s", plan.duration_s},
            {"more",
             {{"cost", alternative.more_cost},
              {"length", alternative.more_length},
              {"turns", alternative.more_turns},
              {"accuracy", alternative.more_accuracy},
              {"duration_s", alternative.more_s}}},
            {"main_reason", text(alternative.main_reason)}};
}

Json step_json(const fleet::StepPreview& step, const std::optional<fleet::StopStatistics>& expected,
               const Arrivals& arrivals) {
    Json json = {{"station", step.station.str()},
                 {"number", step.number},
                 {"start", pose_json(step.start)},
                 {"options", list_json(step.options,
                                       [&](const planning::ModeOption& option) {
                                           return mode_option_json(option, arrivals);
                                       })},
                 {"alternatives", list_json(step.alternatives, alternative_json)}};
    if (step.chosen) json["chosen"] = plant::to_string(*step.chosen);
    if (expected && expected->stops > 0) {
        json["expected_deviation"] = {{"stops", expected->stops},
                                      {"mean_m", expected->mean_m},
                                      {"max_m", expected->max_m},
                                      {"mean_rad", expected->mean_rad},
                                      {"max_rad", expected->max_rad}};
    }
    return json;
}

}  // namespace

Json preview_json(const fleet::Preview& preview,
                  const std::vector<std::optional<fleet::StopStatistics>>& expected,
                  const Arrivals& arrivals) {
    Json steps = Json::array();
    for (std::size_t i = 0; i < preview.steps.size(); ++i) {
        steps.push_back(step_json(preview.steps[i],
                                  i < expected.size() ? expected[i] : std::nullopt, arrivals));
    }
    Json json = {{"vehicle", preview.vehicle.str()},
                 {"accepted", preview.accepted},
                 {"checks", list_json(preview.checks, check_json)},
                 {"steps", std::move(steps)}};
    if (preview.problem) json["problem"] = reason_json(preview.problem->reason);
    return json;
}

}  // namespace pulseline::api
