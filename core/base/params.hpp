#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/base/error.hpp"

namespace pulseline {

/// The parameter of that name; nullptr: there is none.
inline const ParamValue* find_param(const Params& params, std::string_view name) {
    const auto found = std::ranges::find(params, name, &Param::name);
    return found == params.end() ? nullptr : &found->value;
}

/// A text of that name; nullptr: there is none, or it is no text.
inline const std::string* text_param(const Params& params, std::string_view name) {
    const auto* value = find_param(params, name);
    return value == nullptr ? nullptr : std::get_if<std::string>(value);
}

/// A number of that name, be it written as a whole one; nothing: there is none, or it is no number.
inline std::optional<double> number_param(const Params& params, std::string_view name) {
    const auto* value = find_param(params, name);
    if (value == nullptr) return std::nullopt;
    if (const auto* whole = std::get_if<std::int64_t>(value)) return static_cast<double>(*whole);
    const auto* real = std::get_if<double>(value);
    return real == nullptr ? std::nullopt : std::optional(*real);
}

}  // namespace pulseline
