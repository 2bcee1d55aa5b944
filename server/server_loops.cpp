#include <malloc.h>

#include <cmath>

#include "server/base/server_clock.hpp"
#include "server/server_impl.hpp"

/// What the server does again and again by itself.
namespace pulseline::server {
namespace {

constexpr auto kKeepUses = std::chrono::seconds(30);
constexpr auto kGiveBack = std::chrono::seconds(60);
constexpr auto kFollowClock = std::chrono::seconds(1);

}  // namespace

net::awaitable<void> Server::Impl::beat() {
    net::steady_timer timer(*io_);
    for (;;) {
        timer.expires_after(StreamHub::kBeatPeriod);
        error_code ec;
        co_await timer.async_wait(into(ec));
        runtime_->listening();
        hub_->beat();
    }
}

/// Core time follows UTC; people hear of it when the two differ.
net::awaitable<void> Server::Impl::follow_clock() {
    net::steady_timer timer(*io_);
    while (!stopping_) {
        clock_->follow();
        const Duration ahead = clock_->ahead();
        if (const auto news = clock_watch_.look(ahead); news != ClockWatch::News::kNone) {
            tell_of_clock(news == ClockWatch::News::kDiffers, ahead);
        }
        metrics_.clock_ahead_ms = ahead / std::chrono::milliseconds(1);
        timer.expires_after(kFollowClock);
        error_code ec;
        co_await timer.async_wait(into(ec));
    }
}

/// In the log and in the events; while nothing can be stored, a second later again.
void Server::Impl::tell_of_clock(bool differs, Duration ahead) {
    const auto tell = [differs, ahead](fleet::Fleet& fleet, Time now) {
        if (differs) {
            fleet.clock_differs(ahead, now);
        } else {
            fleet.clock_agrees(now);
        }
        return true;
    };
    runtime_->command(tell, [this, differs, ahead](const Result<bool>& told) {
        if (!told) return clock_watch_.not_told();
        log::warn(differs ? "clock_differs" : "clock_agrees",
                  {{"ahead_s", std::to_string(std::llround(seconds(ahead)))},
                   {"remedy", differs && ahead > ServerClock::kTolerated
                                  ? "set the machine's clock; if that is right, restart the "
                                    "server: it then starts at UTC"
                                  : ""}});
    });
}

/// When sessions were used, written down now and then; those that have ended are dropped.
net::awaitable<void> Server::Impl::keep_uses() {
    net::steady_timer timer(*io_);
    while (!stopping_) {
        timer.expires_after(kKeepUses);
        error_code ec;
        co_await timer.async_wait(into(ec));
        const std::function<bool()> save = [this] {
            access_->save_uses();
            access_->forget_ended(clock_->now());
            return true;
        };
        co_await on<bool>(context_->workers, *io_, save, "uses of sessions");
    }
}

/// What a burst took stays with the process otherwise, and each takes a little more. It costs a
/// millisecond (a thousand vehicles, 190 MB).
net::awaitable<void> Server::Impl::give_memory_back() {
    net::steady_timer timer(*io_);
    while (!stopping_) {
        timer.expires_after(kGiveBack);
        error_code ec;
        co_await timer.async_wait(into(ec));
        const std::function<bool()> give_back = [] { return malloc_trim(0) != 0; };
        co_await on<bool>(context_->workers, *io_, give_back, "memory");
    }
}

}  // namespace pulseline::server
