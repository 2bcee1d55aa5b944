#include "api/http/orders/order_body.hpp"
#include "api/http/wire/body.hpp"
#include "api/http/wire/query.hpp"

namespace pulseline::api {
namespace {

using json::FieldErrors;
using json::ObjectReader;

constexpr std::size_t kMaxSteps = 100;
constexpr std::size_t kMaxActions = 20;
constexpr std::size_t kMaxActionParameters = 50;
constexpr std::size_t kMaxDependencies = 100;

/// A plain value; nothing and an error kept when it is none.
std::optional<ParamValue> read_value(const Json& value, const std::string& pointer,
                                     FieldErrors& errors) {
    if (value.is_boolean()) return value.get<bool>();
    if (value.is_number_integer()) return json::read_integer(value, pointer, errors);
    if (value.is_number()) return json::read_number(value, pointer, errors);
    if (value.is_string()) return json::read_text(value, pointer, errors);
    errors.add(pointer, {"wrong_type", {{"expected", std::string("string, number or boolean")}}},
               "An action's parameter is a text, a number, true or false.");
    return std::nullopt;
}

fleet::StepAction read_action(const Json& item, const std::string& pointer, FieldErrors& errors) {
    ObjectReader in(item, pointer, errors);
    fleet::StepAction action;
    action.type = in.text("type", kName);
    const Json* parameters = in.find("parameters");
    if (parameters != nullptr && !parameters->is_object()) {
        errors.add(pointer + "/parameters", {"wrong_type", {{"expected", std::string("object")}}},
                   "Expected object here.");
    } else if (parameters != nullptr && parameters->size() > kMaxActionParameters) {
        errors.add(
            pointer + "/parameters",
            {"wrong_count",
             {{"min", std::int64_t{0}}, {"max", static_cast<std::int64_t>(kMaxActionParameters)}}},
            "An action has at most 50 parameters.");
    } else if (parameters != nullptr) {
        for (const auto& [name, value] : parameters->items()) {
            const std::string at = json::child_pointer(pointer + "/parameters", name);
            if (auto read = read_value(value, at, errors)) {
                action.params.push_back({name, std::move(*read)});
            }
        }
    }
    in.refuse_unknown();
    return action;
}

fleet::NewStep read_step(const Json& item, const std::string& pointer, FieldErrors& errors) {
    ObjectReader in(item, pointer, errors);
    fleet::NewStep step;
    step.station_number = static_cast<int>(in.integer("station", {0, kMaxStation}));
    step.mode = in.one_of_or("motion_mode", plant::MotionMode::kAuto, plant::kMotionModes);
    for (const auto& [name, actions, says] : {std::tuple{"before", &step.before, &step.says_before},
                                              std::tuple{"after", &step.after, &step.says_after}}) {
        *says = in.has(name);
        in.items_if_any(name, {0, kMaxActions},
                        [&, &list = *actions](const Json& action, const std::string& at) {
                            list.push_back(read_action(action, at, errors));
                        });
    }
    in.refuse_unknown();
    return step;
}

Json step_body_json(const fleet::NewStep& step) {
    Json json = {{"station", step.station_number}, {"motion_mode", plant::to_string(step.mode)}};
    const bool says_before = step.says_before || !step.before.empty();
    const bool says_after = step.says_after || !step.after.empty();
    if (says_before) json["before"] = actions_json(step.before);
    if (says_after) json["after"] = actions_json(step.after);
    return json;
}

}  // namespace

fleet::NewOrder read_order_body(ObjectReader& in, OrderUse use) {
    fleet::NewOrder read;
    if (use == OrderUse::kCreate) read.client_order_id = in.text_or("client_order_id", "", kName);
    if (use != OrderUse::kUpdate) read.start = in.boolean_or("start", true);
    read.vehicle = plant::VehicleId(in.text_or("vehicle", "", kName));
    read.vehicle_type = plant::VehicleTypeId(in.text_or("vehicle_type", "", kName));
    read.priority = static_cast<int>(in.integer_or("priority", 0, {-100, 100}));
    read.sequence = in.text_or("sequence", "", kName);
    if (use != OrderUse::kSchedule) {
        read.earliest_start = in.time_if_any("earliest_start");
        read.due = in.time_if_any("due");
        in.items_if_any(
            "after", {0, kMaxDependencies}, [&](const Json& item, const std::string& pointer) {
                read.after.push_back(json::read_text(item, pointer, in.errors(), kName));
            });
    }
    in.items("steps", {1, kMaxSteps}, [&](const Json& item, const std::string& pointer) {
        read.steps.push_back(read_step(item, pointer, in.errors()));
    });
    in.refuse_unknown();
    return read;
}

Json actions_json(const std::vector<fleet::StepAction>& actions) {
    return list_json(actions, [](const fleet::StepAction& action) {
        return Json{{"type", action.type}, {"parameters", params_json(action.params)}};
    });
}

Json order_body_json(const fleet::NewOrder& order) {
    Json json = {{"priority", order.priority},
                 {"start", order.start},
                 {"steps", list_json(order.steps, step_body_json)}};
    if (!order.vehicle.empty()) json["vehicle"] = order.vehicle.str();
    if (!order.vehicle_type.empty()) json["vehicle_type"] = order.vehicle_type.str();
    if (!order.sequence.empty()) json["sequence"] = order.sequence;
    return json;
}

}  // namespace pulseline::api
