#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "api/http/wire/message.hpp"
#include "api/http/wire/page.hpp"
#include "core/base/result.hpp"

namespace pulseline::api {

/// Numbers of stations that a client may name.
constexpr std::int64_t kMaxStation = 1'000'000'000;

/// "?name=true"; false when it is not there.
Result<bool> read_flag(const Request& request, const std::string& name);
/// How many items a page has.
Result<int> read_limit(const Request& request);
tl::unexpected<Error> bad_cursor();

/// The item with which the page before ended; empty for the first page.
template <class AnyId>
Result<AnyId> read_cursor(const Request& request) {
    const auto text = request.query_value("cursor");
    if (!text) return AnyId{};
    const auto uuid = uuid_of_cursor(*text);
    if (!uuid) return bad_cursor();
    return AnyId(*uuid);
}

/// Sequence number behind which an event stream starts; nothing: with the next event.
Result<std::optional<std::int64_t>> read_event_start(const Request& request);

}  // namespace pulseline::api
