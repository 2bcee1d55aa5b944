#pragma once

#include "core/base/error.hpp"

/// What FleetRuntime says to those it does not serve, besides what its store is to blame for.
namespace pulseline::server {

inline Error overloaded() {
    return {Errc::kOverloaded,
            {"overloaded", {{"retry_after_s", std::int64_t{1}}}},
            "Too many commands wait. Try again in a second.",
            {}};
}

inline Error internal() {
    return {Errc::kInternal,
            {"internal", {}},
            "The server met a fault of its own and changed nothing; its log has the request id.",
            {}};
}

inline Error stopping() {
    return {Errc::kUnavailable, {"stopping", {}}, "The server is stopping.", {}};
}
inline Error expired() {
    return {Errc::kUnavailable,
            {"command_expired", {{"retry_after_s", std::int64_t{1}}}},
            "This waited for more than five seconds and was dropped; nothing was changed.",
            {}};
}

}  // namespace pulseline::server
