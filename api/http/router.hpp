#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "api/http/wire/contexts.hpp"
#include "api/http/wire/message.hpp"

/// The one table of operations: who may call each, and where it runs. Deny by default.
///
/// How the server uses it, on a session's own thread:
///
///     Request request = ...;                        // parse_target(), headers, body, request id
///     request.identity = access.identify(request.headers, now);
///     const Admission admitted = admit(request, policy);   // 404 405 400 401 403 415
///     if (admitted.refusal) co_return *admitted.refusal;
///     const Route& route = *admitted.route;
///     if (auto* h = std::get_if<InlineHandler>(&route.handler)) {
///         response = h(inline_context, request);
///     } else if (auto* h = std::get_if<FleetHandler>(&route.handler)) {
///         // the response may leave only when the outputs of this step are committed
///         FleetAnswer answer = co_await on(fleet_thread, [&] { return h(fleet_context, request);
///         }); response = answer.then ? co_await on(history, [&] { return
///         answer.then(history_context); })
///                                : std::move(answer.response);
///     } else if (auto* h = std::get_if<HistoryHandler>(&route.handler)) {
///         response = co_await on(history, [&] { return h(history_context, request); });
///     } else if (auto* h = std::get_if<WorkerHandler>(&route.handler)) {
///         response = co_await on(workers, [&] { return h(worker_context, request); });
///     } else {                                       // Socket
///         route.operation is "stream" or "handHeld" (WebSocket upgrade) or "streamEvents" (SSE)
///     }
///
/// Whatever a hop throws becomes internal_error(request); a failed commit unavailable(request).
/// Paths that match() does not know belong to the static files.
namespace pulseline::api {

using InlineHandler = Response (*)(const InlineContext&, const Request&);
using FleetHandler = FleetAnswer (*)(FleetContext&, const Request&);
using HistoryHandler = Response (*)(const HistoryContext&, const Request&);
using WorkerHandler = Response (*)(const WorkerContext&, const Request&);
/// The server itself keeps the connection: a WebSocket with what happens or of a hand-held control,
/// or server-sent events.
enum class Socket { kWebSocket, kHandHeld, kEventStream };

struct Route {
    const char* method;
    const char* pattern;                // "/api/v1/job-orders/{id}"
    const char* operation;              // operationId of openapi.yaml
    std::optional<access::Role> least;  // none: public
    std::vector<const char*> query;     // parameters it knows; others are refused
    std::variant<InlineHandler, FleetHandler, HistoryHandler, WorkerHandler, Socket> handler;
    bool only_asks = false;  // a POST that changes nothing: answered while nothing can be stored
    std::size_t body_bytes = 0;  // of those who may use it; 0: what the server allows everybody
    bool heavy = false;          // takes a good part of a second of the history thread
    bool hashes = false;         // checks a password: waits behind a gate of its own

    bool changes() const;  // not GET
    /// This very request changes nothing (a dry run): answered while nothing can be stored.
    bool asks(const Request& request) const;
    /// This very request makes vehicles stand: it acts first and is stored when possible.
    bool stops(const Request& request) const;
};

std::span<const Route> routes();

/// Which browser pages may talk to this server with a cookie.
struct AccessPolicy {
    std::vector<std::string> origins;  // exact: "https://hall.example:8443"
};

struct Match {
    const Route* route = nullptr;
    std::vector<std::string> allowed;  // methods of the path; empty: the path is unknown
};
/// Finds the route and fills request.params. HEAD finds what GET finds.
Match match(Request& request);

/// Role, cross-site rules, media type and known query parameters; nothing when the request may
/// pass. A change with a session cookie needs X-Pulseline-CSRF of that session, a same-origin
/// Sec-Fetch-Site under a Host of ours or an allowed Origin, and application/json; a WebSocket with
/// a cookie needs an allowed Origin. Bearer tokens need none of it, since no browser sends them by
/// itself.
std::optional<Response> authorise(const Route& route, const Request& request,
                                  const AccessPolicy& policy);

/// match() and authorise() in one: a route, or the answer that refuses the request.
struct Admission {
    const Route* route = nullptr;
    std::optional<Response> refusal;
};
Admission admit(Request& request, const AccessPolicy& policy);

}  // namespace pulseline::api
