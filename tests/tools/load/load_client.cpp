// A shift's load from one program: vehicles that report ten times a second, dashboards that watch
// them, and programs that ask over REST. Prints one line of JSON: how long a report takes to a
// dashboard, how long answers take, what was lost.
#include <fmt/format.h>
#include <sys/epoll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/tools/load/askers.hpp"
#include "tests/tools/load/dashboard.hpp"

namespace pulseline::load {
namespace {

struct Settings {
    std::uint16_t port = 0;
    std::string vehicles_file;  // a line each: id maker serial token x_m y_m node hall
    std::string token;
    std::vector<std::string> dashboard_tokens;  // in turn: one account has so many streams
    double states_per_s = 10;
    int dashboards = 20;
    int watchers = 10;  // dashboards whose every frame is read; the others only take theirs
    double requests_per_s = 20;
    double orders_per_s = 2;
    double seconds = 60;
};

std::string rfc3339_now() {
    const auto now = std::chrono::system_clock::now();
    const auto time = std::chrono::system_clock::to_time_t(now);
    std::tm utc{};
    gmtime_r(&time, &utc);
    const auto ms =
        std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count() %
        1000;
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", utc.tm_year + 1900,
                       utc.tm_mon + 1, utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec, ms);
}

class Load {
public:
    explicit Load(Settings settings) : settings_(std::move(settings)) {
        std::ifstream file(settings_.vehicles_file);
        for (Vehicle v; file >> v.id >> v.maker >> v.serial >> v.token >> v.x_m >> v.y_m >>
                        v.node >> v.hall;) {
            vehicles_.push_back(std::make_unique<Vehicle>(std::move(v)));
            v = Vehicle();
        }
        if (vehicles_.empty())
            throw std::runtime_error("no vehicles in " + settings_.vehicles_file);
        for (auto& vehicle : vehicles_) by_id_[vehicle->id] = vehicle.get();
    }

    nlohmann::json run() {
        connect_all();
        const double warm_s = std::min(10.0, settings_.seconds / 4);
        const auto start = Clock::now();
        const auto end = start + seconds(settings_.seconds);
        std::uint64_t states_due = 0;
        Askers askers({settings_.port, settings_.token, ids(), settings_.requests_per_s,
                       settings_.orders_per_s},
                      machine_);
        askers.begin(start, start + seconds(warm_s), end);
        while (Clock::now() < end) {
            const double now_s = std::chrono::duration<double>(Clock::now() - start).count();
            counts_ = now_s >= warm_s;
            const auto all = static_cast<double>(vehicles_.size()) * settings_.states_per_s;
            const std::string stamp = rfc3339_now();
            for (; static_cast<double>(states_due) < now_s * all; ++states_due) {
                auto& vehicle = *vehicles_[states_due % vehicles_.size()];
                if (!vehicle.peer->open() || vehicle.peer->ended()) continue;
                vehicle.report(stamp);
                ++totals_.states;
            }
            wait_and_read(1);
        }
        askers.join();
        return summary(askers.totals());
    }

    ~Load() { ::close(epoll_); }

private:
    static Clock::duration seconds(double value) {
        return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(value));
    }
    std::vector<std::string> ids() const {
        std::vector<std::string> all;
        for (const auto& vehicle : vehicles_) all.push_back(vehicle->id);
        return all;
    }

    void connect_all() {
        for (std::size_t i = 0; i < vehicles_.size(); ++i) {
            vehicles_[i]->connect(settings_.port);
            watch(*vehicles_[i]->peer, i);
            wait_and_read(0);
        }
        wait_until_open([&] {
            return std::ranges::all_of(
                vehicles_, [](const auto& v) { return v->peer->open() || v->peer->ended(); });
        });
        const std::string stamp = rfc3339_now();
        for (auto& vehicle : vehicles_) {
            vehicle->peer->send_text(fmt::format(
                R"({{"topic":"connection","retain":true,"payload":{{{},"connectionState":"ONLINE"}}}})",
                vehicle->header(stamp)));
            vehicle->report(stamp);
        }
        for (int i = 0; i < settings_.dashboards; ++i) {
            const auto& tokens = settings_.dashboard_tokens;
            dashboards_.push_back(std::make_unique<Dashboard>(
                settings_.port, tokens[static_cast<std::size_t>(i) % tokens.size()],
                i < settings_.watchers, machine_));
            watch(dashboards_.back()->peer(), vehicles_.size() + static_cast<std::size_t>(i));
            wait_and_read(0);
        }
        wait_until_open([&] {
            return std::ranges::all_of(
                dashboards_, [](const auto& d) { return d->peer().open() || d->peer().ended(); });
        });
    }

