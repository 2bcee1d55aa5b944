#include "api/http/wire/asker.hpp"

#include <algorithm>

namespace pulseline::api {
namespace {

constexpr std::size_t kMaxKeyBytes = 128;

}  // namespace

/// The draft standard quotes the key, most clients do not: both are the same key.
Result<std::string> read_idempotency_key(const Request& request) {
    const auto it = request.headers.find("idempotency-key");
    if (it == request.headers.end()) return std::string();
    std::string key = it->second;
    if (key.size() >= 2 && key.front() == '"' && key.back() == '"') {
        key = key.substr(1, key.size() - 2);
    }
    const bool printable =
        std::all_of(key.begin(), key.end(), [](char c) { return c > ' ' && c <= '~'; });
    if (key.empty() || key.size() > kMaxKeyBytes || !printable) {
        return fail(Errc::kInvalid, "bad_idempotency_key",
                    "An Idempotency-Key has 1 to 128 printable ASCII characters; send such a one.",
                    "Idempotency-Key");
    }
    return key;
}

}  // namespace pulseline::api
