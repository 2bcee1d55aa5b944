#include "server/base/signal.hpp"
#include "server/sessions/sessions.hpp"

namespace pulseline::server {
namespace {

constexpr auto kPing = std::chrono::seconds(1);
constexpr auto kDead = std::chrono::seconds(25);  // of a socket; the fleet counts silence itself
constexpr auto kLinkCloseTime = std::chrono::seconds(1);

class VehicleLink : public VehicleSocket, public std::enable_shared_from_this<VehicleLink> {
public:
    VehicleLink(Context& c, ByteStream stream, plant::VehicleId vehicle)
        : context(c),
          id(std::move(vehicle)),
          socket(std::move(stream),
                 {.most_bytes = c.options.limits.vehicle_binary_bytes, .idle = kDead}),
          signal(c.io) {}

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
    WebSocket socket;
    Signal signal;
    std::deque<std::string> outbox;
    bool ended = false;
    std::uint16_t close_with = 0;
    const char* close_reason = "";
};

net::awaitable<void> write_loop(std::shared_ptr<VehicleLink> session) {
    while (!session->ended && session->close_with == 0) {
        if (session->outbox.empty()) {
            co_await session->signal.wait(std::chrono::hours(1));
            continue;
        }
        const std::string frame = std::move(session->outbox.front());
        session->outbox.pop_front();
        if (co_await session->socket.write(frame)) break;
    }
    if (session->close_with != 0 && !session->ended) {
        net::steady_timer timer(session->context.io, kLinkCloseTime);
        timer.async_wait([session](const error_code& failed) {
            if (!failed) session->socket.cancel();
        });
        co_await session->socket.close(session->close_with, session->close_reason);
        timer.cancel();
    }
    session->socket.close_now();
}

net::awaitable<void> ping_loop(std::shared_ptr<VehicleLink> session) {
    net::steady_timer timer(session->context.io);
    while (!session->ended && session->close_with == 0) {
        if (co_await session->socket.ping()) break;
        timer.expires_after(kPing);
        error_code ec;
        co_await timer.async_wait(into(ec));
        session->context.gateway.take_withheld(session->id, session.get());
    }
}

net::awaitable<void> read_loop(std::shared_ptr<VehicleLink> session) {
    auto& context = session->context;
    const Limits& limits = context.options.limits;
    while (session->close_with == 0) {
        if (co_await session->socket.read()) {
            session->ended = true;
            break;
        }
        const auto frame = session->socket.message();
        if (!session->socket.message_is_text()) {
            context.gateway.binary(session->id, session.get(), frame);
        } else if (frame.size() > limits.vehicle_text_bytes) {
            session->close(1009, "text messages are at most 64 KB");
        } else {
            context.gateway.text(session->id, session.get(), frame);
        }
        session->socket.drop_message();
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

net::awaitable<void> vehicle_session(Context& context, ByteStream stream, Upgrade upgrade,
                                     plant::VehicleId vehicle) {
    stream.lowest().rate_policy().read_limit(context.options.limits.link_bytes_per_second);
    auto session = std::make_shared<VehicleLink>(context, std::move(stream), vehicle);
    auto& socket = session->socket;
    const WebSocket::Headers headers{{"Sec-WebSocket-Protocol", "vda5050.v2.json"}};
    if (co_await socket.accept(upgrade, headers)) co_return;
    upgrade = {};  // a vehicle stays for days
    // A pong is a sign of life like any frame.
    socket.on_control([raw = session.get()](WebSocket::Control, std::string_view) {
        raw->context.gateway.heard(raw->id, raw);
    });
    struct Closer {
        VehicleLink& session;
        ~Closer() {
            session.socket.on_control({});
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

}  // namespace pulseline::server