    template <class Condition>
    void wait_until_open(Condition done) {
        const auto until = Clock::now() + std::chrono::seconds(60);
        while (!done()) {
            if (Clock::now() > until)
                throw std::runtime_error("waited 60 s in vain for the connections");
            wait_and_read(5);
        }
    }

    /// `number`: of vehicles_, or behind them of dashboards_. Told of each change once: to ask the
    /// kernel for all of 1,200 connections a thousand times a second cost more than the rest.
    void watch(Peer& peer, std::size_t number) {
        epoll_event wanted{};
        wanted.events = EPOLLIN | EPOLLOUT | EPOLLRDHUP | EPOLLET;
        wanted.data.u64 = number;
        if (::epoll_ctl(epoll_, EPOLL_CTL_ADD, peer.socket(), &wanted) != 0)
            throw std::runtime_error("epoll_ctl failed");
    }

    void wait_and_read(int timeout_ms) {
        std::array<epoll_event, 256> ready{};
        const int n = ::epoll_wait(epoll_, ready.data(), ready.size(), timeout_ms);
        for (int i = 0; i < n; ++i) {
            const auto number = ready[static_cast<std::size_t>(i)].data.u64;
            if (number < vehicles_.size()) {
                read(*vehicles_[number]);
            } else {
                read(*dashboards_[number - vehicles_.size()]);
            }
        }
    }
    void read(Vehicle& vehicle) {
        if (vehicle.peer->ended()) return;
        vehicle.peer->flush();
        vehicle.peer->read([](std::string_view) {}, [](const Peer::Answer&) {});
        if (vehicle.peer->ended()) ++totals_.vehicles_cut;
    }
    void read(Dashboard& dashboard) {
        Peer& peer = dashboard.peer();
        if (peer.ended()) return;
        peer.flush();
        peer.read([&](std::string_view text) { dashboard.take(text, by_id_, counts_, totals_); },
                  [](const Peer::Answer&) {});
        if (peer.ended()) ++totals_.dashboards_cut;
    }

    nlohmann::json summary(const AskTotals& asked) const {
        nlohmann::json statuses = nlohmann::json::object();
        for (const auto& [status, n] : asked.statuses) statuses[std::to_string(status)] = n;
        nlohmann::json refusals = nlohmann::json::object();
        for (const auto& [status, body] : asked.refusals) {
            refusals[std::to_string(status)] = body;
        }
        return {{"states", totals_.states},
                {"states_per_s", static_cast<double>(totals_.states) / settings_.seconds},
                {"frames", totals_.frames},
                {"machine_stood_still", machine_.summary()},
                {"state_to_dashboard", totals_.to_dashboard.summary()},
                {"answers", asked.answers.summary()},
                {"accepted", asked.accepted.summary()},
                {"statuses", statuses},
                {"refusals", refusals},
                {"not_asked_in_time", asked.not_asked},
                {"events", totals_.events},
                {"events_lost", totals_.events_lost},
                {"vehicles_lost", totals_.vehicles_lost.size()},
                {"vehicles_cut", totals_.vehicles_cut},
                {"dashboards_cut", totals_.dashboards_cut},
                {"requests_cut", asked.cut}};
    }

    Settings settings_;
    MachineWatch machine_;
    std::vector<std::unique_ptr<Vehicle>> vehicles_;
    VehiclesById by_id_;
    std::vector<std::unique_ptr<Dashboard>> dashboards_;
    int epoll_ = ::epoll_create1(EPOLL_CLOEXEC);
    Totals totals_;
    bool counts_ = false;
};

}  // namespace
}  // namespace pulseline::load

int main(int argc, char** argv) {
    pulseline::load::Settings settings;
    CLI::App app("Load of vehicles, dashboards and programs on a server of this machine");
    app.add_option("--port", settings.port)->required();
    app.add_option("--vehicles", settings.vehicles_file,
                   "a line each: id maker serial token x_m y_m node hall")
        ->required();
    app.add_option("--token", settings.token, "of the API, role operator")->required();
    app.add_option("--dashboard-tokens", settings.dashboard_tokens, "of the API, comma-separated")
        ->required()
        ->delimiter(',');
    app.add_option("--states", settings.states_per_s, "of a vehicle in a second");
    app.add_option("--dashboards", settings.dashboards);
    app.add_option("--watchers", settings.watchers);
    app.add_option("--requests", settings.requests_per_s, "in a second");
    app.add_option("--orders", settings.orders_per_s, "in a second");
    app.add_option("--seconds", settings.seconds)->check(CLI::Range(1.0, 7200.0));
    CLI11_PARSE(app, argc, argv);
    try {
        std::puts(pulseline::load::Load(settings).run().dump().c_str());
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "load_client: %s\n", e.what());
        return 1;
    }
}
