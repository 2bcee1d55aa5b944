#include <array>
#include <chrono>

#include "api/http/vehicles/unknown.hpp"
#include "api/http/wire/problem.hpp"
#include "server/sessions/receive.hpp"
#include "server/sessions/run_handler.hpp"
#include "server/sessions/sessions.hpp"

namespace pulseline::server {
namespace {

using Steady = std::chrono::steady_clock;

constexpr std::size_t kMostPathLogged = 256;

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
    out.response = co_await run_handler(context, *admitted.route, request);
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

net::awaitable<Next> http_session(Context& context, ByteStream stream, std::string peer) {
    const Limits& limits = context.options.limits;
    error_code ignored;
    stream.lowest().socket().set_option(
        net::socket_base::send_buffer_size(limits.send_buffer_bytes), ignored);
    beast::flat_buffer buffer(limits.header_bytes + 64 * 1024);
    bool keep = true;
    bool linger = false;
    for (int count = 0; keep && count < limits.requests_per_connection; ++count) {
        Parser parser;
        auto received = co_await receive(context, stream, buffer, parser, peer, count == 0);
        if (received.ended) break;
        const unsigned version = parser.get().version() >= 11 ? 11 : 10;
        const auto start = Steady::now();
        if (received.refusal) {
            linger = true;
            note(context, received.request, "unreadable", received.refusal->status, start);
            co_await write_response(context, stream, received.request, *received.refusal, version,
                                    false);
            break;
        }
        const bool upgrade = websocket::is_upgrade(parser.get());
        keep = parser.get().keep_alive() && !context.stops.stopping() &&
               count + 1 < limits.requests_per_connection;
        auto message = parser.release();
        auto request = std::move(received.request);
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
            const auto kind = std::get<api::Socket>(out.socket->handler);
            if (kind == api::Socket::kEventStream) {
                note(context, request, out.route, 200, start);
                co_await event_session(context, stream, std::move(request), version);
                break;
            }
            const auto* vehicle =
                kind == api::Socket::kHandHeld
                    ? plant::find_vehicle(context.plant, plant::VehicleId(request.params["id"]))
                    : nullptr;
            if (kind == api::Socket::kHandHeld && vehicle == nullptr) {
                out.response = api::problem(api::unknown_vehicle(request.params["id"]), request);
            } else if (upgrade) {
                note(context, request, out.route, 101, start);
                end_abruptly(stream, false);
                if (vehicle != nullptr) {
                    co_return hand_held_session(context, std::move(stream), std::move(message),
                                                std::move(request), vehicle->id);
                }
                co_return stream_session(context, std::move(stream), std::move(message),
                                         std::move(request));
            } else {
                out.response = upgrade_required(request);
            }
        }
        note(context, request, out.route, out.asset ? 200 : out.response.status, start);
        keep = co_await write_response(context, stream, request, out.response, version, keep,
                                       out.asset);
    }
    co_await close_gently(stream, linger);
    co_return std::nullopt;
}

}  // namespace pulseline::server
