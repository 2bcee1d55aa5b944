#pragma once

#include <optional>
#include <string>

#include "server/context.hpp"

/// One coroutine each. Stream is PlainStream or TlsStream; both are instantiated in the .cpp.
namespace pulseline::server {

/// What a connection goes on as when its HTTP is over: not started yet, and nothing of what HTTP
/// needed is kept for it, because it stays for days. None: the connection has ended.
using Next = std::optional<net::awaitable<void>>;

/// Reads, routes and answers requests until the connection ends or becomes something else.
template <class Stream>
net::awaitable<Next> http_session(Context& context, Stream stream, std::string peer);

/// /api/v1/stream, after the identity and origin were checked.
template <class Stream>
net::awaitable<void> stream_session(Context& context, Stream stream, Upgrade upgrade,
                                    api::Request request);

/// /api/v1/events.
template <class Stream>
net::awaitable<void> event_session(Context& context, Stream& stream, api::Request request,
                                   unsigned version);

/// /vehicles/{manufacturer}/{serialNumber}, after the token was checked.
template <class Stream>
net::awaitable<void> vehicle_session(Context& context, Stream stream, Upgrade upgrade,
                                     plant::VehicleId vehicle);

/// Writes an answer with the headers every answer has. False when the connection is to be closed.
template <class Stream>
net::awaitable<bool> write_response(Context& context, Stream& stream, const api::Request& request,
                                    const api::Response& response, unsigned version,
                                    bool keep_alive, const Asset* asset = nullptr);

/// Headers that tell browsers what not to do.
void add_security_headers(http::fields& fields, bool tls);

}  // namespace pulseline::server
