#include "api/http/wire/problem.hpp"
#include "api/http/wire/query.hpp"
#include "server/sessions/sessions.hpp"

namespace pulseline::server {
namespace {

constexpr int kPage = 500;
constexpr auto kHeartbeat = std::chrono::seconds(10);

/// Where to start: behind Last-Event-ID, else behind `after`, else now.
Result<std::int64_t> start_behind(const api::Request& request, std::int64_t newest) {
    const auto named = api::read_event_start(request);
    if (!named) return fail(named.error());
    const std::int64_t seq = named->value_or(newest);
    if (seq > newest) {
        return fail(Errc::kInvalid, "event_unknown",
                    "That is newer than the newest event; leave it out to start from now.",
                    request.header("last-event-id").empty() ? "?after" : "Last-Event-ID",
                    {{"newest", newest}});
    }
    return seq;
}

/// Events behind `seq`, ready to send: from memory, else one page of the history.
net::awaitable<Result<std::string>> read_behind(Context& context, const api::Request& request,
                                                std::int64_t& seq) {
    std::string text;
    for (int i = 0; i < kPage; ++i) {
        const auto frame = context.hub.event(seq + 1);
        if (!frame) break;
        text += *frame;
        ++seq;
    }
    if (!text.empty() || seq >= context.hub.last_event_seq()) co_return text;
    const std::function<std::vector<fleet::Event>()> job = [&context, seq] {
        return context.history.events_after(seq, kPage);
    };
    const auto page = co_await on<std::vector<fleet::Event>>(context.lists, context.io, job,
                                                             request.identity.name);
    if (!page) co_return fail(page.error());
    if (!page->empty() && page->front().seq > seq + 1) {
        // Those in between are kept no longer.
        text += events::sse_reset(seq + 1, page->front().seq);
        seq = page->front().seq - 1;
    }
    for (const auto& event : *page) {
        if (event.seq != seq + 1) {
            co_return fail(Errc::kUnavailable, "event_gap", "The event sequence has a gap.");
        }
        text += events::sse(event);
        seq = event.seq;
    }
    co_return text;
}

net::awaitable<bool> send_text(Context& context, ByteStream& stream, unsigned version,
                               const std::string& text) {
    error_code ec;
    stream.lowest().expires_after(context.options.limits.write_time);
    if (version >= 11) {
        co_await net::async_write(stream, http::make_chunk(net::buffer(text)), into(ec));
    } else {
        co_await net::async_write(stream, net::buffer(text), into(ec));  // to the connection's end
    }
    co_return !ec;
}

net::awaitable<bool> send_head(Context& context, ByteStream& stream, const api::Request& request,
                               unsigned version) {
    http::response<http::empty_body> head;
    head.version(version);
    head.result(http::status::ok);
    add_security_headers(head, request.secure);
    head.set("X-Request-Id", request.request_id);
    head.set("X-Accel-Buffering", "no");  // a proxy that gathers would hold events back
    head.set(http::field::content_type, "text/event-stream");
    head.set(http::field::cache_control, "no-store");
    if (version >= 11) head.chunked(true);
    head.keep_alive(false);
    http::response_serializer<http::empty_body> serializer(head);
    error_code ec;
    stream.lowest().expires_after(context.options.limits.write_time);
    co_await http::async_write_header(stream, serializer, into(ec));
    co_return !ec;
}

/// Waits for the next event; false when none came before the heartbeat is due.
net::awaitable<bool> wait(Context& context, bool& stopped) {
    net::steady_timer timer(context.io, kHeartbeat);
    bool woken = false;
    const auto waiter = context.hub.wait_for_event([&] {
        woken = true;
        timer.cancel();
    });
    StopList::Entry stop(context.stops, [&] {
        stopped = true;
        timer.cancel();
    });
    error_code ec;
    co_await timer.async_wait(into(ec));
    context.hub.forget(waiter);
    co_return woken;
}

struct Counted {
    explicit Counted(std::atomic<std::int64_t>& count) : count_(count) { ++count_; }
    ~Counted() { --count_; }
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;
    std::atomic<std::int64_t>& count_;
};

}  // namespace

net::awaitable<void> event_session(Context& context, ByteStream& stream, api::Request request,
                                   unsigned version) {
    const auto slot = context.streams.take(request.identity.name);
    auto start = start_behind(request, context.hub.last_event_seq());
    if (!slot) {
        start = fail(Errc::kUnavailable, "too_many_streams",
                     "This account has too many open streams; close some.");
    }
    if (!start) {
        const auto response = slot ? api::problem(400, start.error(), request)
                                   : api::problem(429, start.error(), request);
        co_await write_response(context, stream, request, response, version, false);
        co_return;
    }
    const Counted counted(context.metrics.event_clients);
    std::int64_t seq = *start;
    bool open = co_await send_head(context, stream, request, version);
    if (request.method == "HEAD") co_return;
    bool stopped = context.stops.stopping();
    // The first comment tells a client at once that it is through.
    if (open) open = co_await send_text(context, stream, version, events::sse_keep_alive());
    while (open && !stopped && !context.stops.stopping()) {
        if (!context.access.still_valid(request.identity, context.clock.now())) break;
        const auto text = co_await read_behind(context, request, seq);
        if (!text) {
            log::error("event_stream_failed",
                       {{"request", request.request_id}, {"what", text.error().what}});
            break;  // the client comes back with Last-Event-ID
        }
        if (!text->empty()) {
            open = co_await send_text(context, stream, version, *text);
        } else if (!co_await wait(context, stopped) && !stopped) {
            open = co_await send_text(context, stream, version, events::sse_keep_alive());
        }
    }
    if (open && version >= 11) {
        error_code ec;
        co_await net::async_write(stream, http::make_chunk_last(), into(ec));
    }
}

}  // namespace pulseline::server
