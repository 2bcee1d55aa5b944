#pragma once

#include <utility>

#include "server/base/net.hpp"

namespace pulseline::server {

/// Wakes one waiting coroutine; a wake that nobody waits for is kept.
class Signal {
public:
    explicit Signal(net::io_context& io) : timer_(io) {}
    void set() {
        if (!std::exchange(set_, true)) timer_.cancel();
    }
    /// False when `most` passed without a set().
    net::awaitable<bool> wait(std::chrono::steady_clock::duration most) {
        if (!set_) {
            timer_.expires_after(most);
            error_code ec;
            co_await timer_.async_wait(into(ec));
        }
        co_return std::exchange(set_, false);
    }

private:
    net::steady_timer timer_;
    bool set_ = false;
};

}  // namespace pulseline::server
