#include "server/sessions/listener.hpp"

#include "server/base/descriptors.hpp"
#include "server/sessions/sessions.hpp"

namespace pulseline::server {
namespace {

constexpr int kRefusedAtOnce = 256;

void ended(const std::exception_ptr& error) {
    try {
        if (error) std::rethrow_exception(error);
    } catch (const std::exception& e) {
        log::error("session_threw", {{"what", e.what()}});
    }
}

/// Places a connection takes, given back when its coroutine ends.
struct Place {
    Place(Context& c, Quota::Slot s) : context(c), slot(std::move(s)) {
        ++context.connections;
        ++context.metrics.connections;
    }
    ~Place() {
        --context.connections;
        --context.metrics.connections;
    }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    Context& context;
    Quota::Slot slot;
};

/// What the connection is at first, whatever it goes on as.
net::awaitable<Next> first_session(Context& context, tcp::socket socket, Tls* tls,
                                   std::string peer) {
    error_code ec;
    socket.set_option(tcp::no_delay(true), ec);
    if (!tls) {
        co_return co_await http_session(context, ByteStream(std::move(socket)), std::move(peer));
    }
    ByteStream stream(std::move(socket), tls->context);
    stream.lowest().expires_after(context.options.limits.tls_handshake);
    if (co_await stream.handshake(ssl::stream_base::server)) co_return std::nullopt;
    co_return co_await http_session(context, std::move(stream), std::move(peer));
}

net::awaitable<void> serve(Context& context, tcp::socket socket, Tls* tls, Quota::Slot slot,
                           std::string peer) {
    const Place place(context, std::move(slot));
    auto next = co_await first_session(context, std::move(socket), tls, std::move(peer));
    if (next) co_await std::move(*next);
}

}  // namespace

std::string Address::text() const {
    const bool six = host.find(':') != std::string::npos;
    return (six ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

Result<Address> parse_address(const std::string& text) {
    const auto colon = text.rfind(':');
    Address address;
    const auto wrong = fail(Errc::kInvalid, "bad_address",
                            "--listen " + text + " is no address; write 127.0.0.1:8080");
    if (colon == std::string::npos) return wrong;
    address.host = text.substr(0, colon);
    const auto port = text.substr(colon + 1);
    if (address.host.size() > 2 && address.host.front() == '[' && address.host.back() == ']') {
        address.host = address.host.substr(1, address.host.size() - 2);
    }
    if (address.host.empty() || port.empty() || port.size() > 5 ||
        port.find_first_not_of("0123456789") != std::string::npos || std::stoi(port) > 65535) {
        return wrong;
    }
    if (address.host == "localhost") address.host = "127.0.0.1";
    address.port = static_cast<std::uint16_t>(std::stoi(port));
    return address;
}

Status check_exposure(const Options& options, const Address& address) {
    if (options.tls_cert.empty() != options.tls_key.empty()) {
        return fail(Errc::kInvalid, "bad_option", "--tls-cert and --tls-key belong together");
    }
    error_code ec;
    const auto ip = net::ip::make_address(address.host, ec);
    if (ec) {
        return fail(Errc::kInvalid, "bad_address",
                    "--listen " + address.host + " is no IP address; write one of this machine");
    }
    if (const auto proxies = TrustedProxies::parse(options.behind_proxy); !proxies) {
        return fail(proxies.error());
    }
    if (ip.is_loopback() || options.tls() || !options.behind_proxy.empty()) return {};
    return fail(Errc::kInvalid, "tls_required",
                "refusing to serve " + address.text() +
                    " without encryption: passwords and tokens would travel in clear. Give "
                    "--tls-cert and --tls-key, or --tls-self-signed, or listen on 127.0.0.1, or "
                    "--behind-proxy with the addresses of the proxies in front that end TLS");
}

Result<tcp::acceptor> open_acceptor(net::io_context& io, const Address& address) {
    error_code ec;
    const tcp::endpoint endpoint(net::ip::make_address(address.host, ec), address.port);
    tcp::acceptor acceptor(io);
    if (!ec) acceptor.open(endpoint.protocol(), ec);
    if (!ec) acceptor.set_option(net::socket_base::reuse_address(true), ec);
    if (!ec) acceptor.bind(endpoint, ec);
    if (!ec) acceptor.listen(net::socket_base::max_listen_connections, ec);
    if (!ec) return acceptor;
    if (ec == net::error::address_in_use) {
        return fail(Errc::kInvalid, "address_in_use",
                    address.text() +
                        " is in use by another program; stop that program or choose another "
                        "address with --listen");
    }
    return fail(Errc::kInvalid, "bad_address",
                "cannot listen on " + address.text() + ": " + ec.message() +
                    "; choose an address of this machine with --listen");
}

net::awaitable<void> accept_loop(Context& context, tcp::acceptor& acceptor, Tls* tls) {
    const Limits& limits = context.options.limits;
    SpareDescriptor spare;
    for (;;) {
        error_code ec;
        tcp::socket socket(context.io);
        co_await acceptor.async_accept(socket, into(ec));
        if (!acceptor.is_open() || ec == net::error::operation_aborted) co_return;
        if (ec) {
            // Out of file descriptors: those we have go on, new ones are closed.
            context.metrics.connections_refused += spare.refuse_waiting(acceptor, kRefusedAtOnce);
            net::steady_timer timer(context.io, std::chrono::milliseconds(20));
            co_await timer.async_wait(into(ec));
            continue;
        }
        const auto remote = socket.remote_endpoint(ec);
        if (ec) continue;
        const auto address = plain_address(remote.address());
        const std::string peer = address.to_string();
        const bool proxy = context.proxies.contains(peer);
        if (!proxy && !tls && !context.proxies.empty() && !address.is_loopback()) {
            // Only the proxies end TLS: who comes past them would send secrets in clear.
            ++context.metrics.connections_refused;
            continue;
        }
        // A proxy and the machine itself speak for many; the rest may not crowd others out.
        const bool many = proxy || address.is_loopback();
        auto slot = many ? Quota::Slot{} : context.peers.take(neighbourhood(peer));
        if (context.connections >= limits.connections || (!many && !slot)) {
            ++context.metrics.connections_refused;
            continue;
        }
        net::co_spawn(context.io, serve(context, std::move(socket), tls, std::move(slot), peer),
                      ended);
    }
}

}  // namespace pulseline::server
