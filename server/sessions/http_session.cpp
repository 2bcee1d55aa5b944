#include <linux/sockios.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "api/http/wire/problem.hpp"
#include "server/sessions/dispatch.hpp"
#include "server/sessions/request_reader.hpp"
#include "server/sessions/sessions.hpp"

namespace pulseline::server {
namespace {

using Steady = std::chrono::steady_clock;

// A body may begin this much later than its head.
constexpr auto kBodyStart = std::chrono::seconds(2);

constexpr std::size_t kMostPathLogged = 256;

/// How the reading of a request's head ended.
struct Incoming {
    error_code ec;
    bool nothing = false;  // ended between two requests
    Steady::time_point begin;
};

/// Bytes that the other side has not taken yet.
int unread(ByteStream& stream) {
    int bytes = 0;
    ::ioctl(stream.lowest().socket().native_handle(), SIOCOUTQ, &bytes);
    return bytes;
}

/// Abruptly: close() throws away what the other side has not read. Who reads slowly is then cut and
/// not served by the kernel for as long as it likes.
void end_abruptly(ByteStream& stream, bool abruptly) {
    error_code ec;
    stream.lowest().socket().set_option(net::socket_base::linger(abruptly, 0), ec);
}

net::awaitable<Incoming> read_head(Context& context, ByteStream& stream, beast::flat_buffer& buffer,
                                   Parser& parser, bool first) {
    const Limits& limits = context.options.limits;
    auto& socket = stream.lowest();
    Incoming in;
    in.begin = Steady::now();
    if (buffer.size() == 0) {
        // Between requests a client may wait longer than within one, but not to read an answer.
        auto wait = limits.keep_alive;
        if (first) wait = limits.header_time;
        const bool behind = !first && unread(stream) > 0;
        if (behind) wait = std::min(wait, limits.write_time);
        end_abruptly(stream, behind);
        socket.expires_after(wait);
        bool ended = false;
        StopList::Entry stop(context.stops, [&] {
            ended = true;
            socket.cancel();
        });
        const auto n = co_await stream.async_read_some(buffer.prepare(4096), into(in.ec));
        buffer.commit(n);
        if (in.ec || ended) {
            in.nothing = true;
            co_return in;
        }
        if (!first) in.begin = Steady::now();
    }
    end_abruptly(stream, true);
    // One deadline for all of it: each byte may come late, not every byte.
    socket.expires_at(in.begin + limits.header_time);
    co_await http::async_read_header(stream, buffer, parser, into(in.ec));
    co_return in;
}

/// What the head alone decides about the body that follows it.
struct BodyRule {
    std::optional<api::Response> refusal;  // nothing of the body is read
    std::size_t most_bytes = 0;
    Quota::Slot slot;  // held while the body is in memory
};

/// A stranger may send what a sign-in needs; who may ask a question that holds images gets room for
/// them. Whoever would be refused is refused before anything of the body is kept.
BodyRule body_rule(Context& context, api::Request request, const Parser& parser) {
    const Limits& limits = context.options.limits;
    BodyRule rule;
    request.identity = context.access.identify(request.headers, context.clock.now());
    const auto known = api::match(request);
    if (known.route || request.path.rfind("/api/", 0) == 0) {
        auto admitted = api::admit(request, context.policy);
        rule.refusal = std::move(admitted.refusal);
    }
    const bool stranger = request.identity.kind == access::Identity::Kind::kAnonymous;
    rule.most_bytes = stranger ? limits.stranger_body_bytes : limits.body_bytes;
    if (!stranger && known.route) {
        rule.most_bytes = std::max(rule.most_bytes, known.route->body_bytes);
    }
    const auto length = parser.content_length();
    if (!rule.refusal && length.value_or(0) > rule.most_bytes) {
        rule.refusal = api::too_large(request, rule.most_bytes);
    }
    if (rule.refusal || stranger) return rule;
    rule.slot = context.bodies.take(request.identity.name,
                                    length ? static_cast<std::size_t>(*length) : rule.most_bytes);
    if (!rule.slot) rule.refusal = api::problem(not_run(Lane::Taken::kShareIsUsed), request);
    return rule;
}

/// Reads the body, which must come in time and at a rate that is no siege.
net::awaitable<error_code> read_body(Context& context, ByteStream& stream,
                                     beast::flat_buffer& buffer, Parser& parser,
                                     Steady::time_point begin) {
    const Limits& limits = context.options.limits;
    auto& socket = stream.lowest();
    error_code ec;
    if (beast::iequals(parser.get()[http::field::expect], "100-continue")) {
        static constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
        co_await net::async_write(stream, net::buffer(kContinue), into(ec));
        if (ec) co_return ec;
    }
    const auto body_begin = Steady::now();
    std::size_t read = 0;
    while (!ec && !parser.is_done()) {
        const auto paid = std::chrono::milliseconds(1000 * read / limits.body_bytes_per_second);
        socket.expires_at(std::min(begin + limits.request_time, body_begin + kBodyStart + paid));
        read += co_await http::async_read_some(stream, buffer, parser, into(ec));
    }
    co_return ec;
}

/// Ends the connection. With `linger` what the client still sends is read and dropped: a close with
/// unread bytes would reset the connection and take our last answer with it.
net::awaitable<void> close_gently(ByteStream& stream, bool linger) {
    auto& socket = stream.lowest();
    error_code ec;
    end_abruptly(stream, false);
    socket.expires_after(std::chrono::seconds(1));
    if (stream.is_tls()) co_await stream.say_goodbye();
    socket.socket().shutdown(tcp::socket::shutdown_send, ec);
    std::array<char, 8192> sink{};
    std::size_t total = 0;
    socket.expires_after(std::chrono::seconds(2));
    while (linger && !ec && total < (1U << 20U)) {
        total += co_await socket.async_read_some(net::buffer(sink), into(ec));
    }
    socket.socket().close(ec);
}

/// Maker and serial number; with one name behind it /vehicles/ is a page of the dashboard.
bool is_vehicle_path(const std::string& path) {
    constexpr std::string_view kPrefix = "/vehicles/";
    return path.rfind(kPrefix, 0) == 0 && path.find('/', kPrefix.size()) != std::string::npos;
}

void note(Context& context, const api::Request& request, const char* route, int status,
          Steady::time_point start) {
    const double took = std::chrono::duration<double>(Steady::now() - start).count();
    context.metrics.request(route, status, took);
    if (request.path == "/healthz" || request.path == "/readyz" || request.path == "/metrics")
        return;
    log::info("request", {{"request", request.request_id},
                          {"method", request.method},
                          {"path", request.path.substr(0, kMostPathLogged)},
                          {"status", std::to_string(status)},
                          {"ms", std::to_string(static_cast<int>(took * 1000))},
                          {"peer", request.peer},
                          {"actor", request.identity.name}});
}

struct Answer {
    api::Response response;
    const Asset* asset = nullptr;
    const char* route = "static";
    const api::Route* socket = nullptr;  // the connection becomes a stream
};

net::awaitable<Answer> answer(Context& context, api::Request& request) {
    Answer out;
    request.identity = context.access.identify(request.headers, context.clock.now());
    const auto known = api::match(request);
    if (!known.route && known.allowed.empty() && request.path.rfind("/api/", 0) != 0 &&
        !is_vehicle_path(request.path)) {
        if (request.method != "GET" && request.method != "HEAD") {
            out.response = api::problem(405,
                                        Error{Errc::kInvalid,
                                              {"method_not_allowed", {}},
                                              "Files can only be read; use GET or HEAD.",
                                              {}},
                                        request);
            out.response.headers.emplace_back("Allow", "GET, HEAD");
        } else if (!(out.asset = find_asset(request.path))) {
            out.response = api::problem(404,
                                        Error{Errc::kNotFound,
                                              {"not_found", {}},
                                              "There is no such file; the page is at /.",
                                              {}},
                                        request);
        }
        co_return out;
    }
    auto admitted = api::admit(request, context.policy);
    if (admitted.route) out.route = admitted.route->pattern;
    if (admitted.refusal) {
        out.response = std::move(*admitted.refusal);
        if (!admitted.route) out.route = "unknown";
        co_return out;
    }
    if (std::holds_alternative<api::Socket>(admitted.route->handler)) {
        out.socket = admitted.route;
        co_return out;
    }
    out.response = co_await dispatch(context, *admitted.route, request);
    co_return out;
}

api::Response upgrade_required(const api::Request& request) {
    auto response = api::problem(426,
                                 Error{Errc::kInvalid,
                                       {"upgrade_required", {}},
                                       "This address speaks WebSocket only; connect with a "
                                       "WebSocket client.",
                                       {}},
                                 request);
    response.headers.emplace_back("Upgrade", "websocket");
    return response;
}

/// A request of which no more is known than that it cannot be answered.
api::Request unreadable(const Upgrade& message, const std::string& peer, bool tls) {
    api::Request partial;
    partial.peer = peer;
    partial.secure = tls;
    partial.method = message.method() == http::verb::head ? "HEAD" : "GET";
    partial.request_id = request_id(message["X-Request-Id"]);
    return partial;
}

/// The request without its body, or the answer to what is no request.
tl::expected<api::Request, api::Response> understand(Context& context, const Upgrade& message,
                                                     const std::string& peer, bool tls) {
    auto read = to_request(context.options.limits, context.proxies, message, peer, tls);
    if (read) return std::move(*read);
    const auto partial = unreadable(message, peer, tls);
    return tl::unexpected<api::Response>(
        api::bad_request(partial, read.error().reason.code, read.error().what));
}

}  // namespace

net::awaitable<Next> http_session(Context& context, ByteStream stream, std::string peer) {
    const Limits& limits = context.options.limits;
    const bool tls = stream.is_tls();
    error_code ignored;
    stream.lowest().socket().set_option(
        net::socket_base::send_buffer_size(limits.send_buffer_bytes), ignored);
    beast::flat_buffer buffer(limits.header_bytes + 64 * 1024);
    bool keep = true;
    bool linger = false;
    for (int count = 0; keep && count < limits.requests_per_connection; ++count) {
        Parser parser;
        parser.header_limit(static_cast<std::uint32_t>(limits.header_bytes));
        // body_rule() knows once it is known who asks for what. Not none: Beast 1.74 takes any
        // length for more than none.
        parser.body_limit(std::numeric_limits<std::uint64_t>::max());
        auto in = co_await read_head(context, stream, buffer, parser, count == 0);
        if (in.nothing) break;
        const unsigned version = parser.get().version() >= 11 ? 11 : 10;
        // What is refused here may have a body behind it that nobody reads: the connection ends.
        std::optional<api::Response> refusal;
        std::optional<api::Request> understood;
        BodyRule rule;
        if (!in.ec) {
            auto read = understand(context, parser.get(), peer, tls);
            if (read) {
                understood = std::move(*read);
            } else {
                refusal = std::move(read.error());
            }
        }
        if (understood && !parser.is_done()) {
            rule = body_rule(context, *understood, parser);
            refusal = std::move(rule.refusal);
            if (!refusal) {
                parser.body_limit(rule.most_bytes);
                in.ec = co_await read_body(context, stream, buffer, parser, in.begin);
            }
        }
        const auto start = Steady::now();
        if (in.ec) {
            refusal = answer_to(in.ec, unreadable(parser.get(), peer, tls), rule.most_bytes);
            if (!refusal) break;
        }
        if (refusal) {
            linger = true;
            const auto partial = understood ? *understood : unreadable(parser.get(), peer, tls);
            note(context, partial, "unreadable", refusal->status, start);
            co_await write_response(context, stream, partial, *refusal, version, false);
            break;
        }
        const bool upgrade = websocket::is_upgrade(parser.get());
        keep = parser.get().keep_alive() && !context.stops.stopping() &&
               count + 1 < limits.requests_per_connection;
        auto message = parser.release();
        auto request = std::move(*understood);
        request.body = std::move(message.body());

        if (is_vehicle_path(request.path)) {
            const auto admitted = co_await context.gateway.admit(request, upgrade);
            note(context, request, "/vehicles/{manufacturer}/{serialNumber}",
                 admitted ? 101 : admitted.error().status, start);
            if (admitted) {
                end_abruptly(stream, false);
                co_return vehicle_session(context, std::move(stream), std::move(message),
                                          *admitted);
            }
            keep =
                co_await write_response(context, stream, request, admitted.error(), version, keep);
            continue;
        }
        auto out = co_await answer(context, request);
        if (out.socket) {
            const bool events =
                std::get<api::Socket>(out.socket->handler) == api::Socket::kEventStream;
            if (events) {
                note(context, request, out.route, 200, start);
                co_await event_session(context, stream, std::move(request), version);
                break;
            }
            if (upgrade) {
                note(context, request, out.route, 101, start);
                end_abruptly(stream, false);
                co_return stream_session(context, std::move(stream), std::move(message),
                                         std::move(request));
            }
            out.response = upgrade_required(request);
        }
        note(context, request, out.route, out.asset ? 200 : out.response.status, start);
        keep = co_await write_response(context, stream, request, out.response, version, keep,
                                       out.asset);
    }
    co_await close_gently(stream, linger);
    co_return std::nullopt;
}

}  // namespace pulseline::server
