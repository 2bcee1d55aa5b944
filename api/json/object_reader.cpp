#include "api/json/object_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pulseline::json {
namespace {

std::string shown(double value) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    return {buffer, end};
}

void wrong_type_at(FieldErrors& errors, const std::string& pointer, const char* expected) {
    errors.add(pointer, {"wrong_type", {{"expected", std::string(expected)}}},
               std::string("Expected ") + expected + " here.");
}

void out_of_range(FieldErrors& errors, const std::string& pointer, ParamValue min, ParamValue max,
                  const std::string& range) {
    errors.add(pointer, {"out_of_range", {{"min", std::move(min)}, {"max", std::move(max)}}},
               "The value must lie within " + range + ".");
}

std::string counted(CountLimits limits) {
    if (limits.max == std::numeric_limits<std::size_t>::max()) {
        return "at least " + std::to_string(limits.min);
    }
    return std::to_string(limits.min) + " to " + std::to_string(limits.max);
}

std::int64_t clamped(std::size_t value) {
    constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
    return value > static_cast<std::size_t>(kMost) ? kMost : static_cast<std::int64_t>(value);
}

}  // namespace

void FieldErrors::add(std::string pointer, Reason reason, std::string what) {
    if (errors_.size() >= kMost) return;
    errors_.push_back({Errc::kInvalid, std::move(reason), std::move(what), std::move(pointer)});
}

Status FieldErrors::status() const {
    if (errors_.empty()) return {};
    return fail(errors_.front());
}

std::string child_pointer(const std::string& pointer, std::string_view key) {
    std::string result = pointer + "/";
    for (const char c : key) {
        if (c == '~') {
            result += "~0";
        } else if (c == '/') {
            result += "~1";
        } else {
            result += c;
        }
    }
    return result;
}

std::string child_pointer(const std::string& pointer, std::size_t index) {
    return pointer + "/" + std::to_string(index);
}

std::string read_text(const Json& value, const std::string& pointer, FieldErrors& errors,
                      TextLimits limits) {
    if (!value.is_string()) {
        wrong_type_at(errors, pointer, "string");
        return {};
    }
    const auto& text = value.get_ref<const std::string&>();
    if (text.size() < limits.min || text.size() > limits.max) {
        errors.add(pointer,
                   {"wrong_length", {{"min", clamped(limits.min)}, {"max", clamped(limits.max)}}},
                   "The text must have " + counted({limits.min, limits.max}) + " bytes.");
        return {};
    }
    if (std::any_of(text.begin(), text.end(),
                    [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; })) {
        errors.add(pointer, {"control_character", {}},
                   "The text holds a control character; remove it.");
        return {};
    }
    return text;
}

double read_number(const Json& value, const std::string& pointer, FieldErrors& errors,
                   NumberLimits limits) {
    if (!value.is_number()) {
        wrong_type_at(errors, pointer, "number");
        return 0;
    }
    const auto number = value.get<double>();
    if (!(number >= limits.min && number <= limits.max)) {
        out_of_range(errors, pointer, limits.min, limits.max,
                     shown(limits.min) + " to " + shown(limits.max));
        return 0;
    }
    return number;
}

std::int64_t read_integer(const Json& value, const std::string& pointer, FieldErrors& errors,
                          IntegerLimits limits) {
    // 3.0 is an integer to JSON Schema and to every JavaScript client.
    constexpr double kExact = 9007199254740992.0;  // 2^53
    const bool whole = value.is_number_float() && std::abs(value.get<double>()) <= kExact &&
                       value.get<double>() == std::trunc(value.get<double>());
    if (!value.is_number_integer() && !whole) {
        wrong_type_at(errors, pointer, "integer");
        return 0;
    }
    constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
    const bool too_large = value.is_number_unsigned() &&
                           value.get<std::uint64_t>() > static_cast<std::uint64_t>(kMost);
    const std::int64_t number = too_large ? kMost : value.get<std::int64_t>();
    if (too_large || number < limits.min || number > limits.max) {
        out_of_range(errors, pointer, limits.min, limits.max,
                     std::to_string(limits.min) + " to " + std::to_string(limits.max));
        return 0;
    }
    return number;
}

bool read_boolean(const Json& value, const std::string& pointer, FieldErrors& errors) {
    if (value.is_boolean()) return value.get<bool>();
    wrong_type_at(errors, pointer, "boolean");
    return false;
}

