#include "api/http/orders/template_body.hpp"

#include <algorithm>
#include <set>

#include "api/http/orders/order_body.hpp"
#include "api/http/wire/body.hpp"
#include "api/json/parse.hpp"

namespace pulseline::api {
namespace {

using json::FieldErrors;
using json::ObjectReader;

constexpr std::size_t kMaxParameters = 50;
constexpr const char* kOrder = "/order";

using Places = std::map<std::string, std::string>;  // pointer -> parameter

/// "station" of "${station}"; nothing when the text is no placeholder.
std::optional<std::string> placeholder(const Json& value) {
    if (!value.is_string()) return std::nullopt;
    const auto& text = value.get_ref<const std::string&>();
    if (!text.starts_with("${") || !text.ends_with("}")) return std::nullopt;
    return text.substr(2, text.size() - 3);
}

void find_places(const Json& value, const std::string& pointer, Places& places) {
    if (const auto name = placeholder(value)) {
        places[pointer] = *name;
    } else if (value.is_object()) {
        for (const auto& [key, member] : value.items()) {
            find_places(member, json::child_pointer(pointer, std::string_view(key)), places);
        }
    } else if (value.is_array()) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            find_places(value[i], json::child_pointer(pointer, i), places);
        }
    }
}

Json filled(const Json& value, const Json& values) {
    if (const auto name = placeholder(value)) return values.value(*name, Json());
    Json copy = value;
    if (copy.is_structured()) {
        for (auto& member : copy) member = filled(member, values);
    }
    return copy;
}

bool is_of_type(const Json& value, const std::string& type) {
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    if (type == "boolean") return value.is_boolean();
    return value.is_string();
}

void check_type(const Json& value, const std::string& type, const std::string& pointer,
                FieldErrors& errors) {
    if (is_of_type(value, type)) return;
    errors.add(pointer, {"wrong_type", {{"expected", type}}}, "Expected " + type + " here.");
}

Json read_parameter(const Json& item, const std::string& pointer, FieldErrors& errors) {
    ObjectReader in(item, pointer, errors);
    Json read = {{"name", in.text("name", {1, 32})}};
    const std::string type = in.text("type", kName);
    if (type != "integer" && type != "number" && type != "boolean" && type != "string") {
        errors.add(pointer + "/type",
                   {"not_one_of", {{"allowed", std::string("integer, number, boolean, string")}}},
                   "Expected one of: integer, number, boolean, string.");
    }
    read["type"] = type;
    if (in.has("description")) read["description"] = in.text("description", {0, 200});
    if (const Json* value = in.find("default")) {
        check_type(*value, type, pointer + "/default", errors);
        read["default"] = *value;
    }
    in.refuse_unknown();
    return read;
}

/// A value to try the body with: the default, else any of the type.
Json sample(const Json& parameter) {
    if (parameter.contains("default")) return parameter["default"];
    const auto type = parameter["type"].get<std::string>();
    if (type == "integer") return 1;
    if (type == "number") return 1.0;
    if (type == "boolean") return true;
    return "text";
}

/// Every placeholder has its parameter and every parameter its place.
void match_names(const Json& parameters, const Places& places, FieldErrors& errors) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const auto name = parameters[i]["name"].get<std::string>();
        const std::string at = "/parameters/" + std::to_string(i) + "/name";
        if (!names.insert(name).second) {
            errors.add(at, {"duplicate_parameter", {{"parameter", name}}},
                       "There are two parameters of this name; keep one.");
        }
        const bool used = std::any_of(places.begin(), places.end(),
                                      [&](const auto& place) { return place.second == name; });
        if (!used) {
            errors.add(at, {"unused_parameter", {{"parameter", name}}},
                       "The order does not use this parameter; write ${" + name +
                           "} where its value goes, or leave it out.");
        }
    }
    for (const auto& [pointer, name] : places) {
        if (names.contains(name)) continue;
        errors.add(pointer, {"unknown_parameter", {{"parameter", name}}},
                   "There is no parameter of this name; add it to parameters.");
    }
}

/// Reads the body with sample values; faults where a parameter stands are those of the samples.
void try_body(const Json& body, const Json& parameters, const Places& places, FieldErrors& errors) {
    Json values = Json::object();
    for (const Json& parameter : parameters) {
        values[parameter["name"].get<std::string>()] = sample(parameter);
    }
    const Json example = filled(body, values);
    FieldErrors found;
    ObjectReader in(example, kOrder, found);
    static_cast<void>(read_order_body(in, OrderUse::kCreate));
    for (const Error& error : found.all()) {
        if (!places.contains(error.field)) errors.add(error.field, error.reason, error.what);
    }
}

