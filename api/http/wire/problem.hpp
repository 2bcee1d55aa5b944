#pragma once

#include <string>

#include "api/http/wire/message.hpp"
#include "core/base/result.hpp"

/// RFC 9457 problems: the shape of every error the API answers.
namespace pulseline::api {

/// HTTP status of an error. kInvalid is 400 when the request's shape is wrong and 422 when it is
/// well formed but asks for what cannot be; the reason code decides.
int http_status(const Error& error);

/// application/problem+json with type urn:pulseline:problem:<code>.
Response problem(const Error& error, const Request& request);
Response problem(int status, const Error& error, const Request& request);

/// The last resort: something of ours broke. Says nothing of what.
Response internal_error(const Request& request);
/// The store refused: nothing was kept, the caller may repeat.
Response unavailable(const Request& request);
/// 413, for the server that stops reading a body at `limit_bytes`.
Response too_large(const Request& request, std::size_t limit_bytes);
/// 400 for a request line or header that cannot be read.
Response bad_request(const Request& request, const std::string& code, const std::string& what);

}  // namespace pulseline::api
