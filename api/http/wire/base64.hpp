#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace pulseline::api {

/// RFC 4648 section 4, with padding.
std::string to_base64(std::string_view bytes);
/// Nothing when the text is no such base64.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace pulseline::api
