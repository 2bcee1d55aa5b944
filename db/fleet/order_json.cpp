#include "db/fleet/order_json.hpp"

#include "db/json_number.hpp"
#include "db/json_text.hpp"
#include "db/names.hpp"

namespace pulseline::db {
namespace {

using Json = OrderedJson;

Json encode(const std::vector<fleet::StepAction>& actions) {
    Json list = Json::array();
    for (const auto& action : actions) {
        list.push_back({{"type", action.type}, {"params", params_to_json(action.params)}});
    }
    return list;
}

std::vector<fleet::StepAction> decode_actions(const Json& list) {
    std::vector<fleet::StepAction> actions;
    for (const Json& item : list) {
        actions.push_back(
            {item.at("type"), params_from_json(item.at("params").get<std::string>())});
    }
    return actions;
}

}  // namespace

std::string actions_to_json(const std::vector<fleet::StepAction>& actions) {
    return text_of(encode(actions));
}

std::vector<fleet::StepAction> actions_from_json(const std::string& text) {
    return decoded(text, [](const Json& json) { return decode_actions(json); });
}

std::string dependencies_to_json(const std::vector<fleet::Dependency>& dependencies) {
    Json list = Json::array();
    for (const auto& one : dependencies) {
        list.push_back({{"order", stored_id(one.order)},
                        {"number", one.number},
                        {"outcome", one.outcome ? stored(*one.outcome) : ""}});
    }
    return text_of(list);
}

std::vector<fleet::Dependency> dependencies_from_json(const std::string& text) {
    return decoded(text, [](const Json& json) {
        std::vector<fleet::Dependency> dependencies;
        for (const Json& item : json) {
            fleet::Dependency one;
            read_id(item.at("order"), one.order);
            one.number = whole<std::int64_t>(item.at("number"));
            const std::string outcome = item.at("outcome");
            if (!outcome.empty()) read(outcome, one.outcome.emplace());
            dependencies.push_back(one);
        }
        return dependencies;
    });
}

std::string seconds_to_json(const std::vector<int>& seconds) { return text_of(Json(seconds)); }

std::vector<int> seconds_from_json(const std::string& text) {
    return decoded(text, [](const Json& json) {
        std::vector<int> seconds;
        for (const Json& item : json) seconds.push_back(whole<int>(item));
        return seconds;
    });
}

std::string body_to_json(const fleet::NewOrder& order) {
    Json steps = Json::array();
    for (const auto& step : order.steps) {
        steps.push_back({{"station", step.station_number},
                         {"mode", plant::to_string(step.mode)},
                         {"before", encode(step.before)},
                         {"after", encode(step.after)},
                         {"says_before", step.says_before},
                         {"says_after", step.says_after}});
    }
    return text_of({{"vehicle", order.vehicle.str()},
                    {"vehicle_type", order.vehicle_type.str()},
                    {"priority", order.priority},
                    {"start", order.start},
                    {"sequence", order.sequence},
                    {"steps", std::move(steps)},
                    {"template", order.from_template}});
}

fleet::NewOrder body_from_json(const std::string& text) {
    return decoded(text, [](const Json& json) {
        fleet::NewOrder order;
        order.vehicle = plant::VehicleId(json.at("vehicle").get<std::string>());
        order.vehicle_type = plant::VehicleTypeId(json.at("vehicle_type").get<std::string>());
        order.priority = whole<int>(json.at("priority"));
        order.start = json.at("start");
        order.sequence = json.at("sequence");
        order.from_template = json.at("template");
        for (const Json& item : json.at("steps")) {
            fleet::NewStep step;
            step.station_number = whole<int>(item.at("station"));
            read(item.at("mode").get<std::string>(), step.mode);
            step.before = decode_actions(item.at("before"));
            step.after = decode_actions(item.at("after"));
            step.says_before = item.value("says_before", false);  // older ones do not tell
            step.says_after = item.value("says_after", false);
            order.steps.push_back(std::move(step));
        }
        return order;
    });
}

}  // namespace pulseline::db
