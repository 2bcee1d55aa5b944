#include "server/agent/machine_command.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "api/plant/plant_file.hpp"
#include "server/agent/machine_link.hpp"
#include "server/agent/picture_folder.hpp"
#include "server/agent/simulated_controller.hpp"
#include "server/agent/truth_log.hpp"
#include "server/agent/utc.hpp"
#include "server/base/log.hpp"
#include "server/base/net.hpp"

namespace pulseline::agent {
namespace {

using namespace server;
using namespace std::chrono_literals;
using Steady = std::chrono::steady_clock;

constexpr auto kWatchEvery = 10ms;
constexpr auto kTruthEvery = 50ms;
constexpr std::size_t kRead = std::size_t{64} * 1024;

struct MachineOptions {
    std::string world_file;
    std::string vehicle;
    std::string listen = "tcp://127.0.0.1:0";
    std::string errors = "nominal";
    std::string truth_log;
    std::string pictures;  // folder for those of its cameras; empty: none
    std::uint64_t seed = 1;
    std::vector<std::string> faults;
};

/// The controller with its one program, the truth for those who judge, and what writes the
/// pictures of its cameras, if anybody does.
class Host {
public:
    Host(SimulatedController& controller, std::string vehicle, std::optional<TruthLog> truth,
         std::optional<PictureFolder> pictures)
        : controller_(controller),
          vehicle_(std::move(vehicle)),
          truth_(std::move(truth)),
          pictures_(std::move(pictures)) {}

    /// Talks with one program until it goes or is refused.
    net::awaitable<void> serve(tcp::socket socket) {
        error_code ec;
        socket.set_option(tcp::no_delay(true), ec);
        if (taken_) {
            const std::string no = machine::encode(machine::Refused{"taken: another has it"});
            co_await net::async_write(socket, net::buffer(no), into(ec));
            co_return;
        }
        taken_ = true;
        co_await talk(socket);
        controller_.part();
        taken_ = false;
    }

    net::awaitable<void> watch() {
        net::steady_timer timer(co_await net::this_coro::executor);
        auto last = Steady::now();
        for (;;) {
            timer.expires_after(kWatchEvery);
            error_code ec;
            co_await timer.async_wait(into(ec));
            const auto now = Steady::now();
            const double passed_s = std::chrono::duration<double>(now - last).count();
            controller_.wait(passed_s);
            controller_.apply_faults(passed_s);
            last = now;
            tell_truth(now);
            take_picture(now);
        }
    }

private:
    net::awaitable<void> talk(tcp::socket& socket) {
        std::string read;
        std::string answers;
        for (;;) {
            bool ends = false;
            answers.clear();
            for (;;) {
                const auto size = machine::frame_size(read);
                if (size && (!*size || read.size() < **size)) break;
                auto frame = size ? machine::decode(std::string_view(read).substr(0, **size))
                                  : Result<machine::Frame>(fail(size.error()));
                if (!frame) {
                    answers += machine::encode(machine::Refused{frame.error().reason.code});
                    ends = true;
                    break;
                }
                read.erase(0, **size);
                if (const auto* points = std::get_if<machine::SetPoints>(&*frame)) {
                    cycle_ = points->cycle;
                    placed_at_ = utc_now();
                }
                for (const auto& answer : controller_.handle(*frame)) {
                    answers += machine::encode(answer);
                    ends |= std::holds_alternative<machine::Refused>(answer);
                }
                if (moving_told() == controller_.braked()) tell_truth(Steady::now());
                if (ends) break;
            }
            error_code ec;
            if (!answers.empty()) {
                co_await net::async_write(socket, net::buffer(answers), into(ec));
            }
            if (ec || ends) co_return;
            const auto before = read.size();
            read.resize(before + kRead);
            const std::size_t got =
                co_await socket.async_read_some(net::buffer(read.data() + before, kRead), into(ec));
            read.resize(before + got);
            if (ec) co_return;
        }
    }

    void tell_truth(Steady::time_point now) {
        TruthLine line;
        line.vehicle = vehicle_;
        line.pose = controller_.true_pose();
        line.moving = !controller_.braked();
        line.cycle = cycle_;
        // In which cycle it has moved off or come to rest is told by a line of that cycle.
        const bool soon = line.moving != moving_told();
        const bool known = told_ && line.pose == told_->pose && !soon;
        if (!truth_ || known || (!soon && now - told_at_ < kTruthEvery)) return;
        told_ = line;
        told_at_ = now;
        truth_->write(line, to_ns(shown_at()) / 1'000'000);
    }

    bool moving_told() const { return told_ && told_->moving; }

    /// Since when it is where it is: between two set points its place is that of the first.
    Time shown_at() const { return controller_.braked() ? utc_now() : placed_at_; }

    void take_picture(Steady::time_point now) {
        const auto camera =
            pictures_ ? pictures_->due(now, !controller_.braked()) : std::optional<std::size_t>();
        if (!camera) return;
        const auto exposed = shown_at();
        pictures_->write(*camera, controller_.render(*camera), exposed);
    }

