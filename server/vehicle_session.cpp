#include "server/sessions.hpp"
#include "server/signal.hpp"

namespace pulseline::server {
namespace {

constexpr auto kPing = std::chrono::seconds(1);
constexpr auto kDead = std::chrono::seconds(25);  // of a socket; the fleet counts silence itself
constexpr auto kCloseTime = std::chrono::seconds(1);

template <class Stream>
class Session : public VehicleSocket, public std::enable_shared_from_this<Session<Stream>> {
public:
    Session(Context& c, Stream stream, plant::VehicleId vehicle)
        : context(c), id(std::move(vehicle)), socket(std::move(stream)), signal(c.io) {}

    void send(std::string frame) override {
        if (outbox.size() >= context.options.limits.vehicle_outbox) {
            // Orders may not be dropped one by one: the vehicle comes back and gets the present.
            close(1013, "too slow, come back");
            return;
        }
        outbox.push_back(std::move(frame));
        signal.set();
    }
    void close(std::uint16_t code, const char* reason) override {
        if (close_with != 0) return;
        close_with = code;
        close_reason = reason;
        outbox.clear();
        signal.set();
    }

    Context& context;
    const plant::VehicleId id;
    websocket::stream<Stream> socket;
    Signal signal;
    std::deque<std::string> outbox;
    bool ended = false;
    std::uint16_t close_with = 0;
    const char* close_reason = "";
};

template <class Stream>
net::awaitable<void> write_loop(std::shared_ptr<Session<Stream>> session) {
    error_code ec;
    while (!session->ended && session->close_with == 0) {
        if (session->outbox.empty()) {
            co_await session->signal.wait(std::chrono::hours(1));
            continue;
        }
        const std::string frame = std::move(session->outbox.front());
        session->outbox.pop_front();
        co_await session->socket.async_write(net::buffer(frame), into(ec));
        if (ec) break;
    }
    auto& lowest = beast::get_lowest_layer(session->socket);
    if (session->close_with != 0 && !session->ended) {
        net::steady_timer timer(session->context.io, kCloseTime);
        timer.async_wait([session](const error_code& failed) {
            if (!failed) beast::get_lowest_layer(session->socket).cancel();
        });
        co_await session->socket.async_close(
            websocket::close_reason(static_cast<websocket::close_code>(session->close_with),
                                    session->close_reason),
            into(ec));
        timer.cancel();
    }
    lowest.close();
}

template <class Stream>
net::awaitable<void> ping_loop(std::shared_ptr<Session<Stream>> session) {
    net::steady_timer timer(session->context.io);
    while (!session->ended && session->close_with == 0) {
        error_code ec;
        co_await session->socket.async_ping({}, into(ec));
        if (ec) break;
        timer.expires_after(kPing);
        co_await timer.async_wait(into(ec));
        session->context.gateway.take_withheld(session->id, session.get());
    }
}

template <class Stream>
net::awaitable<void> read_loop(std::shared_ptr<Session<Stream>> session) {
    auto& context = session->context;
    const Limits& limits = context.options.limits;
    beast::flat_buffer buffer(limits.vehicle_binary_bytes + 4096);
    while (session->close_with == 0) {
        error_code ec;
        co_await session->socket.async_read(buffer, into(ec));
        if (ec) {
            session->ended = true;
            break;
        }
        const std::string_view frame(static_cast<const char*>(buffer.cdata().data()),
                                     buffer.size());
        if (!session->socket.got_text()) {
            context.gateway.binary(session->id, session.get(), frame);
        } else if (frame.size() > limits.vehicle_text_bytes) {
            session->close(1009, "text messages are at most 64 KB");
        } else {
            context.gateway.text(session->id, session.get(), frame);
        }
        buffer.clear();
        buffer.shrink_to_fit();  // between two messages a silent vehicle needs none
    }
    session->signal.set();  // the writer closes
}

void log_end(const std::exception_ptr& error) {
    try {
        if (error) std::rethrow_exception(error);
    } catch (const std::exception& e) {
        log::error("vehicle_session_threw", {{"what", e.what()}});
    }
}

}  // namespace

template <class Stream>
net::awaitable<void> vehicle_session(Context& context, Stream stream, Upgrade upgrade,
                                     plant::VehicleId vehicle) {
    error_code ec;
    beast::get_lowest_layer(stream).expires_never();
    beast::get_lowest_layer(stream).rate_policy().read_limit(
        context.options.limits.link_bytes_per_second);
    auto session = std::make_shared<Session<Stream>>(context, std::move(stream), vehicle);
    auto& socket = session->socket;
    socket.set_option(websocket::stream_base::timeout{std::chrono::seconds(10), kDead, false});
    socket.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
        response.erase(http::field::server);
        response.set(http::field::sec_websocket_protocol, "vda5050.v2.json");
    }));
    socket.read_message_max(context.options.limits.vehicle_binary_bytes);
    socket.auto_fragment(false);
    socket.text(true);
    co_await socket.async_accept(upgrade, into(ec));
    if (ec) co_return;
    upgrade = {};  // a vehicle stays for days
    // A pong is a sign of life like any frame.
    socket.control_callback([raw = session.get()](websocket::frame_type, beast::string_view) {
        raw->context.gateway.heard(raw->id, raw);
    });
    struct Closer {
        Session<Stream>& session;
        ~Closer() {
            session.socket.control_callback();
            session.context.gateway.closed(session.id, &session);
        }
    };
    context.gateway.opened(vehicle, session);
    const Closer closer{*session};
    const StopList::Entry stop(context.stops, [session] { session->close(1001, "server stops"); });
    net::co_spawn(context.io, write_loop(session), log_end);
    net::co_spawn(context.io, ping_loop(session), log_end);
    co_await read_loop(session);
}

template net::awaitable<void> vehicle_session(Context&, PlainStream, Upgrade, plant::VehicleId);
template net::awaitable<void> vehicle_session(Context&, TlsStream, Upgrade, plant::VehicleId);

}  // namespace pulseline::server
