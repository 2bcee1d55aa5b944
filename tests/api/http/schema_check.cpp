#include "tests/api/http/schema_check.hpp"

#include <algorithm>
#include <regex>

#include "api/http/plant/documents.hpp"

namespace pulseline::api::testing {
namespace {

bool has_type(const std::string& type, const Json& value) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    return type == "number" && value.is_number();
}

std::string object_breach(const Json& schema, const Json& value, const std::string& at) {
    for (const auto& name : schema.value("required", Json::array())) {
        if (!value.contains(name.get<std::string>())) {
            return at + "/" + name.get<std::string>() + " is missing";
        }
    }
    const Json properties = schema.value("properties", Json::object());
    for (const auto& [name, member] : value.items()) {
        const std::string place = at + "/" + name;
        if (properties.contains(name)) {
            if (auto found = breach(properties[name], member, place); !found.empty()) return found;
        } else if (schema.contains("additionalProperties") &&
                   schema["additionalProperties"].is_object()) {
            auto found = breach(schema["additionalProperties"], member, place);
            if (!found.empty()) return found;
        } else if (!properties.empty()) {
            return place + " is not in the schema";
        }
    }
    return {};
}

std::string text_breach(const Json& schema, const std::string& text, const std::string& at) {
    static const std::regex kUuid("[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}");
    static const std::regex kTime(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z)");
    const std::string format = schema.value("format", "");
    if (format == "uuid" && !std::regex_match(text, kUuid)) return at + " is no uuid: " + text;
    if (format == "date-time" && !std::regex_match(text, kTime)) return at + " is no time: " + text;
    return {};
}

}  // namespace

const Json& openapi() {
    static const Json kDocument = Json::parse(kOpenApiJson);
    return kDocument;
}

const Json* operation(const std::string& operation_id) {
    for (const auto& path : openapi()["paths"]) {
        for (const auto& candidate : path) {
            if (candidate["operationId"] == operation_id) return &candidate;
        }
    }
    return nullptr;
}

const Json& schema(const std::string& name) { return openapi()["components"]["schemas"].at(name); }

const Json& resolved(const Json& node) {
    if (!node.is_object() || !node.contains("$ref")) return node;
    return openapi().at(Json::json_pointer(node["$ref"].get<std::string>().substr(1)));
}

std::string breach(const Json& given, const Json& value, const std::string& at) {
    const Json& schema = resolved(given);
    if (schema.contains("oneOf")) {
        std::string why;
        int fitting = 0;
        for (const auto& option : schema["oneOf"]) {
            const auto found = breach(option, value, at);
            if (found.empty()) ++fitting;
            const Json kind = option.value("/properties/type/const"_json_pointer, Json());
            if (kind.is_null() || kind == value.value("type", "")) why += found;
        }
        return fitting == 1 ? "" : at + " fits " + std::to_string(fitting) + " options: " + why;
    }
    if (schema.contains("const") && schema["const"] != value) return at + " is not the constant";
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) {
        return at + " is not in the enum: " + value.dump();
    }
    if (schema.contains("type")) {
        const Json types =
            schema["type"].is_array() ? schema["type"] : Json::array({schema["type"]});
        const bool fits = std::any_of(types.begin(), types.end(), [&](const Json& type) {
            return has_type(type.get<std::string>(), value);
        });
        if (!fits) return at + " is no " + types.dump() + ": " + value.dump().substr(0, 80);
    }
    if (value.is_object()) return object_breach(schema, value, at);
    if (value.is_string()) return text_breach(schema, value.get<std::string>(), at);
    if (value.is_array() && schema.contains("items")) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            const auto found = breach(schema["items"], value[i], at + "/" + std::to_string(i));
            if (!found.empty()) return found;
        }
    }
    return {};
}

}  // namespace pulseline::api::testing