    SimulatedController& controller_;
    std::string vehicle_;
    std::optional<TruthLog> truth_;
    std::optional<PictureFolder> pictures_;
    std::optional<TruthLine> told_;
    Time placed_at_ = utc_now();
    std::uint32_t cycle_ = 0;  // of the newest set points
    Steady::time_point told_at_{};
    bool taken_ = false;
};

void rethrow(const std::exception_ptr& error) {
    if (error) std::rethrow_exception(error);
}

net::awaitable<void> accept_all(tcp::acceptor& acceptor, Host& host) {
    for (;;) {
        error_code ec;
        auto socket = co_await acceptor.async_accept(into(ec));
        if (ec) co_return;
        net::co_spawn(co_await net::this_coro::executor, host.serve(std::move(socket)), rethrow);
    }
}

Status run(const MachineOptions& options) {
    auto plant = api::plant_file::load_plant_file(options.world_file);
    if (!plant) return fail(plant.error());
    const auto world = simulation::make_world(std::move(*plant), options.seed,
                                              localisation::ErrorBudget::named(options.errors));
    const auto* vehicle = plant::find_vehicle(world.plant, plant::VehicleId(options.vehicle));
    const auto* type =
        vehicle == nullptr ? nullptr : plant::find_vehicle_type(world.plant, vehicle->type);
    if (type == nullptr || plant::find_station(world.plant, vehicle->home) == nullptr) {
        return fail(Errc::kNotFound, "unknown_vehicle",
                    "the plant " + options.world_file + " has no vehicle " + options.vehicle +
                        " with a type and a home station");
    }
    plant::VehicleType loaded = *type;
    loaded.cameras =
        plant::cameras_of(loaded, plant::first_load(world.plant, vehicle->id) != nullptr);
    auto pose = simulation::placed_pose(world, *vehicle, options.seed);
    if (!pose) return fail(pose.error());
    std::optional<TruthLog> truth;
    if (!options.truth_log.empty()) {
        if (const auto last = last_true_pose(options.truth_log, options.vehicle)) *pose = *last;
        auto log = TruthLog::open(options.truth_log);
        if (!log) return fail(log.error());
        truth.emplace(std::move(*log));
    }
    const auto address = parse_machine(options.listen);
    if (!address) return fail(address.error());

    SimulatedController::Settings settings;
    settings.seed = options.seed;
    for (const auto& text : options.faults) {
        auto fault = parse_fault(text);
        if (!fault) return fail(fault.error());
        if (!SimulatedController::has(fault->kind)) {
            return fail(Errc::kInvalid, "bad_fault",
                        "fault \"" + text + "\" is none that a machine over TCP has");
        }
        settings.faults.push_back(std::move(*fault));
    }
    SimulatedController controller(world, *vehicle, loaded, *pose, settings);
    std::optional<PictureFolder> pictures;
    if (!options.pictures.empty()) {
        auto folder = PictureFolder::open(options.pictures, loaded.cameras);
        if (!folder) return fail(folder.error());
        pictures.emplace(std::move(*folder));
    }
    Host host(controller, options.vehicle, std::move(truth), std::move(pictures));
    net::io_context io(1);
    error_code ec;
    const auto ip = net::ip::make_address(address->host, ec);
    tcp::acceptor acceptor(io);
    const auto port = static_cast<unsigned short>(std::strtoul(address->port.c_str(), nullptr, 10));
    if (!ec) acceptor.open(ip.is_v6() ? tcp::v6() : tcp::v4(), ec);
    if (!ec) acceptor.set_option(tcp::acceptor::reuse_address(true), ec);
    if (!ec) acceptor.bind({ip, port}, ec);
    if (!ec) acceptor.listen(net::socket_base::max_listen_connections, ec);
    if (ec) {
        return fail(Errc::kInvalid, "not_listening",
                    "cannot listen on " + options.listen + ": " + ec.message());
    }
    log::info("machine.listening", {{"vehicle", options.vehicle},
                                    {"port", std::to_string(acceptor.local_endpoint().port())}});
    net::signal_set signals(io, SIGINT, SIGTERM);
    signals.async_wait([&io](const error_code&, int) { io.stop(); });
    net::co_spawn(io, accept_all(acceptor, host), rethrow);
    net::co_spawn(io, host.watch(), rethrow);
    io.run();
    return {};
}

}  // namespace

int machine_command(int argc, char** argv) {
    CLI::App app{"The simulated machine of a vehicle, for a vehicle's program over TCP."};
    app.name("pulseline-agent machine");
    MachineOptions options;
    app.add_option("--world", options.world_file, "plant file of the simulated world")->required();
    app.add_option("--vehicle", options.vehicle, "id of the vehicle: TP-01")->required();
    app.add_option("--listen", options.listen, "tcp://ADDRESS:PORT; port 0: one that is free");
    app.add_option("--seed", options.seed, "of all simulated errors");
    app.add_option("--errors", options.errors,
                   "how well the simulated machine and floor are kept: nominal, kind, harsh")
        ->check(CLI::IsMember({"nominal", "kind", "harsh"}));
    app.add_option("--fault", options.faults,
                   std::string("for tests, of what a machine over TCP has: ") + kFaultForms);
    app.add_option("--truth-log", options.truth_log, "file for the true poses (JSON lines)");
    app.add_option("--pictures", options.pictures,
                   "folder for its cameras' pictures, NAME.pgm, for --camera NAME=file:...");
    CLI11_PARSE(app, argc, argv);
    try {
        const auto ran = run(options);
        if (ran) return 0;
        fmt::print(stderr, "pulseline-agent machine: {}\n", ran.error().what);
    } catch (const std::exception& error) {
        fmt::print(stderr, "pulseline-agent machine: {}\n", error.what());
    }
    return 1;
}

}  // namespace pulseline::agent
