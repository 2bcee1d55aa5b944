#include "server/base/signal.hpp"
#include "server/sessions/sessions.hpp"

namespace pulseline::server {
namespace {

constexpr auto kRecheck = std::chrono::seconds(10);  // is the session behind it still good
constexpr auto kCloseTime = std::chrono::seconds(3);

/// How far a reader is behind, by pings that it answers when it comes to them. What lies in queues
/// between here and there cannot be made newer, so little is let into them where reading is slow:
/// the rest waits in StreamClient, where only the newest is kept.
class Pace {
public:
    using Clock = std::chrono::steady_clock;
    static constexpr const char* kMark = "pace";

    /// Whether more may be written now.
    bool may_write(Clock::time_point now) const {
        return !waiting_ || (!slow_ && now - asked_ < kSlow);
    }
    /// Bytes to write at once; what is longer goes in pieces, so that a ping comes between.
    std::size_t piece_bytes() const { return slow_ ? 8U << 10U : 256U << 10U; }
    /// Whether a ping is to follow what was written now.
    bool must_ask(Clock::time_point now) const {
        return !waiting_ && (slow_ || now - asked_ >= kAskEvery);
    }
    void asked(Clock::time_point now) {
        waiting_ = true;
        asked_ = now;
    }
    void answered(Clock::time_point now) {
        waiting_ = false;
        slow_ = now - asked_ >= kSlow;
    }

private:
    static constexpr auto kSlow = std::chrono::seconds(1);
    static constexpr auto kAskEvery = std::chrono::seconds(1);  // of a fast one: a ping is a write
    bool waiting_ = false;                                      // a ping has no answer yet
    bool slow_ = true;  // until the first answer says otherwise
    Clock::time_point asked_{};
};

struct Stream {
    Stream(Context& c, ByteStream s, api::access::Identity who)
        : context(c),
          socket(std::move(s), {.most_bytes = c.options.limits.stream_message_bytes,
                                .idle = c.options.limits.stream_dead,
                                .pings = true}),
          identity(std::move(who)),
          signal(c.io) {}
    ~Stream() { context.hub.remove(client); }

    Context& context;
    WebSocket socket;
    api::access::Identity identity;
    StreamClient client;
    Signal signal;
    Pace pace;
    struct {
        Frame frame;
        std::size_t at = 0;
    } writing;
    bool ended = false;            // the reader saw the end
    std::uint16_t close_with = 0;  // asks the writer to close
    const char* close_reason = "";

    void close(std::uint16_t code, const char* reason) {
        if (close_with == 0) {
            close_with = code;
            close_reason = reason;
        }
        signal.set();
    }
};

net::awaitable<void> close_socket(std::shared_ptr<Stream> session) {
    // A reader that never reads would never answer either.
    net::steady_timer timer(session->context.io, kCloseTime);
    timer.async_wait([session](const error_code& ec) {
        if (!ec) session->socket.cancel();
    });
    co_await session->socket.close(session->close_with, session->close_reason);
    timer.cancel();
    session->socket.close_now();
}

/// The next piece of the frame that is being written, and a ping behind it when one is due.
net::awaitable<error_code> write_piece(std::shared_ptr<Stream> session) {
    auto& [frame, at] = session->writing;
    Pace& pace = session->pace;
    const std::size_t bytes = std::min(pace.piece_bytes(), frame->size() - at);
    const bool is_last = at + bytes == frame->size();
    error_code ec = co_await session->socket.write_piece({frame->data() + at, bytes}, is_last);
    at += bytes;
    if (is_last) session->writing = {};
    if (!ec && pace.must_ask(Pace::Clock::now())) {
        pace.asked(Pace::Clock::now());
        ec = co_await session->socket.ping(Pace::kMark);
    }
    co_return ec;
}

net::awaitable<void> write_loop(std::shared_ptr<Stream> session) {
    auto& context = session->context;
    while (!session->ended) {
        if (session->client.overflowed) session->close(1013, "too slow, come back");
        if (session->client.refused) session->close(1013, "not ready, come back");
        if (session->close_with == 0 &&
            !context.access.still_valid(session->identity, context.clock.now())) {
            session->close(4401, "signed out");
        }
        if (session->close_with != 0) {
            co_await close_socket(session);
            break;
        }
        const bool may_write = session->pace.may_write(Pace::Clock::now());
        Frame& frame = session->writing.frame;
        if (may_write && !frame) frame = context.hub.next(session->client);
        if (!may_write || !frame) {
            co_await session->signal.wait(kRecheck);
            continue;
        }
        if (co_await write_piece(session)) break;
    }
    context.hub.remove(session->client);
    session->client.subscribed = false;
    session->socket.cancel();
}

/// Dashboards have nothing to say; what they send is only counted.
net::awaitable<void> read_loop(std::shared_ptr<Stream> session) {
    const auto& limits = session->context.options.limits;
    auto window = std::chrono::steady_clock::now();
    int count = 0;
    for (;;) {
        if (co_await session->socket.read()) break;
        const auto now = std::chrono::steady_clock::now();
        if (now - window >= std::chrono::seconds(1)) {
            window = now;
            count = 0;
        }
        if (++count > limits.stream_messages_per_second) session->close(1008, "too many messages");
    }
    session->ended = true;
    session->signal.set();
}

void rethrow(const std::exception_ptr& error) {
    try {
        if (error) std::rethrow_exception(error);
    } catch (const std::exception& e) {
        log::error("stream_session_threw", {{"what", e.what()}});
    }
}

/// The WebSocket, or none when the other side did not see it through. What only the greeting needs
/// ends with it: a dashboard stays for days.
net::awaitable<std::shared_ptr<Stream>> accept(Context& context, ByteStream stream, Upgrade upgrade,
                                               api::Request request) {
    error_code ec;
    // Old poses in a long kernel queue would look new.
    stream.lowest().socket().set_option(net::socket_base::send_buffer_size(65536), ec);
    stream.lowest().rate_policy().read_limit(context.options.limits.stream_bytes_per_second);
    auto session =
        std::make_shared<Stream>(context, std::move(stream), std::move(request.identity));
    auto& socket = session->socket;
    socket.on_control([raw = session.get()](WebSocket::Control kind, std::string_view payload) {
        if (kind != WebSocket::Control::kPong || payload != Pace::kMark) return;
        raw->pace.answered(Pace::Clock::now());
        raw->signal.set();
    });
    const WebSocket::Headers headers{{"X-Request-Id", request.request_id}};
    if (co_await socket.accept(upgrade, headers)) co_return nullptr;
    co_return session;
}

}  // namespace

net::awaitable<void> stream_session(Context& context, ByteStream stream, Upgrade upgrade,
                                    api::Request request) {
    const auto slot = context.streams.take(request.identity.name);
    const auto session =
        co_await accept(context, std::move(stream), std::move(upgrade), std::move(request));
    if (!session) co_return;
    if (!slot) session->close(1013, "too many open streams of this account");

    session->client.wake = [raw = session.get()] { raw->signal.set(); };
    context.hub.add(session->client);
    const StopList::Entry stop(context.stops, [session] { session->close(1001, "server stops"); });
    context.hub.subscribe(session->client);
    net::co_spawn(context.io, read_loop(session), rethrow);
    co_await write_loop(session);
}

}  // namespace pulseline::server
