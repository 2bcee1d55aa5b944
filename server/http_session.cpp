#include <chrono>
#include <limits>

#include "api/http/problem.hpp"
#include "server/dispatch.hpp"
#include "server/request_reader.hpp"
#include "server/sessions.hpp"

namespace pulseline::server {
namespace {

using Steady = std::chrono::steady_clock;

template <class Stream>
constexpr bool kIsTls = std::is_same_v<Stream, TlsStream>;

/// What was read, or how the reading ended.
struct Incoming {
    error_code ec;
    bool nothing = false;  // ended between two requests
    std::size_t body_limit = 0;
};

/// A stranger gets no more than the usual; who may ask a question that holds images gets room for
/// them.
std::size_t body_limit(Context& context, const Upgrade& header) {
    const std::size_t usual = context.options.limits.body_bytes;
    auto request = to_request(context, header, {}, false);
    if (!request) return usual;
    const auto known = api::match(*request);
    if (!known.route || known.route->body_bytes <= usual) return usual;
    request->identity = context.access.identify(request->headers, context.clock.now());
    return api::admit(*request, context.policy).refusal ? usual : known.route->body_bytes;
}

template <class Stream>
net::awaitable<Incoming> read_request(Context& context, Stream& stream, beast::flat_buffer& buffer,
                                      Parser& parser, bool first) {
    const Limits& limits = context.options.limits;
    auto& socket = beast::get_lowest_layer(stream);
    Incoming in;
    if (buffer.size() == 0) {
        // Between requests a client may wait longer than within one.
        socket.expires_after(first ? limits.header_time : limits.keep_alive);
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
    }
    socket.expires_after(limits.header_time);
    co_await http::async_read_header(stream, buffer, parser, into(in.ec));
    if (in.ec || parser.is_done()) co_return in;
    in.body_limit = body_limit(context, parser.get());
    parser.body_limit(in.body_limit);
    if (parser.content_length().value_or(0) > in.body_limit) {
        in.ec = http::error::body_limit;
        co_return in;
    }
    if (beast::iequals(parser.get()[http::field::expect], "100-continue")) {
        static constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
        co_await net::async_write(stream, net::buffer(kContinue), into(in.ec));
        if (in.ec) co_return in;
    }
    socket.expires_after(limits.body_time);
    co_await http::async_read(stream, buffer, parser, into(in.ec));
    co_return in;
}

/// Ends the connection. With `linger` what the client still sends is read and dropped: a close with
/// unread bytes would reset the connection and take our last answer with it.
template <class Stream>
net::awaitable<void> close_gently(Stream& stream, bool linger) {
    auto& socket = beast::get_lowest_layer(stream);
    error_code ec;
    socket.expires_after(std::chrono::seconds(1));
    if constexpr (kIsTls<Stream>) co_await stream.async_shutdown(into(ec));
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
                          {"path", request.path},
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

}  // namespace

template <class Stream>
net::awaitable<void> http_session(Context& context, Stream stream, std::string peer) {
    const Limits& limits = context.options.limits;
    beast::flat_buffer buffer(limits.header_bytes + 64 * 1024);
    bool keep = true;
    bool linger = false;
    for (int count = 0; keep && count < limits.requests_per_connection; ++count) {
        Parser parser;
        parser.header_limit(static_cast<std::uint32_t>(limits.header_bytes));
        // read_request sets it once it knows who asks for what. Not none: Beast 1.74 takes any
        // length for more than none.
        parser.body_limit(std::numeric_limits<std::uint64_t>::max());
        const auto in = co_await read_request(context, stream, buffer, parser, count == 0);
        if (in.nothing) break;
        const auto start = Steady::now();
        const unsigned version = parser.get().version() >= 11 ? 11 : 10;
        if (in.ec) {
            api::Request partial;
            partial.peer = peer;
            partial.secure = kIsTls<Stream>;
            partial.method = "GET";
            partial.request_id = request_id(parser.get()["X-Request-Id"]);
            const auto response = answer_to(in.ec, partial, in.body_limit);
            if (response) {
                linger = true;
                note(context, partial, "unreadable", response->status, start);
                co_await write_response(context, stream, partial, *response, 11, false);
            }
            break;
        }
        const bool upgrade = websocket::is_upgrade(parser.get());
        keep = parser.get().keep_alive() && !context.stops.stopping() &&
               count + 1 < limits.requests_per_connection;
        auto message = parser.release();
        auto read = to_request(context, message, peer, kIsTls<Stream>);
        if (!read) {
            api::Request partial;
            partial.method = "GET";
            partial.peer = peer;
            partial.secure = kIsTls<Stream>;
            partial.request_id = request_id(message["X-Request-Id"]);
            const auto response =
                api::bad_request(partial, read.error().reason.code, read.error().what);
            linger = true;
            note(context, partial, "unreadable", response.status, start);
            co_await write_response(context, stream, partial, response, version, false);
            break;
        }
        auto request = std::move(*read);
        request.body = std::move(message.body());

        if (is_vehicle_path(request.path)) {
            const auto admitted = co_await context.gateway.admit(request, upgrade);
            note(context, request, "/vehicles/{manufacturer}/{serialNumber}",
                 admitted ? 101 : admitted.error().status, start);
            if (admitted) {
                buffer = beast::flat_buffer{};  // a vehicle stays for days
                co_await vehicle_session(context, std::move(stream), std::move(message), *admitted);
                co_return;
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
                co_await event_session(context, stream, std::move(request));
                break;
            }
            if (upgrade) {
                note(context, request, out.route, 101, start);
                co_await stream_session(context, std::move(stream), std::move(message),
                                        std::move(request));
                co_return;
            }
            out.response = upgrade_required(request);
        }
        note(context, request, out.route, out.asset ? 200 : out.response.status, start);
        keep = co_await write_response(context, stream, request, out.response, version, keep,
                                       out.asset);
    }
    co_await close_gently(stream, linger);
}

template net::awaitable<void> http_session(Context&, PlainStream, std::string);
template net::awaitable<void> http_session(Context&, TlsStream, std::string);

}  // namespace pulseline::server
