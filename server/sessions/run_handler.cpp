#include "server/sessions/run_handler.hpp"

#include "api/http/session/sign_in_request.hpp"
#include "api/http/wire/problem.hpp"

namespace pulseline::server {
namespace {

using api::Request;
using api::Response;

Response refused(const Error& error, const Request& request) {
    if (error.code == Errc::kInternal) return api::internal_error(request);
    return api::problem(error, request);
}

// `request` lives in the session's coroutine, which waits: references to it stay good.
net::awaitable<Response> on_history(Context& context, const Request& request,
                                    std::function<Response(const api::HistoryContext&)> handler,
                                    bool heavy) {
    const std::function<Response()> job = [&context, handler = std::move(handler)] {
        return handler(api::HistoryContext{context.history, context.plant});
    };
    auto result = co_await on<Response>(heavy ? context.heavy : context.lists, context.io, job,
                                        request.identity.name);
    co_return result ? std::move(*result) : refused(result.error(), request);
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
        answer = co_await on<FleetAnswer>(context.planners, context.io, job, request.identity.name);
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
            co_await on<Response>(context.encoders, context.io, job, request.identity.name);
        co_return written ? std::move(*written) : refused(written.error(), request);
    }
    if (!answer->then) co_return std::move(answer->response);
    co_return co_await on_history(context, request, std::move(answer->then), route.heavy);
}

/// Refused at once, a program that floods would only ask the faster.
net::awaitable<Response> refuse_sign_in(Context& context, const Request& request) {
    net::steady_timer timer(context.io, context.options.limits.sign_in_refusal);
    StopList::Entry stop(context.stops, [&] { timer.cancel(); });
    error_code ec;
    co_await timer.async_wait(into(ec));
    co_return api::problem(Error{Errc::kTooMany,
                                 {"too_many_sign_ins", {{"retry_after_s", std::int64_t{6}}}},
                                 "Too many sign-ins are being checked. Try again in 6 seconds.",
                                 {}},
                           request);
}

net::awaitable<Response> on_sign_in(Context& context, const api::WorkerHandler handler,
                                    const Request& request) {
    const auto now = context.clock.now();
    const auto sent = api::read_sign_in(request);
    if (!sent) co_return handler(api::WorkerContext{context.access, now}, request);
    const std::string peer = neighbourhood(request.peer);
    const auto way = context.gate.admit(sent->name, peer, context.known_sign_ins.fullness(), now);
    if (way == SignInGate::Way::kLater) co_return co_await refuse_sign_in(context, request);
    const bool known = way == SignInGate::Way::kKnown;
    const std::function<Response()> job = [&context, handler, &request] {
        return handler(api::WorkerContext{context.access, context.clock.now()}, request);
    };
    auto result = co_await on<Response>(known ? context.known_sign_ins : context.stranger_sign_ins,
                                        context.io, job);
    if (!result && result.error().code == Errc::kOverloaded) {
        co_return co_await refuse_sign_in(context, request);
    }
    if (result && result->status == 200) context.gate.succeeded(sent->name, peer, now);
    context.hub.wake_all();  // the session this browser had before has ended, its streams with it
    co_return result ? std::move(*result) : refused(result.error(), request);
}

net::awaitable<Response> on_worker(Context& context, const api::Route& route,
                                   const Request& request) {
    const auto handler = std::get<api::WorkerHandler>(route.handler);
    if (route.hashes) co_return co_await on_sign_in(context, handler, request);
    const std::function<Response()> job = [&context, handler, &request] {
        return handler(api::WorkerContext{context.access, context.clock.now()}, request);
    };
    auto result = co_await on<Response>(context.workers, context.io, job, request.identity.name);
    context.hub.wake_all();  // a sign-out ends that session's open streams at once
    co_return result ? std::move(*result) : refused(result.error(), request);
}

}  // namespace

net::awaitable<Response> run_handler(Context& context, const api::Route& route,
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
            [run, &request](const api::HistoryContext& with) { return run(with, request); },
            route.heavy);
    }
    co_return co_await on_worker(context, route, request);
}

}  // namespace pulseline::server
