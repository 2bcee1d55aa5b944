#include "server/server.hpp"

#include <csignal>

#include "core/base/crash_point.hpp"
#include "server/base/log.hpp"
#include "server/server_impl.hpp"
#include "server/sessions/listener.hpp"

namespace pulseline::server {
namespace {

constexpr auto kStopGrace = std::chrono::milliseconds(1500);  // of sessions
constexpr auto kLongestStop = std::chrono::seconds(8);        // of all, a disk that hangs included

}  // namespace

void log_end(const std::exception_ptr& error) {
    if (error) log::error("loop_threw", {{"what", what(error)}});
}

const char* const kVersion = PULSELINE_VERSION;

Server::Impl::~Impl() {
    if (stopper_.joinable()) stopper_.join();
    if (runtime_) runtime_->stop();
    lanes_.clear();
    acceptor_.reset();
    signals_.reset();
    io_.reset();
}

void Server::Impl::run() {
    for (;;) {
        try {
            io_->run();
            return;
        } catch (const std::exception& e) {
            // One broken handler may not end the service.
            log::error("handler_threw", {{"what", e.what()}});
        }
    }
}

/// Nothing here may wait: who watches the server is answered until its end.
void Server::Impl::begin_stop() {
    if (std::exchange(stopping_, true)) return;
    log::info("stopping");
    context_->stops.stop_all();
    for (auto& lane : lanes_) lane->stop();
    stopper_ = std::thread([this] {
        crash_point(CrashPoint::kStopBeforeLastCommit);
        runtime_->stop();  // what was asked before is committed; its answers wait in io_
        crash_point(CrashPoint::kStopAfterLastCommit);
        net::post(*io_, [this] { net::co_spawn(*io_, finish(), log_end); });
    });
}

void Server::Impl::limit_stop() {
    stop_limit_.begin(kLongestStop, [this] {
        const auto queues = runtime_->queues();
        log::error("stop_unfinished", {{"commits", std::to_string(queues.commits)},
                                       {"commands", std::to_string(queues.commands)}});
        log::flush();
        std::_Exit(1);
    });
}

net::awaitable<void> Server::Impl::finish() {
    error_code ec;
    acceptor_->close(ec);
    const auto until = std::chrono::steady_clock::now() + kStopGrace;
    net::steady_timer timer(*io_);
    while (context_->connections > 0 && std::chrono::steady_clock::now() < until) {
        timer.expires_after(std::chrono::milliseconds(10));
        co_await timer.async_wait(into(ec));
    }
    io_->stop();
}

std::optional<Error> Server::Impl::not_ready() const {
    if (stopping_) {
        return Error{Errc::kUnavailable, {"stopping", {}}, "The server is stopping.", {}};
    }
    if (pausing_ > 0) {
        return Error{Errc::kUnavailable,
                     {"internal", {}},
                     "A part of the server met a fault of its own and is being started again.",
                     {}};
    }
    if (!runtime_->writable()) {
        return store_unavailable(runtime_->store_fault());
    }
    return std::nullopt;
}

std::string Server::Impl::metrics() const {
    return metrics_.text(hub_->orders_by_state(), hub_->vehicles_by_link(), runtime_->queues());
}

Server::Server(Options options, Parts parts)
    : impl_(std::make_unique<Impl>(std::move(options), parts)) {}
Server::~Server() = default;

Status Server::check(const Options& options) {
    const auto address = parse_address(options.listen);
    return address ? check_exposure(options, *address) : fail(address.error());
}
Status Server::start() { return impl_->start(); }
void Server::run() { impl_->run(); }
void Server::stop() {
    net::post(*impl_->io_, [impl = impl_.get()] { impl->begin_stop(); });
}
void Server::stop_on_signals() {
    impl_->signals_->add(SIGINT);
    impl_->signals_->add(SIGTERM);
    impl_->signals_->async_wait([impl = impl_.get()](const error_code& ec, int) {
        if (ec) return;
        error_code ignored;
        impl->signals_->clear(ignored);  // a second one ends the process as it ends any
        impl->limit_stop();
        impl->begin_stop();
    });
}
std::string Server::url() const {
    return (impl_->tls_ ? "https://" : "http://") + impl_->address_.text();
}
std::uint16_t Server::port() const { return impl_->address_.port; }
std::string Server::tls_fingerprint() const {
    return impl_->tls_ ? impl_->tls_->fingerprint : std::string();
}
api::access::AccessControl& Server::access() { return *impl_->access_; }

}  // namespace pulseline::server
