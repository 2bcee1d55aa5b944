#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/result.hpp"
#include "server/base/lane.hpp"
#include "server/base/log.hpp"
#include "server/base/net.hpp"
#include "server/runtime/fleet_runtime.hpp"

namespace pulseline::server {

template <class R>
using Done = std::function<void(Result<R>)>;

/// Waits for a callback. `start` is given the callback and must see to it that it is called once,
/// on the network thread.
template <class R>
net::awaitable<Result<R>> callback(std::function<void(Done<R>)> start) {
    return net::async_initiate<const net::use_awaitable_t<>&, void(Result<R>)>(
        [](auto handler, std::function<void(Done<R>)> begin) {
            auto shared = std::make_shared<decltype(handler)>(std::move(handler));
            begin([shared](Result<R> result) { (*shared)(std::move(result)); });
        },
        net::use_awaitable, std::move(start));
}

/// Why a lane did not run a job. The words tell the caller what to do about it.
inline Error not_run(Lane::Taken why) {
    if (why == Lane::Taken::kShareIsUsed) {
        return {Errc::kTooMany,
                {"too_many_requests", {{"retry_after_s", std::int64_t{1}}}},
                "Too many requests of this account wait; wait for their answers first.",
                {}};
    }
    if (why == Lane::Taken::kFull) {
        return {Errc::kOverloaded,
                {"overloaded", {{"retry_after_s", std::int64_t{2}}}},
                "Too many requests of this kind wait. Try again in 2 seconds.",
                {}};
    }
    return {Errc::kUnavailable, {"stopping", {}}, "The server is stopping.", {}};
}

/// Runs `f` on the lane for `whose` and comes back to the network thread. What `f` throws is logged
/// and becomes the error `internal`.
template <class R>
net::awaitable<Result<R>> on(Lane& lane, net::io_context& home, std::function<R()> f,
                             std::string whose = {}) {
    return callback<R>([&lane, &home, f = std::move(f), whose = std::move(whose)](Done<R> done) {
        const auto give = [&home, done](Result<R> result) {
            net::post(home, [done, result = std::move(result)] { done(result); });
        };
        const auto taken = lane.take(whose, [f, give](bool run) {
            if (!run) return give(fail(not_run(Lane::Taken::kStopped)));
            try {
                give(f());
            } catch (const StoreUnavailable& e) {
                give(fail(Errc::kUnavailable, "store_unavailable", e.what()));
            } catch (const std::exception& e) {
                log::error("task_threw", {{"what", e.what()}});
                give(fail(Errc::kInternal, "internal", "The server met a fault of its own."));
            }
        });
        if (taken != Lane::Taken::kYes) give(fail(not_run(taken)));
    });
}

}  // namespace pulseline::server
