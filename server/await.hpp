#pragma once

#include <boost/asio/thread_pool.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/result.hpp"
#include "server/fleet_runtime.hpp"
#include "server/log.hpp"
#include "server/net.hpp"

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

/// Runs `f` on the pool and comes back to the network thread. What `f` throws is logged and becomes
/// the error `internal`.
template <class R>
net::awaitable<Result<R>> on(net::thread_pool& pool, net::io_context& home, std::function<R()> f) {
    return callback<R>([&pool, &home, f = std::move(f)](Done<R> done) {
        net::post(pool, [&home, f, done = std::move(done)] {
            std::optional<Result<R>> result;
            try {
                result = f();
            } catch (const StoreUnavailable& e) {
                result = fail(Errc::kUnavailable, "store_unavailable", e.what());
            } catch (const std::exception& e) {
                log::error("task_threw", {{"what", e.what()}});
                result = fail(Errc::kUnavailable, "internal", "The server met a fault of its own.");
            }
            net::post(home, [done, result = std::move(*result)] { done(result); });
        });
    });
}

}  // namespace pulseline::server
