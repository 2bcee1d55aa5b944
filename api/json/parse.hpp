#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/result.hpp"

/// All JSON from outside comes in through here.
namespace pulseline::json {

using Json = nlohmann::json;

struct JsonLimits {
    int max_depth = 32;
    std::size_t max_nodes = 10'000;  // values of every kind, containers included
};
constexpr JsonLimits kPlantImport{32, 1'000'000};

/// The one guarded parser: never throws on any text, never recurses, and what it returns is shallow
/// enough to copy and print. Errors (Errc::kInvalid), reason codes: json_too_deep {limit},
/// json_too_large {limit}, json_duplicate_key {key}, json_syntax {line, column}, json_number {line,
/// column}.
[[nodiscard]] Result<Json> parse_json(std::string_view text, JsonLimits limits = {});

}  // namespace pulseline::json
