#pragma once

#include <string>

#include "api/access/secrets.hpp"
#include "api/http/wire/message.hpp"
#include "core/base/result.hpp"

namespace pulseline::api {

/// Idempotency-Key of the request; empty: it has none.
Result<std::string> read_idempotency_key(const Request& request);

/// Who asks, and the key under which the answer is kept.
template <class Asked>
Status read_asker(const Request& request, const std::string& digested, Asked& to) {
    const auto key = read_idempotency_key(request);
    if (!key) return fail(key.error());
    to.actor = request.identity.name;
    to.idempotency_client = request.identity.name;
    to.idempotency_key = *key;
    to.body_sha256 = access::sha256_hex(digested);
    return {};
}

}  // namespace pulseline::api
