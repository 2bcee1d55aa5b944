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
        return handler(api::HistoryContext{context.history, context.plant});
    };
    auto result = co_await on<Response>(context.history_pool, context.io, job);
    co_return result ? std::move(*result) : refused(result.error(), request);
}

/// On a pool that lets only so many wait: those who only ask may not crowd each other out.
template <class R>
net::awaitable<Result<R>> within(Context& context, net::thread_pool& pool, std::size_t& waiting,
                                 std::size_t most, std::function<R()> job) {
    if (waiting >= most) {
        co_return fail(Errc::kUnavailable, "overloaded",
                       "Too many such questions wait. Try again in 2 seconds.", {},
                       {{"retry_after_s", std::int64_t{2}}});
    }
    ++waiting;
    auto result = co_await on<R>(pool, context.io, std::move(job));
    --waiting;
    co_return result;
}

net::awaitable<Response> on_fleet(Context& context, const api::Route& route,
                                  const Request& request) {
    using api::FleetAnswer;
    const auto handler = std::get<api::FleetHandler>(route.handler);
    const auto job_of = [&context, handler](auto of) {
        return [&context, handler, of](fleet::Fleet& fleet, Time now) {
            api::FleetContext with{fleet, context.plant, context.images, now};
            return handler(with, *of);
        };
    };
    const std::function<void(Done<FleetAnswer>)> begin = [&](Done<FleetAnswer> done) {
        if (route.asks(request)) {
            context.runtime.read(job_of(&request), std::move(done));
        } else if (route.stops(request)) {
            // It may be done once more when this session is long over.
            context.runtime.stop_command(job_of(std::make_shared<const Request>(request)),
                                         std::move(done));
        } else {
            context.runtime.command(job_of(&request), std::move(done));
        }
    };
    auto answer = co_await callback<FleetAnswer>(begin);
    if (!answer) co_return refused(answer.error(), request);
    if (answer->plan) {
        const std::function<FleetAnswer()> job = [&context, plan = std::move(answer->plan)] {
            return plan(api::PlanContext{context.motions, context.orders});
        };
        answer = co_await within<FleetAnswer>(context, context.planners, context.planners_waiting,
                                              context.options.limits.planners_waiting, job);
        if (!answer) co_return refused(answer.error(), request);
    }
    if (answer->again) {
        const std::function<void(Done<FleetAnswer>)> command =
            [&, again = std::move(answer->again)](Done<FleetAnswer> done) {
                context.runtime.command(
                    [&context, again](fleet::Fleet& fleet, Time now) {
                        api::FleetContext with{fleet, context.plant, context.images, now};
                        return again(with);
                    },
                    std::move(done));
            };
        answer = co_await callback<FleetAnswer>(command);
        if (!answer) co_return refused(answer.error(), request);
    }
    if (answer->encode) {
        const std::function<Response()> job = [&context, encode = std::move(answer->encode)] {
            return encode(api::EncodeContext{context.plant, context.images});
        };
        auto written =
            co_await within<Response>(context, context.encoders, context.encoders_waiting,
                                      context.options.limits.encoders_waiting, job);
        co_return written ? std::move(*written) : refused(written.error(), request);
    }
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
