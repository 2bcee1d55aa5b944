#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/json/parse.hpp"
#include "core/base/time.hpp"

namespace pulseline::json {

/// What is wrong with a document, each with the JSON pointer of the place. Keeps the first 100.
class FieldErrors {
public:
    static constexpr std::size_t kMost = 100;

    void add(std::string pointer, Reason reason, std::string what);
    bool empty() const { return errors_.empty(); }
    const std::vector<Error>& all() const { return errors_; }
    /// The first error, or success.
    Status status() const;

private:
    std::vector<Error> errors_;
};

struct TextLimits {
    std::size_t min = 0;
    std::size_t max = 1000;  // bytes
};
struct NumberLimits {
    double min = std::numeric_limits<double>::lowest();
    double max = std::numeric_limits<double>::max();
};
struct IntegerLimits {
    std::int64_t min = std::numeric_limits<std::int64_t>::min();
    std::int64_t max = std::numeric_limits<std::int64_t>::max();
};
struct CountLimits {
    std::size_t min = 0;
    std::size_t max = std::numeric_limits<std::size_t>::max();
};

/// Pointer one level down, escaped as RFC 6901 says.
std::string child_pointer(const std::string& pointer, std::string_view key);
std::string child_pointer(const std::string& pointer, std::size_t index);

/// Where a value stands. Written out only when something is wrong with it: vehicles report ten
/// times a second, and all but a few of their fields are right.
class Place {
public:
    Place(const std::string& pointer) : pointer_(pointer) {}  // NOLINT: a pointer is a place
    Place(const std::string& parent, const char* key) : pointer_(parent), key_(key) {}
    std::string pointer() const {
        return key_ ? child_pointer(pointer_, std::string_view(key_)) : pointer_;
    }

private:
    const std::string& pointer_;  // outlives it: a Place is an argument only
    const char* key_ = nullptr;
};

// One value of a type. On failure the error is kept and a default comes back.
// Reason codes: wrong_type {expected}, wrong_length {min, max}, control_character,
// out_of_range {min, max}, not_one_of {allowed}, wrong_count {min, max}.
std::string read_text(const Json& value, const Place& place, FieldErrors& errors,
                      TextLimits limits = {});
/// Text that is only shown, as printable() makes it of whatever it is: no line feed in it makes a
/// message worthless.
std::string read_printable(const Json& value, const Place& place, FieldErrors& errors,
                           std::size_t most);
double read_number(const Json& value, const Place& place, FieldErrors& errors,
                   NumberLimits limits = {});
std::int64_t read_integer(const Json& value, const Place& place, FieldErrors& errors,
                          IntegerLimits limits = {});
/// RFC 3339: "2026-11-21T06:30:00Z", any offset, up to nine decimals. Reason code: bad_time.
Time read_time(const Json& value, const Place& place, FieldErrors& errors);
bool read_boolean(const Json& value, const Place& place, FieldErrors& errors);
/// Null with an error kept when it is no array or has too few or too many items.
const Json* read_array(const Json& value, const Place& place, FieldErrors& errors,
                       CountLimits limits = {});

/// Reads the members of one object by name and remembers which were asked for. Further reason
/// codes: missing_field, unknown_field. `value` must outlive it.
///
///     ObjectReader in(json, "", errors);
///     order.priority = in.integer_or("priority", 0, {-100, 100});
///     in.refuse_unknown();
class ObjectReader {
public:
    ObjectReader(const Json& value, std::string pointer, FieldErrors& errors);

    const std::string& pointer() const { return pointer_; }
    FieldErrors& errors() const { return errors_; }
    bool has(const char* name) { return find(name) != nullptr; }

    std::string text(const char* name, TextLimits limits = {});
    std::string text_or(const char* name, std::string fallback, TextLimits limits = {});
    std::string printable(const char* name, std::size_t most);
    std::string printable_or(const char* name, std::string fallback, std::size_t most);
    double number(const char* name, NumberLimits limits = {});
    double number_or(const char* name, double fallback, NumberLimits limits = {});
    std::int64_t integer(const char* name, IntegerLimits limits = {});
    std::int64_t integer_or(const char* name, std::int64_t fallback, IntegerLimits limits = {});
    bool boolean(const char* name);
    bool boolean_or(const char* name, bool fallback);

    std::optional<Time> time_if_any(const char* name);

    /// One of `values`, written as to_string(value) writes it.
    template <class T>
    T one_of(const char* name, std::initializer_list<T> values) {
        const Json* found = required(name);
        return found == nullptr ? T{} : match(*found, name, values);
    }
    template <class T>
    T one_of_or(const char* name, T fallback, std::initializer_list<T> values) {
        const Json* found = find(name);
        return found == nullptr ? fallback : match(*found, name, values);
    }

    /// Calls visit(item, pointer of the item) for each item of an array.
    template <class Visit>
    void items(const char* name, CountLimits limits, Visit visit) {
        visit_items(required(name), name, limits, visit);
    }
    template <class Visit>
    void items_if_any(const char* name, CountLimits limits, Visit visit) {
        visit_items(find(name), name, limits, visit);
    }

    /// A member object; reads as empty, its fields not reported as missing, when it is absent or no
    /// object.
    ObjectReader object(const char* name);
    std::optional<ObjectReader> object_if_any(const char* name);
    /// The member as it is, marked as known; null when absent.
    const Json* find(const char* name);
    const Json* required(const char* name);

    /// Every member nobody asked for is an error. Call last.
    void refuse_unknown();

private:
    template <class T>
    T match(const Json& value, const char* name, std::initializer_list<T> values) {
        std::string allowed;
        if (!value.is_string()) {
            wrong_type(child_pointer(pointer_, std::string_view(name)), "string");
            return T{};
        }
        for (const T candidate : values) {
            const std::string_view text = to_string(candidate);  // found by the type's namespace
            if (value.template get_ref<const std::string&>() == text) return candidate;
            allowed += (allowed.empty() ? "" : ", ") + std::string(text);
        }
        not_one_of(name, allowed);
        return T{};
    }
    template <class Visit>
    void visit_items(const Json* value, const char* name, CountLimits limits, Visit visit) {
        if (value == nullptr) return;
        const Json* array = read_array(*value, {pointer_, name}, errors_, limits);
        if (array == nullptr || array->empty()) return;
        const std::string at = child_pointer(pointer_, std::string_view(name));
        for (std::size_t i = 0; i < array->size(); ++i) visit((*array)[i], child_pointer(at, i));
    }
    void wrong_type(const std::string& pointer, const char* expected);
    void not_one_of(const char* name, const std::string& allowed);

    const Json* value_;  // null: not an object, already reported
    std::string pointer_;
    FieldErrors& errors_;
    std::vector<std::string_view> known_;  // asked for; a few, some of them twice
};

}  // namespace pulseline::json
