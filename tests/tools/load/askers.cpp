#include "tests/tools/load/askers.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace pulseline::load {
namespace {

constexpr int kAskers = 24;
constexpr int kThatOrder = 8;
constexpr std::size_t kOpenOrders = 500;  // more are cancelled, the oldest first

}  // namespace

Askers::Askers(Settings settings, const MachineWatch& machine)
    : settings_(std::move(settings)), machine_(machine) {
    for (int i = 0; i < kAskers; ++i) {
        askers_.push_back(
            {std::make_unique<Peer>(settings_.port), {}, false, i < kThatOrder, false});
    }
}

Askers::~Askers() {
    if (thread_.joinable()) thread_.join();
}

void Askers::begin(Clock::time_point start, Clock::time_point counts_from, Clock::time_point end) {
    thread_ = std::thread([this, start, counts_from, end] {
        try {
            run(start, counts_from, end);
        } catch (...) {
            error_ = std::current_exception();
        }
    });
}

void Askers::join() {
    thread_.join();
    if (error_) std::rethrow_exception(error_);
}

void Askers::run(Clock::time_point start, Clock::time_point counts_from, Clock::time_point end) {
    counts_from_ = counts_from;
    std::uint64_t requests_due = 0, orders_due = 0;
    while (Clock::now() < end) {
        const double now_s = std::chrono::duration<double>(Clock::now() - start).count();
        for (; static_cast<double>(requests_due) < now_s * settings_.requests_per_s; ++requests_due)
            ask(false, requests_due);
        for (; static_cast<double>(orders_due) < now_s * settings_.orders_per_s; ++orders_due)
            ask(true, orders_due);
        cancel_the_oldest();
        read(1);
    }
}

/// The next thing to ask; one that finds all askers still waiting is counted as not asked.
void Askers::ask(bool order, std::uint64_t index) {
    Asker* free = free_asker(order);
    if (!free) {
        ++totals_.not_asked;
        return;
    }
    const std::size_t count = settings_.vehicles.size();
    const std::string& vehicle = settings_.vehicles[index * 7919 % count];
    const std::array reads{"/api/v1/vehicles/" + vehicle, std::string("/api/v1/fleet"),
                           "/api/v1/stations/" + std::to_string(1 + index % count),
                           std::string("/api/v1/job-orders?limit=20"),
                           std::string("/api/v1/stop-records?limit=20")};
    const std::string common =
        "Host: 127.0.0.1\r\nAuthorization: Bearer " + settings_.token + "\r\n";
    free->busy = true;
    free->due = Clock::now();
    if (order) {
        const std::string body =
            fmt::format(R"({{"vehicle":"{}","start":false,"steps":[{{"station":{}}}]}})", vehicle,
                        2 + 2 * (index * 7919 % count));
        free->peer->send_raw("POST /api/v1/job-orders HTTP/1.1\r\n" + common +
                             "Content-Type: application/json\r\nContent-Length: " +
                             std::to_string(body.size()) + "\r\n\r\n" + body);
    } else {
        free->peer->send_raw("GET " + reads[index % reads.size()] + " HTTP/1.1\r\n" + common +
                             "\r\n");
    }
}

Askers::Asker* Askers::free_asker(bool order) {
    const auto free = std::ranges::find_if(
        askers_, [&](const Asker& a) { return !a.busy && a.orders == order && !a.peer->ended(); });
    return free == askers_.end() ? nullptr : &*free;
}

/// A server takes no more than so many open orders, and nobody ends these.
void Askers::cancel_the_oldest() {
    Asker* free = free_asker(true);
    if (open_orders_.size() <= kOpenOrders || !free) return;
    free->busy = free->cancels = true;
    free->due = Clock::now();
    free->peer->send_raw("POST /api/v1/job-orders/" + open_orders_.front() +
                         "/cancel HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: Bearer " +
                         settings_.token +
                         "\r\nContent-Type: application/json\r\nContent-Length: 2\r\n\r\n{}");
    open_orders_.pop_front();
}

void Askers::read(int timeout_ms) {
    std::array<pollfd, kAskers> polled{};
    for (std::size_t i = 0; i < askers_.size(); ++i) {
        Peer& peer = *askers_[i].peer;
        polled[i] = {peer.ended() ? -1 : peer.socket(),
                     static_cast<short>(POLLIN | (peer.writes_wait() ? POLLOUT : 0)), 0};
    }
    ::poll(polled.data(), polled.size(), timeout_ms);
    for (std::size_t i = 0; i < askers_.size(); ++i) {
        Asker& asker = askers_[i];
        if (polled[i].revents & POLLOUT) asker.peer->flush();
        if (polled[i].revents & (POLLIN | POLLHUP | POLLERR)) {
            asker.peer->read([](std::string_view) {},
                             [&](const Peer::Answer& answer) { take(asker, answer); });
        }
        if (!asker.peer->ended()) continue;
        // A connection has a thousand requests; then it is begun anew.
        if (asker.busy) ++totals_.cut;
        asker = {std::make_unique<Peer>(settings_.port), {}, false, asker.orders, false};
    }
}

void Askers::take(Asker& asker, const Peer::Answer& answer) {
    asker.busy = false;
    ++totals_.statuses[answer.status];
    if (answer.status >= 300) totals_.refusals.try_emplace(answer.status, answer.body);
    const bool created = asker.orders && !std::exchange(asker.cancels, false);
    if (created && answer.status == 201) {
        const auto order = nlohmann::json::parse(answer.body, nullptr, false);
        if (order.is_object()) open_orders_.push_back(order.value("id", ""));
    }
    if (asker.due < counts_from_) return;
    (created ? totals_.accepted : totals_.answers)
        .add(ms_since(asker.due), machine_.stood_still_since(asker.due));
}

}  // namespace pulseline::load
