#pragma once

#include <string>

#include "server/base/tls.hpp"
#include "server/sessions/context.hpp"

namespace pulseline::server {

struct Address {
    std::string host;  // without brackets
    std::uint16_t port = 0;
    std::string text() const;
};
/// "127.0.0.1:8080", "[::1]:8080", "localhost:8080".
Result<Address> parse_address(const std::string& text);

/// Whether the address may be served in these options: only loopback without TLS or a proxy.
Status check_exposure(const Options& options, const Address& address);

/// A bound, listening socket; the error names the address and the remedy.
Result<tcp::acceptor> open_acceptor(net::io_context& io, const Address& address);

/// Accepts until the acceptor is closed; each connection becomes an http_session.
net::awaitable<void> accept_loop(Context& context, tcp::acceptor& acceptor, Tls* tls);

}  // namespace pulseline::server
