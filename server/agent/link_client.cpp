#include "server/agent/link_client.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <utility>

#include "server/base/log.hpp"
#include "server/base/signal.hpp"
#include "server/base/web_socket.hpp"

namespace pulseline::agent {

using namespace server;
using namespace std::chrono_literals;

namespace {

constexpr auto kConnectTime = 5s;
constexpr auto kHandshakeTime = 10s;
constexpr auto kSilence = 10s;  // the server pings every second
constexpr auto kCloseTime = 1s;
constexpr double kFirstDelay_s = 0.2;
constexpr double kMostDelay_s = 5;
constexpr auto kGoodSession = 10s;  // after it the delay starts small again
constexpr std::size_t kMostBytes = 1024 * 1024;
constexpr std::uint16_t kNormalEnd = 1000;
constexpr const char* kSubprotocol = "vda5050.v2.json";

/// "a b" -> "a%20b"; manufacturers have names.
std::string path_part(const std::string& text) {
    constexpr char kHex[] = "0123456789ABCDEF";
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || c == '-' || c == '_' || c == '.' || c == '~') {
            out += c;
        } else {
            out += {'%', kHex[byte >> 4], kHex[byte & 15]};
        }
    }
    return out;
}

void log_end(const std::exception_ptr& error) {
    try {
        if (error) std::rethrow_exception(error);
    } catch (const std::exception& e) {
        server::log::error("link.failed", {{"what", e.what()}});
    }
}

}  // namespace

struct LinkClient::Impl {
    Impl(net::io_context& i, ssl::context& t, const ServerAddress& a, const Identity& who, bool v,
         Vehicle& c, std::uint64_t seed)
        : io(i),
          tls(t),
          address(a),
          identity(who),
          verify_host(v),
          vehicle(c),
          random(seed),
          signal(i),
          delay(i) {
        vehicle.outbox().wake = [this] { signal.set(); };
    }

    net::awaitable<void> session(WebSocket& socket);
    net::awaitable<void> write_loop(WebSocket& socket);
    net::awaitable<void> connect();
    net::awaitable<bool> pause_before_retry();
    net::awaitable<bool> handshake(WebSocket& socket);

    const std::string& name() const { return vehicle.plant_vehicle().id.str(); }

    net::io_context& io;
    ssl::context& tls;
    ServerAddress address;
    Identity identity;
    bool verify_host;
    Vehicle& vehicle;
    std::mt19937_64 random;
    Signal signal;
    net::steady_timer delay;
    double delay_s = kFirstDelay_s;
    bool stopping = false;
    bool was_replaced = false;
    bool open = false;
    std::string last_trouble;

    /// The same trouble is told once, not at every attempt.
    void trouble(const std::string& what) {
        if (what == last_trouble) return;
        last_trouble = what;
        server::log::warn("link.trouble", {{"vehicle", name()}, {"what", what}});
    }
};

net::awaitable<bool> LinkClient::Impl::handshake(WebSocket& socket) {
    const std::string host = address.host + ":" + address.port;
    const std::string path =
        "/vehicles/" + path_part(identity.manufacturer) + "/" + path_part(identity.serial_number);
    // A name of its own: g++ 12 cannot compile a braced list inside an awaited call.
    const WebSocket::Headers headers{{"Authorization", "Bearer " + identity.token},
                                     {"Sec-WebSocket-Protocol", kSubprotocol},
                                     {"User-Agent", "pulseline-agent"}};
    const auto opened = co_await socket.open(host, path, headers);
    if (opened.status != 0) {
        trouble(
            fmt::format("the server refused the vehicle: HTTP {} {}", opened.status, opened.body));
        co_return false;
    }
    if (opened.ec) {
        trouble("the WebSocket handshake failed: " + opened.ec.message());
        co_return false;
    }
    if (opened.subprotocol != kSubprotocol) {
        trouble("the server does not speak the subprotocol vda5050.v2.json");
        co_return false;
    }
    co_return true;
}

net::awaitable<void> LinkClient::Impl::write_loop(WebSocket& socket) {
    error_code ec;
    while (open && !stopping) {
        auto frame = vehicle.outbox().take();
        if (!frame) {
            co_await signal.wait(1h);
            continue;
        }
        ec = co_await socket.write(frame->bytes, !frame->binary);
        if (ec) break;
    }
    if (!open) co_return;
    net::steady_timer limit(io, kCloseTime);
    limit.async_wait([&socket](const error_code& cancelled) {
        if (!cancelled) socket.cancel();
    });
    if (!ec) {
        const std::string goodbye = vehicle.offline_frame();
        ec = co_await socket.write(goodbye);
    }
    if (!ec) co_await socket.close(kNormalEnd, "");
    limit.cancel();
    socket.cancel();  // ends the reader whatever became of the close
}

