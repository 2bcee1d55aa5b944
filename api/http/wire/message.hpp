#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/access/identity.hpp"

/// Requests and responses as the handlers see them: no socket, no Beast.
namespace pulseline::api {

struct Request {
    std::string method;                             // "GET"
    std::string path;                               // as sent, still percent-encoded
    std::multimap<std::string, std::string> query;  // decoded
    std::map<std::string, std::string> headers;     // names in lower case
    std::map<std::string, std::string> params;      // of the path; match() fills them, decoded
    std::string body;
    std::string
        request_id;       // X-Request-Id of the client when it is usable, else made by the server
    std::string peer;     // address without the port
    bool secure = false;  // came over TLS, or from a proxy that ends TLS
    access::Identity identity;

    /// Empty when there is none.
    const std::string& header(std::string_view lower_case_name) const;
    const std::string& param(std::string_view name) const;
    std::optional<std::string> query_value(std::string_view name) const;
};

struct Response {
    int status = 200;
    std::string content_type = "application/json";
    std::vector<std::pair<std::string, std::string>> headers;
    std::string body;
};

/// Splits a request target ("/api/v1/x?limit=3") into path and decoded query; false when it is no
/// origin-form target or a percent-encoding is broken.
bool parse_target(std::string_view target, Request& request);

/// Decodes %XX (and '+' when `plus_is_space`); nothing when it is broken, holds a NUL or no UTF-8.
std::optional<std::string> percent_decoded(std::string_view text, bool plus_is_space);

/// Well-formed UTF-8: no overlong forms, no surrogates.
bool is_utf8(std::string_view text);

}  // namespace pulseline::api