/// The values for an instance: given ones, else defaults.
Json read_values(const Json& parameters, const Json* given, FieldErrors& errors) {
    static const Json kEmpty = Json::object();
    ObjectReader in(given == nullptr ? kEmpty : *given, "/parameters", errors);
    Json values = Json::object();
    for (const Json& parameter : parameters) {
        const auto name = parameter["name"].get<std::string>();
        const Json* value = nullptr;
        if (given != nullptr && given->is_object() && given->contains(name))
            value = &(*given)[name];
        const std::string at = json::child_pointer("/parameters", std::string_view(name));
        if (value != nullptr) {
            check_type(*value, parameter["type"].get<std::string>(), at, errors);
            values[name] = *value;
        } else if (parameter.contains("default")) {
            values[name] = parameter["default"];
        } else {
            errors.add(at, {"missing_field", {}},
                       "The parameter \"" + name + "\" is missing; add it.");
        }
    }
    if (given == nullptr || !given->is_object()) return values;
    for (const auto& [name, value] : given->items()) {
        if (values.contains(name)) continue;
        const bool declared =
            std::any_of(parameters.begin(), parameters.end(),
                        [&wanted = name](const Json& p) { return p["name"] == wanted; });
        if (declared) continue;
        errors.add(json::child_pointer("/parameters", std::string_view(name)),
                   {"unknown_parameter", {{"parameter", name}}},
                   "The template has no such parameter; remove it or correct its name.");
    }
    return values;
}

}  // namespace

Result<fleet::OrderTemplate> read_template(const Request& request) {
    const auto body = read_body(request);
    if (!body) return fail(body.error());
    FieldErrors errors;
    ObjectReader in(*body, "", errors);
    fleet::OrderTemplate one;
    one.name = in.text("name", kName);
    one.description = in.text_or("description", "", {0, 500});
    Json parameters = Json::array();
    in.items_if_any("parameters", {0, kMaxParameters},
                    [&](const Json& item, const std::string& pointer) {
                        parameters.push_back(read_parameter(item, pointer, errors));
                    });
    const Json* order = in.required("order");
    in.refuse_unknown();
    if (order != nullptr && errors.empty()) {
        Places places;
        find_places(*order, kOrder, places);
        match_names(parameters, places, errors);
        if (errors.empty()) try_body(*order, parameters, places, errors);
        one.body = dump(*order);
    }
    if (const Status ok = errors.status(); !ok) return fail(ok.error());
    one.parameters = dump(parameters);
    one.created_by = request.identity.name;
    return one;
}

Json template_json(const fleet::OrderTemplate& one) {
    return {{"name", one.name},
            {"description", one.description},
            {"parameters", Json::parse(one.parameters, nullptr, false)},
            {"order", Json::parse(one.body, nullptr, false)},
            {"created_by", one.created_by},
            {"created_at", rfc3339(one.created)}};
}

Result<FromTemplate> read_instance(const fleet::OrderTemplate& one, const Request& request) {
    const auto body = read_body(request);
    if (!body) return fail(body.error());
    const auto stored_parameters = json::parse_json(one.parameters);
    const auto stored_order = json::parse_json(one.body);
    if (!stored_parameters) return fail(stored_parameters.error());
    if (!stored_order) return fail(stored_order.error());

    FieldErrors errors;
    ObjectReader in(*body, "", errors);
    const Json values = read_values(*stored_parameters, in.find("parameters"), errors);
    const bool start_given = in.has("start");
    const bool start = in.boolean_or("start", true);
    const std::string client_order_id = in.text_or("client_order_id", "", kName);
    in.refuse_unknown();
    if (const Status ok = errors.status(); !ok) return fail(ok.error());

    FromTemplate made;
    Places places;
    find_places(*stored_order, "", places);
    made.parameter_of = std::move(places);
    const Json order = filled(*stored_order, values);
    ObjectReader read(order, "", errors);
    made.order = read_order_body(read, OrderUse::kCreate);
    if (const Status ok = errors.status(); !ok) {
        return fail(in_terms_of_parameters(ok.error(), made));
    }
    if (start_given) made.order.start = start;
    if (!client_order_id.empty()) made.order.client_order_id = client_order_id;
    made.order.from_template = one.name;
    return made;
}

Error in_terms_of_parameters(Error error, const FromTemplate& instance) {
    const auto found = instance.parameter_of.find(error.field);
    if (found != instance.parameter_of.end()) {
        error.field = json::child_pointer("/parameters", std::string_view(found->second));
    }
    return error;
}

}  // namespace pulseline::api
