#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pulseline::json {

/// Bytes of the well-formed UTF-8 character at the start of `text`: no overlong forms, no
/// surrogates; 0: there is none.
std::size_t utf8_length(std::string_view text);

/// What others wrote, a person with a vehicle's screen or whoever printed a code that lies on the
/// floor, as it can be shown and sent on: control characters and what is no UTF-8 become U+FFFD,
/// and what exceeds `most` bytes is cut off between two characters.
std::string printable(std::string_view text, std::size_t most);

}  // namespace pulseline::json
