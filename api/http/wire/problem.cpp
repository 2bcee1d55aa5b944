#include "api/http/wire/problem.hpp"

#include <algorithm>
#include <cctype>

#include "api/http/wire/common_json.hpp"

namespace pulseline::api {
namespace {

constexpr std::size_t kMaxShownField = 200;

/// "unknown_station" -> "Unknown station": the same words for the same type, always.
std::string title_of(const std::string& code) {
    std::string title = code;
    for (char& c : title) {
        if (c == '_') c = ' ';
    }
    if (!title.empty()) {
        title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
    }
    return title;
}

std::string shortened(const std::string& field) {
    std::size_t size = std::min(field.size(), kMaxShownField);
    while (size < field.size() && size > 0 &&
           (static_cast<unsigned char>(field[size]) & 0xC0U) == 0x80U) {
        --size;  // not in the middle of a character
    }
    return field.substr(0, size);
}

}  // namespace

int http_status(const Error& error) {
    switch (error.code) {
        case Errc::kInvalid:
            return 422;
        case Errc::kNotFound:
            return 404;
        case Errc::kConflict:
            return 409;
        case Errc::kStale:
            return 412;
        case Errc::kUnreachable:
            return 422;
        case Errc::kTimeout:
            return 504;
        case Errc::kUnavailable:
        case Errc::kOverloaded:
        case Errc::kNeedsPlan:
            return 503;
        case Errc::kUnauthenticated:
            return 401;
        case Errc::kForbidden:
            return 403;
        case Errc::kTooMany:
            return 429;
        case Errc::kInternal:
            return 500;
    }
    return 500;
}

Response problem(int status, const Error& error, const Request& request) {
    const std::string& code = error.reason.code;
    Json body = {{"type", "urn:pulseline:problem:" + code},
                 {"title", title_of(code)},
                 {"status", status},
                 {"code", code},
                 {"detail", error.what},
                 {"params", params_json(error.reason.params)},
                 {"request_id", request.request_id}};
    // The pointer may hold a name the client made up: no need to send all of it back.
    if (!error.field.empty()) body["field"] = shortened(error.field);
    Response response{
        status, "application/problem+json", {{"Cache-Control", "no-store"}}, dump(body)};
    for (const Param& param : error.reason.params) {
        if (param.name == "retry_after_s" && std::holds_alternative<std::int64_t>(param.value)) {
            response.headers.emplace_back("Retry-After",
                                          std::to_string(std::get<std::int64_t>(param.value)));
        }
    }
    if (status == 401) response.headers.emplace_back("WWW-Authenticate", "Bearer");
    return response;
}

Response problem(const Error& error, const Request& request) {
    return problem(http_status(error), error, request);
}

Response internal_error(const Request& request) {
    return problem(500,
                   Error{Errc::kUnavailable,
                         {"internal_error", {}},
                         "The server failed at this request; give its request_id to whoever runs "
                         "the server.",
                         {}},
                   request);
}

Response unavailable(const Request& request) {
    return problem(503,
                   Error{Errc::kUnavailable,
                         {"store_unavailable", {{"retry_after_s", std::int64_t{2}}}},
                         "The request could not be stored, so nothing was changed; try again, and "
                         "look at the server's disk when it stays so.",
                         {}},
                   request);
}

Response too_large(const Request& request, std::size_t limit_bytes) {
    return problem(
        413,
        Error{Errc::kInvalid,
              {"body_too_large", {{"limit_bytes", static_cast<std::int64_t>(limit_bytes)}}},
              "The body is too large; send a smaller one.",
              {}},
        request);
}

Response bad_request(const Request& request, const std::string& code, const std::string& what) {
    return problem(400, Error{Errc::kInvalid, {code, {}}, what, {}}, request);
}

}  // namespace pulseline::api
