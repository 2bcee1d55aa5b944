#pragma once

#include <cstdint>
#include <utility>

#include "db/error.hpp"

namespace pulseline::db {

/// The whole number of a JSON value. Whatever else stands there, or does not fit, is damage: a mere
/// cast of it would not be defined. Throws db::Error.
template <class T, class Json>
T whole(const Json& json) {
    if (json.is_number_unsigned()) {
        const auto value = json.template get<std::uint64_t>();
        if (std::in_range<T>(value)) return static_cast<T>(value);
    } else if (json.is_number_integer()) {
        const auto value = json.template get<std::int64_t>();
        if (std::in_range<T>(value)) return static_cast<T>(value);
    }
    throw Error(Error::Kind::kBadValue,
                "The database holds something else where a whole number belongs; restore a "
                "backup.");
}

/// The same of an enumerator that is stored as its number.
template <class Enum, class Json>
Enum enumerator(const Json& json, Enum last) {
    const int value = whole<int>(json);
    if (value >= 0 && value <= static_cast<int>(last)) return static_cast<Enum>(value);
    throw Error(Error::Kind::kBadValue,
                "The database holds an unknown kind of something; restore a backup.");
}

}  // namespace pulseline::db
