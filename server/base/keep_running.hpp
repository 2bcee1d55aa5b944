#pragma once

#include <algorithm>
#include <chrono>
#include <exception>
#include <functional>

#include "server/base/log.hpp"
#include "server/base/net.hpp"
#include "server/base/store_fault.hpp"

namespace pulseline::server {

/// Runs a loop that the server cannot be without, and again after an exception of it: after a pause
/// that doubles each time. `pausing` counts the loops that do not run now.
inline net::awaitable<void> keep_running(const char* name, net::io_context& io, int& pausing,
                                         std::function<net::awaitable<void>()> loop) {
    constexpr auto kShortest = std::chrono::milliseconds(100);
    constexpr auto kLongest = std::chrono::milliseconds(5000);
    for (auto pause = kShortest;; pause = std::min(2 * pause, kLongest)) {
        std::exception_ptr error;
        try {
            co_await loop();
        } catch (...) {
            error = std::current_exception();
        }
        if (!error) co_return;
        log::error("loop_threw", {{"loop", name}, {"what", what(error)}});
        ++pausing;
        net::steady_timer timer(io, pause);
        error_code ec;
        co_await timer.async_wait(into(ec));
        --pausing;
    }
}

}  // namespace pulseline::server
