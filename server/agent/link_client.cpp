#include "server/agent/link_client.hpp"

#include <openssl/ssl.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <boost/asio/ssl/host_name_verification.hpp>
#include <random>
#include <utility>

#include "server/signal.hpp"

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
        spdlog::error("the link threw: {}", e.what());
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

    template <class Stream>
    net::awaitable<void> session(websocket::stream<Stream>& socket);
    template <class Stream>
    net::awaitable<void> write_loop(websocket::stream<Stream>& socket);
    net::awaitable<void> connect();
    net::awaitable<bool> pause_before_retry();
    template <class Stream>
    net::awaitable<bool> handshake(websocket::stream<Stream>& socket);

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
        spdlog::warn("{}: {}", name(), what);
    }
};

template <class Stream>
net::awaitable<bool> LinkClient::Impl::handshake(websocket::stream<Stream>& socket) {
    socket.set_option(websocket::stream_base::timeout{kHandshakeTime, kSilence, true});
    socket.set_option(
        websocket::stream_base::decorator([token = identity.token](websocket::request_type& r) {
            r.set(http::field::authorization, "Bearer " + token);
            r.set(http::field::sec_websocket_protocol, "vda5050.v2.json");
            r.set(http::field::user_agent, "pulseline-agent");
        }));
    socket.read_message_max(kMostBytes);
    socket.auto_fragment(false);
    error_code ec;
    websocket::response_type response;
    const std::string host = address.host + ":" + address.port;
    const std::string path =
        "/vehicles/" + path_part(identity.manufacturer) + "/" + path_part(identity.serial_number);
    co_await socket.async_handshake(response, host, path, into(ec));
    if (ec == websocket::error::upgrade_declined) {
        std::string body = response.body();
        body.resize(std::min<std::size_t>(body.size(), 300));
        trouble(
            fmt::format("the server refused the vehicle: HTTP {} {}", response.result_int(), body));
        co_return false;
    }
    if (ec) {
        trouble("the WebSocket handshake failed: " + ec.message());
        co_return false;
    }
    if (response[http::field::sec_websocket_protocol] != "vda5050.v2.json") {
        trouble("the server does not speak the subprotocol vda5050.v2.json");
        co_return false;
    }
    co_return true;
}

template <class Stream>
net::awaitable<void> LinkClient::Impl::write_loop(websocket::stream<Stream>& socket) {
    error_code ec;
    while (open && !stopping) {
        auto frame = vehicle.outbox().take();
        if (!frame) {
            co_await signal.wait(1h);
            continue;
        }
        socket.binary(frame->binary);
        co_await socket.async_write(net::buffer(frame->bytes), into(ec));
        if (ec) break;
    }
    if (!open) co_return;
    auto& lowest = beast::get_lowest_layer(socket);
    net::steady_timer limit(io, kCloseTime);
    limit.async_wait([&lowest](const error_code& cancelled) {
        if (!cancelled) lowest.cancel();
    });
    if (!ec) {
        const std::string goodbye = vehicle.offline_frame();
        socket.binary(false);
        co_await socket.async_write(net::buffer(goodbye), into(ec));
    }
    if (!ec) co_await socket.async_close(websocket::close_code::normal, into(ec));
    limit.cancel();
    lowest.cancel();  // ends the reader whatever became of the close
}

template <class Stream>
net::awaitable<void> LinkClient::Impl::session(websocket::stream<Stream>& socket) {
    if (!co_await handshake(socket)) co_return;
    const auto began = Vehicle::Steady::now();
    spdlog::info("{}: connected to {}:{}", name(), address.host, address.port);
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
    beast::flat_buffer buffer;
    error_code ec;
    for (;;) {
        co_await socket.async_read(buffer, into(ec));
        if (ec) break;
        if (socket.got_text()) {
            vehicle.receive({static_cast<const char*>(buffer.cdata().data()), buffer.size()});
        }
        buffer.clear();
    }
    open = false;
    beast::get_lowest_layer(socket).cancel();
    signal.set();
    while (writing) co_await written.wait(1h);
    vehicle.link_down();
    if (ec == websocket::error::closed && socket.reason().code == kReplaced) {
        was_replaced = true;
        spdlog::error(
            "{}: another session with this identity took over (close code {}); this one "
            "stays away. End the other program or start only one.",
            name(), kReplaced);
    } else if (!stopping) {
        const auto& reason = socket.reason();
        spdlog::warn("{}: the link ended: {} {}", name(), ec.message(),
                     std::string_view(reason.reason.data(), reason.reason.size()));
    }
    if (Vehicle::Steady::now() - began > kGoodSession) delay_s = kFirstDelay_s;
}

net::awaitable<void> LinkClient::Impl::connect() {
    error_code ec;
    tcp::resolver resolver(io);
    const auto found = co_await resolver.async_resolve(address.host, address.port, into(ec));
    if (ec) co_return trouble("cannot resolve " + address.host + ": " + ec.message());
    PlainStream stream(io);
    stream.expires_after(kConnectTime);
    co_await stream.async_connect(found, into(ec));
    if (ec) {
        co_return trouble("cannot connect to " + address.host + ":" + address.port + ": " +
                          ec.message());
    }
    stream.socket().set_option(tcp::no_delay(true), ec);
    if (!address.tls) {
        stream.expires_never();
        websocket::stream<PlainStream> socket(std::move(stream));
        co_await session(socket);
        co_return;
    }
    websocket::stream<TlsStream> socket(std::move(stream), tls);
    SSL_set_tlsext_host_name(socket.next_layer().native_handle(), address.host.c_str());
    if (verify_host) {
        socket.next_layer().set_verify_callback(ssl::host_name_verification(address.host));
    }
    co_await socket.next_layer().async_handshake(ssl::stream_base::client, into(ec));
    if (ec) {
        co_return trouble("the TLS handshake failed: " + ec.message() +
                          "; give --ca FILE for a private authority or --insecure for a test");
    }
    beast::get_lowest_layer(socket).expires_never();
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
