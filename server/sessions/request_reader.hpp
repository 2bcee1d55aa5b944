#pragma once

#include <optional>

#include "api/http/wire/message.hpp"
#include "server/base/net.hpp"
#include "server/base/options.hpp"
#include "server/base/proxies.hpp"

namespace pulseline::server {

using Parser = http::request_parser<http::string_body>;

/// The handlers' view of a parsed request. An error says what is wrong with the head.
Result<api::Request> to_request(const Limits& limits, const TrustedProxies& proxies,
                                const Parser::value_type& message, const std::string& peer,
                                bool tls);

/// A usable id of the client's, else a new one.
std::string request_id(beast::string_view offered);

/// The answer to a request that could not be read; nothing when the connection just ended.
std::optional<api::Response> answer_to(const error_code& ec, const api::Request& request,
                                       std::size_t body_limit);

}  // namespace pulseline::server
