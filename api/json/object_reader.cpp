#include "api/json/object_reader.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

#include "api/json/utf8.hpp"

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

/// `count` decimal digits at `at`, or -1.
int digits(const std::string& text, std::size_t at, std::size_t count) {
    int value = 0;
    if (at + count > text.size()) return -1;
    for (std::size_t i = at; i < at + count; ++i) {
        if (text[i] < '0' || text[i] > '9') return -1;
        value = value * 10 + (text[i] - '0');
    }
    return value;
}

/// The fraction behind the seconds in nanoseconds; moves `at` past it. -1: more than nine digits
/// or none.
std::int64_t fraction_ns(const std::string& text, std::size_t& at) {
    if (at >= text.size() || text[at] != '.') return 0;
    std::int64_t ns = 0;
    std::int64_t unit = 1'000'000'000;
    const std::size_t start = ++at;
    for (; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at) {
        unit /= 10;
        ns += unit * (text[at] - '0');
    }
    return at == start || at - start > 9 ? -1 : ns;
}

std::optional<Time> parse_time(const std::string& text) {
    using namespace std::chrono;
    const bool shape = text.size() >= 20 && text[4] == '-' && text[7] == '-' &&
                       (text[10] == 'T' || text[10] == 't') && text[13] == ':' && text[16] == ':';
    if (!shape) return std::nullopt;
    const int y = digits(text, 0, 4), mo = digits(text, 5, 2), d = digits(text, 8, 2);
    const int h = digits(text, 11, 2), mi = digits(text, 14, 2), s = digits(text, 17, 2);
    if (y < 1970 || y > 2200 || mo < 0 || d < 0 || h < 0 || h > 23 || mi < 0 || mi > 59 || s < 0 ||
        s > 59) {
        return std::nullopt;
    }
    const year_month_day date{year(y), month(static_cast<unsigned>(mo)),
                              day(static_cast<unsigned>(d))};
    if (!date.ok()) return std::nullopt;
    std::size_t at = 19;
    const std::int64_t ns = fraction_ns(text, at);
    if (ns < 0 || at >= text.size()) return std::nullopt;
    int offset_min = 0;
    if (text[at] == '+' || text[at] == '-') {
        const int oh = digits(text, at + 1, 2), om = digits(text, at + 4, 2);
        if (text.size() != at + 6 || text[at + 3] != ':' || oh < 0 || oh > 23 || om < 0 ||
            om > 59) {
            return std::nullopt;
        }
        offset_min = (text[at] == '-' ? -1 : 1) * (60 * oh + om);
    } else if ((text[at] != 'Z' && text[at] != 'z') || text.size() != at + 1) {
        return std::nullopt;
    }
    const std::int64_t day_s = sys_days(date).time_since_epoch().count() * std::int64_t{86'400};
    const std::int64_t in_day_s = 3600LL * h + 60LL * (mi - offset_min) + s;
    return time_from_ns((day_s + in_day_s) * 1'000'000'000 + ns);
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

std::string read_text(const Json& value, const Place& place, FieldErrors& errors,
                      TextLimits limits) {
    if (!value.is_string()) {
        wrong_type_at(errors, place.pointer(), "string");
        return {};
    }
    const auto& text = value.get_ref<const std::string&>();
    if (text.size() < limits.min || text.size() > limits.max) {
        errors.add(place.pointer(),
                   {"wrong_length", {{"min", clamped(limits.min)}, {"max", clamped(limits.max)}}},
                   "The text must have " + counted({limits.min, limits.max}) + " bytes.");
        return {};
    }
    if (std::any_of(text.begin(), text.end(),
                    [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; })) {
        errors.add(place.pointer(), {"control_character", {}},
                   "The text holds a control character; remove it.");
        return {};
    }
    return text;
}

std::string read_printable(const Json& value, const Place& place, FieldErrors& errors,
                           std::size_t most) {
    if (value.is_string()) return json::printable(value.get_ref<const std::string&>(), most);
    wrong_type_at(errors, place.pointer(), "string");
    return {};
}

double read_number(const Json& value, const Place& place, FieldErrors& errors,
                   NumberLimits limits) {
    if (!value.is_number()) {
        wrong_type_at(errors, place.pointer(), "number");
        return 0;
    }
    const auto number = value.get<double>();
    if (!(number >= limits.min && number <= limits.max)) {
        out_of_range(errors, place.pointer(), limits.min, limits.max,
                     shown(limits.min) + " to " + shown(limits.max));
        return 0;
    }
    return number;
}

std::int64_t read_integer(const Json& value, const Place& place, FieldErrors& errors,
                          IntegerLimits limits) {
    // 3.0 is an integer to JSON Schema and to every JavaScript client.
    constexpr double kExact = 9007199254740992.0;  // 2^53
    const bool whole = value.is_number_float() && std::abs(value.get<double>()) <= kExact &&
                       value.get<double>() == std::trunc(value.get<double>());
    if (!value.is_number_integer() && !whole) {
        wrong_type_at(errors, place.pointer(), "integer");
        return 0;
    }
    constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
    const bool too_large = value.is_number_unsigned() &&
                           value.get<std::uint64_t>() > static_cast<std::uint64_t>(kMost);
    const std::int64_t number = too_large ? kMost : value.get<std::int64_t>();
    if (too_large || number < limits.min || number > limits.max) {
        out_of_range(errors, place.pointer(), limits.min, limits.max,
                     std::to_string(limits.min) + " to " + std::to_string(limits.max));
        return 0;
    }
    return number;
}

Time read_time(const Json& value, const Place& place, FieldErrors& errors) {
    if (!value.is_string()) {
        wrong_type_at(errors, place.pointer(), "string");
        return {};
    }
    const auto time = parse_time(value.get_ref<const std::string&>());
    if (!time) {
        errors.add(place.pointer(), {"bad_time", {}},
                   "Write the time as RFC 3339 says, for example 2026-11-21T06:30:00Z.");
    }
    return time.value_or(Time{});
}

bool read_boolean(const Json& value, const Place& place, FieldErrors& errors) {
    if (value.is_boolean()) return value.get<bool>();
    wrong_type_at(errors, place.pointer(), "boolean");
    return false;
}

const Json* read_array(const Json& value, const Place& place, FieldErrors& errors,
                       CountLimits limits) {
    if (!value.is_array()) {
        wrong_type_at(errors, place.pointer(), "array");
        return nullptr;
    }
    if (value.size() < limits.min || value.size() > limits.max) {
        errors.add(place.pointer(),
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
    known_.emplace_back(name);
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
    return read_text(*found, {pointer_, name}, errors_, limits);
}

std::string ObjectReader::text_or(const char* name, std::string fallback, TextLimits limits) {
    return find(name) == nullptr ? fallback : text(name, limits);
}

std::string ObjectReader::printable(const char* name, std::size_t most) {
    const Json* found = required(name);
    if (found == nullptr) return {};
    return read_printable(*found, {pointer_, name}, errors_, most);
}

std::string ObjectReader::printable_or(const char* name, std::string fallback, std::size_t most) {
    return find(name) == nullptr ? fallback : printable(name, most);
}

double ObjectReader::number(const char* name, NumberLimits limits) {
    const Json* found = required(name);
    if (found == nullptr) return 0;
    return read_number(*found, {pointer_, name}, errors_, limits);
}

double ObjectReader::number_or(const char* name, double fallback, NumberLimits limits) {
    return find(name) == nullptr ? fallback : number(name, limits);
}

std::int64_t ObjectReader::integer(const char* name, IntegerLimits limits) {
    const Json* found = required(name);
    if (found == nullptr) return 0;
    return read_integer(*found, {pointer_, name}, errors_, limits);
}

std::int64_t ObjectReader::integer_or(const char* name, std::int64_t fallback,
                                      IntegerLimits limits) {
    return find(name) == nullptr ? fallback : integer(name, limits);
}

bool ObjectReader::boolean(const char* name) {
    const Json* found = required(name);
    if (found == nullptr) return false;
    return read_boolean(*found, {pointer_, name}, errors_);
}

bool ObjectReader::boolean_or(const char* name, bool fallback) {
    return find(name) == nullptr ? fallback : boolean(name);
}

std::optional<Time> ObjectReader::time_if_any(const char* name) {
    const Json* found = find(name);
    if (found == nullptr) return std::nullopt;
    return read_time(*found, {pointer_, name}, errors_);
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
        if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
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
