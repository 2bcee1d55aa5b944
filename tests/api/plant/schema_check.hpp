#pragma once

#include <algorithm>
#include <regex>
#include <string>

#include "api/json/parse.hpp"

namespace pulseline::json {

/// As much of JSON Schema 2020-12 as api/plant.schema.json uses; a keyword it does not know is an
/// objection, so that the schema cannot outgrow it unseen. Gives the first objection, empty when
/// there is none.
class SchemaCheck {
public:
    explicit SchemaCheck(const Json& schema) : root_(schema) {}

    std::string objection(const Json& value) const { return check(root_, value, ""); }

private:
    static bool is_type(const Json& value, const std::string& type) {
        if (type == "object") return value.is_object();
        if (type == "array") return value.is_array();
        if (type == "string") return value.is_string();
        if (type == "boolean") return value.is_boolean();
        if (type == "integer") return value.is_number_integer();
        return type == "number" && value.is_number();
    }

    std::string check(const Json& schema, const Json& value, const std::string& at) const {
        for (const auto& [keyword, rule] : schema.items()) {
            const std::string wrong = apply(schema, keyword, rule, value, at);
            if (!wrong.empty()) return wrong;
        }
        return {};
    }

    std::string apply(const Json& schema, const std::string& keyword, const Json& rule,
                      const Json& value, const std::string& at) const {
        const auto unless = [&](bool holds) { return holds ? std::string() : at + ": " + keyword; };
        if (keyword == "$ref") {
            return check(root_.at(Json::json_pointer(rule.get<std::string>().substr(1))), value,
                         at);
        }
        if (keyword == "type") return unless(is_type(value, rule));
        if (keyword == "enum")
            return unless(std::find(rule.begin(), rule.end(), value) != rule.end());
        if (keyword == "pattern") {
            return unless(
                std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>())));
        }
        if (keyword == "minLength") return unless(value.get<std::string>().size() >= rule);
        if (keyword == "maxLength") return unless(value.get<std::string>().size() <= rule);
        if (keyword == "minimum") return unless(value >= rule);
        if (keyword == "maximum") return unless(value <= rule);
        if (keyword == "exclusiveMinimum") return unless(value > rule);
        if (keyword == "minItems") return unless(value.size() >= rule);
        if (keyword == "maxItems") return unless(value.size() <= rule);
        if (keyword == "items") {
            for (std::size_t i = 0; i < value.size(); ++i) {
                const std::string wrong = check(rule, value[i], at + "/" + std::to_string(i));
                if (!wrong.empty()) return wrong;
            }
            return {};
        }
        if (keyword == "required") {
            for (const auto& name : rule) {
                if (!value.contains(name)) return at + ": required " + name.get<std::string>();
            }
            return {};
        }
        if (keyword == "properties") {
            for (const auto& [name, member] : value.items()) {
                if (!rule.contains(name)) continue;
                const std::string wrong = check(rule[name], member, at + "/" + name);
                if (!wrong.empty()) return wrong;
            }
            return {};
        }
        if (keyword == "additionalProperties") {
            for (const auto& [name, member] : value.items()) {
                if (schema.contains("properties") && schema["properties"].contains(name)) continue;
                if (!rule.is_object()) return at + "/" + name + ": unknown";
                const std::string wrong = check(rule, member, at + "/" + name);
                if (!wrong.empty()) return wrong;
            }
            return {};
        }
        if (keyword == "maxProperties") return unless(value.size() <= rule);
        if (keyword == "propertyNames") {
            for (const auto& [name, member] : value.items()) {
                const std::string wrong = check(rule, Json(name), at + "/" + name);
                if (!wrong.empty()) return wrong;
            }
            return {};
        }
        const bool says_nothing = keyword == "$schema" || keyword == "$id" || keyword == "$defs" ||
                                  keyword == "title" || keyword == "description" ||
                                  keyword == "default";
        return says_nothing ? std::string() : "the check does not know the keyword " + keyword;
    }

    const Json& root_;
};

}  // namespace pulseline::json