const Json* read_array(const Json& value, const std::string& pointer, FieldErrors& errors,
                       CountLimits limits) {
    if (!value.is_array()) {
        wrong_type_at(errors, pointer, "array");
        return nullptr;
    }
    if (value.size() < limits.min || value.size() > limits.max) {
        errors.add(pointer,
                   {"wrong_count", {{"min", clamped(limits.min)}, {"max", clamped(limits.max)}}},
                   "The array must have " + counted(limits) + " items.");
        return nullptr;
    }
    return &value;
}

ObjectReader::ObjectReader(const Json& value, std::string pointer, FieldErrors& errors)
    : value_(value.is_object() ? &value : nullptr), pointer_(std::move(pointer)), errors_(errors) {
    if (value_ == nullptr) wrong_type(pointer_, "object");
}

const Json* ObjectReader::find(const char* name) {
    if (value_ == nullptr) return nullptr;
    known_.insert(name);
    const auto it = value_->find(name);
    return it == value_->end() ? nullptr : &*it;
}

const Json* ObjectReader::required(const char* name) {
    const Json* found = find(name);
    if (found == nullptr && value_ != nullptr) {
        errors_.add(child_pointer(pointer_, std::string_view(name)), {"missing_field", {}},
                    "The field \"" + std::string(name) + "\" is missing; add it.");
    }
    return found;
}

std::string ObjectReader::text(const char* name, TextLimits limits) {
    const Json* found = required(name);
    if (found == nullptr) return {};
    return read_text(*found, child_pointer(pointer_, std::string_view(name)), errors_, limits);
}

std::string ObjectReader::text_or(const char* name, std::string fallback, TextLimits limits) {
    return find(name) == nullptr ? fallback : text(name, limits);
}

double ObjectReader::number(const char* name, NumberLimits limits) {
    const Json* found = required(name);
    if (found == nullptr) return 0;
    return read_number(*found, child_pointer(pointer_, std::string_view(name)), errors_, limits);
}

double ObjectReader::number_or(const char* name, double fallback, NumberLimits limits) {
    return find(name) == nullptr ? fallback : number(name, limits);
}

std::int64_t ObjectReader::integer(const char* name, IntegerLimits limits) {
    const Json* found = required(name);
    if (found == nullptr) return 0;
    return read_integer(*found, child_pointer(pointer_, std::string_view(name)), errors_, limits);
}

std::int64_t ObjectReader::integer_or(const char* name, std::int64_t fallback,
                                      IntegerLimits limits) {
    return find(name) == nullptr ? fallback : integer(name, limits);
}

bool ObjectReader::boolean(const char* name) {
    const Json* found = required(name);
    if (found == nullptr) return false;
    return read_boolean(*found, child_pointer(pointer_, std::string_view(name)), errors_);
}

bool ObjectReader::boolean_or(const char* name, bool fallback) {
    return find(name) == nullptr ? fallback : boolean(name);
}

ObjectReader ObjectReader::object(const char* name) {
    static const Json kEmpty = Json::object();
    const Json* found = required(name);
    ObjectReader reader(found == nullptr ? kEmpty : *found,
                        child_pointer(pointer_, std::string_view(name)), errors_);
    if (found == nullptr) reader.value_ = nullptr;
    return reader;
}

std::optional<ObjectReader> ObjectReader::object_if_any(const char* name) {
    return find(name) == nullptr ? std::nullopt : std::optional<ObjectReader>(object(name));
}

void ObjectReader::refuse_unknown() {
    if (value_ == nullptr) return;
    for (const auto& [key, value] : value_->items()) {
        if (known_.count(key) != 0) continue;
        errors_.add(child_pointer(pointer_, std::string_view(key)), {"unknown_field", {}},
                    "There is no such field; remove it or correct its name.");
    }
}

void ObjectReader::wrong_type(const std::string& pointer, const char* expected) {
    wrong_type_at(errors_, pointer, expected);
}

void ObjectReader::not_one_of(const char* name, const std::string& allowed) {
    errors_.add(child_pointer(pointer_, std::string_view(name)),
                {"not_one_of", {{"allowed", allowed}}}, "Expected one of: " + allowed + ".");
}

}  // namespace pulseline::json
