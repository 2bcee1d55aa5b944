#include "server/dispatch.hpp"

#include "api/http/problem.hpp"

namespace pulseline::server {
namespace {

using api::Request;
using api::Response;

Response refused(const Error& error, const Request& request) {
    if (error.reason.code == "internal") return api::internal_error(request);
    return api::problem(error, request);
}

// `request` lives in the session's coroutine, which waits: references to it stay good.
net::awaitable<Response> on_history(Context& context, const Request& request,
                                    std::function<Response(const api::HistoryContext&)> handler) {
    const std::function<Response()> job = [&context, handler = std::move(handler)] {
        return handler(api::HistoryContext{context.history, context.plant, context.previewer});
    };
    auto result = co_await on<Response>(context.history_pool, context.io, job);
    co_return result ? std::move(*result) : refused(result.error(), request);
}

net::awaitable<Response> on_fleet(Context& context, const api::Route& route,
                                  const Request& request) {
    using api::FleetAnswer;
    const auto handler = std::get<api::FleetHandler>(route.handler);
    const auto job = [&context, handler, &request](fleet::Fleet& fleet, Time now) {
        api::FleetContext with{fleet, context.plant, context.images, now};
        return handler(with, request);
    };
    const std::function<void(Done<FleetAnswer>)> begin = [&context, &route,
                                                          job](Done<FleetAnswer> done) {
        if (route.changes() && !route.only_asks) {
            context.runtime.command(job, std::move(done));
        } else {
            context.runtime.read(job, std::move(done));
        }
    };
    auto answer = co_await callback<FleetAnswer>(begin);
    if (!answer) co_return refused(answer.error(), request);
    if (!answer->then) co_return std::move(answer->response);
    co_return co_await on_history(context, request, std::move(answer->then));
}

net::awaitable<Response> on_worker(Context& context, const api::Route& route,
                                   const Request& request) {
    if (context.workers_waiting >= context.options.limits.workers_waiting) {
        co_return api::problem(429,
                               Error{Errc::kUnavailable,
                                     {"too_many_sign_ins", {{"retry_after_s", std::int64_t{2}}}},
                                     "Too many sign-ins are being checked. Try again in 2 seconds.",
                                     {}},
                               request);
    }
    ++context.workers_waiting;
    const auto handler = std::get<api::WorkerHandler>(route.handler);
    const std::function<Response()> job = [&context, handler, &request] {
        return handler(api::WorkerContext{context.access, context.clock.now()}, request);
    };
    auto result = co_await on<Response>(context.workers, context.io, job);
    --context.workers_waiting;
    context.hub.wake_all();  // a sign-out ends that session's open streams at once
    co_return result ? std::move(*result) : refused(result.error(), request);
}

}  // namespace

net::awaitable<Response> dispatch(Context& context, const api::Route& route,
                                  const Request& request) {
    if (const auto* handler = std::get_if<api::InlineHandler>(&route.handler)) {
        try {
            const api::InlineContext with{context.plant, context.documents, context.images,
                                          context.service, context.clock.now()};
            co_return (*handler)(with, request);
        } catch (const std::exception& e) {
            log::error("handler_threw", {{"request", request.request_id}, {"what", e.what()}});
            co_return api::internal_error(request);
        }
    }
    if (std::holds_alternative<api::FleetHandler>(route.handler)) {
        co_return co_await on_fleet(context, route, request);
    }
    if (const auto* handler = std::get_if<api::HistoryHandler>(&route.handler)) {
        const auto run = *handler;
        co_return co_await on_history(
            context, request,
            [run, &request](const api::HistoryContext& with) { return run(with, request); });
    }
    co_return co_await on_worker(context, route, request);
}

}  // namespace pulseline::server
