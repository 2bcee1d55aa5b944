#pragma once

#include <optional>
#include <string>

#include "api/http/wire/message.hpp"
#include "server/base/byte_stream.hpp"
#include "server/sessions/context.hpp"
#include "server/sessions/request_reader.hpp"

namespace pulseline::server {

/// One request as far as it was read from a connection.
struct Received {
    /// There was none: the connection broke, or nothing came in time.
    bool ended = false;
    /// Without its body, which the parser has. Of what could not be read only what is known.
    api::Request request;
    /// What is refused may have a body behind it that nobody reads: the connection has to end.
    std::optional<api::Response> refusal;
    /// Held while the body is in memory.
    Quota::Slot slot;
};

/// Reads a request to its end. Head and body each have one deadline for all of it, and whether the
/// body is read at all is decided by the head. `first`: nothing was read from this connection yet.
net::awaitable<Received> receive(Context& context, ByteStream& stream, beast::flat_buffer& buffer,
                                 Parser& parser, const std::string& peer, bool first);

/// Abruptly: close() throws away what the other side has not read. Who reads slowly is then cut and
/// not served by the kernel for as long as it likes.
void end_abruptly(ByteStream& stream, bool abruptly);

}  // namespace pulseline::server
