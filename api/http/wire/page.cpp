#include "api/http/wire/page.hpp"

#include <algorithm>
#include <charconv>

#include "api/access/secrets.hpp"

namespace pulseline::api {

std::optional<std::int64_t> parse_integer(std::string_view text, std::int64_t min,
                                          std::int64_t max) {
    std::int64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    if (text.empty() || error != std::errc{} || stopped != end) return std::nullopt;
    if (value < min || value > max) return std::nullopt;
    return value;
}

std::string cursor_of(const Uuid& last) {
    return access::base64url({reinterpret_cast<const char*>(last.bytes.data()), last.bytes.size()});
}

std::optional<Uuid> uuid_of_cursor(std::string_view cursor) {
    const std::string bytes = access::from_base64url(cursor);
    Uuid uuid;
    if (bytes.size() != uuid.bytes.size()) return std::nullopt;
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(uuid.bytes.data()));
    return uuid;
}

}  // namespace pulseline::api