net::awaitable<void> LinkClient::Impl::session(WebSocket& socket) {
    if (!co_await handshake(socket)) co_return;
    const auto began = Vehicle::Steady::now();
    server::log::info("link.open",
                      {{"vehicle", name()}, {"host", address.host}, {"port", address.port}});
    last_trouble.clear();
    open = true;
    vehicle.link_up();
    // The writer ends before the socket goes: it is awaited below.
    bool writing = true;
    Signal written(io);
    net::co_spawn(io, write_loop(socket), [&](const std::exception_ptr& error) {
        log_end(error);
        writing = false;
        written.set();
    });
    error_code ec;
    for (;;) {
        ec = co_await socket.read();
        if (ec) break;
        if (socket.message_is_text()) vehicle.receive(socket.message());
    }
    open = false;
    socket.cancel();
    signal.set();
    while (writing) co_await written.wait(1h);
    vehicle.link_down();
    if (ec == websocket::error::closed && socket.close_code() == kReplaced) {
        was_replaced = true;
        server::log::error("link.replaced",
                           {{"vehicle", name()},
                            {"what",
                             "Another session with this identity took over; this one stays away. "
                             "End the other program or start only one."}});
    } else if (!stopping) {
        server::log::warn("link.ended", {{"vehicle", name()},
                                         {"what", ec.message()},
                                         {"reason", std::string(socket.close_reason())}});
    }
    if (Vehicle::Steady::now() - began > kGoodSession) delay_s = kFirstDelay_s;
}

net::awaitable<void> LinkClient::Impl::connect() {
    error_code ec;
    tcp::resolver resolver(io);
    const auto found = co_await resolver.async_resolve(address.host, address.port, into(ec));
    if (ec) co_return trouble("cannot resolve " + address.host + ": " + ec.message());
    ByteStream stream =
        address.tls ? ByteStream(tcp::socket(io), tls) : ByteStream(tcp::socket(io));
    stream.lowest().expires_after(kConnectTime);
    co_await stream.lowest().async_connect(found, into(ec));
    if (ec) {
        co_return trouble("cannot connect to " + address.host + ":" + address.port + ": " +
                          ec.message());
    }
    stream.lowest().socket().set_option(tcp::no_delay(true), ec);
    if (address.tls) {
        stream.expect_host(address.host, verify_host);
        ec = co_await stream.handshake(ssl::stream_base::client);
        if (ec) {
            co_return trouble("the TLS handshake failed: " + ec.message() +
                              "; give --ca FILE for a private authority or --insecure for a test");
        }
    }
    WebSocket socket(
        std::move(stream),
        {.most_bytes = kMostBytes, .idle = kSilence, .pings = true, .opening = kHandshakeTime});
    co_await session(socket);
}

/// Waits between half and the whole delay, doubled each time. False when told to stop.
net::awaitable<bool> LinkClient::Impl::pause_before_retry() {
    if (stopping) co_return false;
    const double wait_s = delay_s * std::uniform_real_distribution<double>(0.5, 1.0)(random);
    delay_s = std::min(kMostDelay_s, 2 * delay_s);
    error_code ec;
    delay.expires_after(std::chrono::duration_cast<std::chrono::milliseconds>(
        std::chrono::duration<double>(wait_s)));
    co_await delay.async_wait(into(ec));
    co_return !stopping;
}

LinkClient::LinkClient(net::io_context& io, ssl::context& tls, const ServerAddress& address,
                       const Identity& identity, bool verify_host, Vehicle& vehicle,
                       std::uint64_t seed)
    : impl_(std::make_unique<Impl>(io, tls, address, identity, verify_host, vehicle, seed)) {}

LinkClient::~LinkClient() = default;

net::awaitable<void> LinkClient::run() {
    for (;;) {
        co_await impl_->connect();
        if (impl_->was_replaced) co_return;
        // Not joined with the line above: g++ 12 miscompiles co_await behind && in a condition.
        const bool again = co_await impl_->pause_before_retry();
        if (!again) co_return;
    }
}

void LinkClient::stop() {
    impl_->stopping = true;
    impl_->signal.set();
    impl_->delay.cancel();
}

bool LinkClient::replaced() const { return impl_->was_replaced; }

}  // namespace pulseline::agent
