#pragma once

#include <optional>
#include <string>

#include "server/base/web_socket.hpp"
#include "server/sessions/context.hpp"

/// What a connection is: one coroutine each.
namespace pulseline::server {

/// What a connection goes on as when its HTTP is over: not started yet, and nothing of what HTTP
/// needed is kept for it, because it stays for days. None: the connection has ended.
using Next = std::optional<net::awaitable<void>>;

/// Reads, routes and answers requests until the connection ends or becomes something else.
net::awaitable<Next> http_session(Context& context, ByteStream stream, std::string peer);

/// /api/v1/stream, after the identity and origin were checked.
net::awaitable<void> stream_session(Context& context, ByteStream stream, Upgrade upgrade,
                                    api::Request request);

/// /api/v1/vehicles/{id}/hand-held, after identity, origin and vehicle were checked.
net::awaitable<void> hand_held_session(Context& context, ByteStream stream, Upgrade upgrade,
                                       api::Request request, plant::VehicleId vehicle);

/// /api/v1/events.
net::awaitable<void> event_session(Context& context, ByteStream& stream, api::Request request,
                                   unsigned version);

/// /vehicles/{manufacturer}/{serialNumber}, after the token was checked.
net::awaitable<void> vehicle_session(Context& context, ByteStream stream, Upgrade upgrade,
                                     plant::VehicleId vehicle);

/// Writes an answer with the headers every answer has. False when the connection is to be closed.
net::awaitable<bool> write_response(Context& context, ByteStream& stream,
                                    const api::Request& request, const api::Response& response,
                                    unsigned version, bool keep_alive,
                                    const Asset* asset = nullptr);

/// Headers that tell browsers what not to do.
void add_security_headers(http::fields& fields, bool tls);

}  // namespace pulseline::server
