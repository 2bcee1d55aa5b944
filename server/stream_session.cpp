#include "server/sessions.hpp"
#include "server/signal.hpp"

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

template <class Stream>
struct Session {
    Session(Context& c, Stream s, access::Identity who)
        : context(c), socket(std::move(s)), identity(std::move(who)), signal(c.io) {}
    ~Session() { context.hub.remove(client); }

    Context& context;
    websocket::stream<Stream> socket;
    access::Identity identity;
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

template <class Stream>
net::awaitable<void> close_socket(std::shared_ptr<Session<Stream>> session) {
    // A reader that never reads would never answer either.
    net::steady_timer timer(session->context.io, kCloseTime);
    timer.async_wait([session](const error_code& ec) {
        if (!ec) beast::get_lowest_layer(session->socket).cancel();
    });
    error_code ec;
    co_await session->socket.async_close(
        websocket::close_reason(static_cast<websocket::close_code>(session->close_with),
                                session->close_reason),
        into(ec));
    timer.cancel();
    beast::get_lowest_layer(session->socket).close();
}

/// The next piece of the frame that is being written, and a ping behind it when one is due.
template <class Stream>
net::awaitable<error_code> write_piece(std::shared_ptr<Session<Stream>> session) {
    auto& [frame, at] = session->writing;
    Pace& pace = session->pace;
    error_code ec;
    const std::size_t bytes = std::min(pace.piece_bytes(), frame->size() - at);
    const bool is_last = at + bytes == frame->size();
    co_await session->socket.async_write_some(is_last, net::buffer(frame->data() + at, bytes),
                                              into(ec));
    at += bytes;
    if (is_last) session->writing = {};
    if (!ec && pace.must_ask(Pace::Clock::now())) {
        pace.asked(Pace::Clock::now());
        co_await session->socket.async_ping(Pace::kMark, into(ec));
    }
    co_return ec;
}

template <class Stream>
net::awaitable<void> write_loop(std::shared_ptr<Session<Stream>> session) {
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
    beast::get_lowest_layer(session->socket).cancel();
}

/// Dashboards have nothing to say; what they send is only counted.
template <class Stream>
net::awaitable<void> read_loop(std::shared_ptr<Session<Stream>> session) {
    const auto& limits = session->context.options.limits;
    beast::flat_buffer buffer(limits.stream_message_bytes + 1024);
    auto window = std::chrono::steady_clock::now();
    int count = 0;
    for (;;) {
        error_code ec;
        co_await session->socket.async_read(buffer, into(ec));
        if (ec) break;
        buffer.clear();
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
template <class Stream>
net::awaitable<std::shared_ptr<Session<Stream>>> accept(Context& context, Stream stream,
                                                        Upgrade upgrade, api::Request request) {
    error_code ec;
    // Old poses in a long kernel queue would look new.
    beast::get_lowest_layer(stream).socket().set_option(net::socket_base::send_buffer_size(65536),
                                                        ec);
    beast::get_lowest_layer(stream).expires_never();  // the WebSocket keeps its own time
    beast::get_lowest_layer(stream).rate_policy().read_limit(
        context.options.limits.stream_bytes_per_second);
    auto session =
        std::make_shared<Session<Stream>>(context, std::move(stream), std::move(request.identity));
    auto& socket = session->socket;
    socket.set_option(websocket::stream_base::timeout{std::chrono::seconds(10),
                                                      context.options.limits.stream_dead, true});
    socket.set_option(websocket::stream_base::decorator(
        [id = std::move(request.request_id)](websocket::response_type& response) {
            response.erase(http::field::server);
            response.set("X-Request-Id", id);
        }));
    socket.read_message_max(context.options.limits.stream_message_bytes);
    socket.auto_fragment(false);
    socket.text(true);
    socket.control_callback(
        [raw = session.get()](websocket::frame_type kind, beast::string_view payload) {
            if (kind != websocket::frame_type::pong || payload != Pace::kMark) return;
            raw->pace.answered(Pace::Clock::now());
            raw->signal.set();
        });
    co_await socket.async_accept(upgrade, into(ec));
    if (ec) co_return nullptr;
    co_return session;
}

}  // namespace

template <class Stream>
net::awaitable<void> stream_session(Context& context, Stream stream, Upgrade upgrade,
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

template net::awaitable<void> stream_session(Context&, PlainStream, Upgrade, api::Request);
template net::awaitable<void> stream_session(Context&, TlsStream, Upgrade, api::Request);

}  // namespace pulseline::server
