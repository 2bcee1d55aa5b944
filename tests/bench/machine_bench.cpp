// ./dev bench machine: the cycle of 10 ms between a vehicle's program and its machine over loopback
// (server/agent/MACHINE.md), driving. How far behind its due time each set point has its answer;
// at most 1 ms for 99 of 100.
#include <netinet/in.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <string>
#include <thread>
#include <vector>

#include "api/plant/plant_file.hpp"
#include "server/agent/tcp_machine.hpp"

extern char** environ;

namespace pulseline::agent {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCycles = 2000;
constexpr auto kCycle = std::chrono::milliseconds(10);
constexpr double kMost_ms = 1.0;  // p99
constexpr int kLookCycles = 10;   // as often as its look-out looks while it drives
constexpr const char* kVehicle = "TP-01";

/// One that nobody listens on now.
int free_port() {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(socket, reinterpret_cast<sockaddr*>(&address), size);
    ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
    ::close(socket);
    return ntohs(address.sin_port);
}

/// The simulated machine in a process of its own.
class Process {
public:
    explicit Process(std::vector<std::string> words) {
        std::vector<char*> argv;
        for (auto& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        if (::posix_spawn(&pid_, argv[0], nullptr, nullptr, argv.data(), environ) != 0) pid_ = -1;
    }
    ~Process() {
        if (pid_ < 0) return;
        ::kill(pid_, SIGTERM);
        ::waitpid(pid_, nullptr, 0);
    }

private:
    pid_t pid_ = -1;
};

double at_share(std::vector<double>& sorted, double share) {
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

int run(const std::string& out) {
    const std::string world = PULSELINE_PLANTS "/pulse-line.json";
    const auto plant = api::plant_file::load_plant_file(world);
    if (!plant) return 2;
    const auto* vehicle = plant::find_vehicle(*plant, plant::VehicleId(kVehicle));
    plant::VehicleType type = *plant::find_vehicle_type(*plant, vehicle->type);
    type.cameras = plant::cameras_of(type, plant::first_load(*plant, vehicle->id) != nullptr);
    const std::string port = std::to_string(free_port());
    const Process machine({PULSELINE_AGENT, "machine", "--world", world, "--vehicle", kVehicle,
                           "--listen", "tcp://127.0.0.1:" + port});
    Result<std::unique_ptr<TcpMachine>> opened = nullptr;
    for (int i = 0; i < 100; ++i) {
        opened = TcpMachine::open({"127.0.0.1", port}, type, {1, true, {}});
        if (opened) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));  // until it listens
    }
    if (!opened) {
        std::fprintf(stderr, "%s\n", opened.error().what.c_str());
        return 2;
    }
    auto& drive = (*opened)->drive();
    kinematics::Segment ahead;
    ahead.kind = kinematics::Segment::Kind::kStraight;
    ahead.end = {1000, 0, 0};
    ahead.length_m = 1000;
    drive.append(ahead);
    std::vector<double> behind_ms;
    std::vector<control::Scan> scans;
    auto due = Clock::now();
    for (int i = 0; i < kCycles; ++i) {
        due += kCycle;
        std::this_thread::sleep_until(due);
        drive.step(0.01);
        (*opened)->step(0.01);
        if (i % kLookCycles == 0) (*opened)->scanners()->scan(scans);
        behind_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - due).count());
    }
    if (drive.stop_cause()) {
        std::fprintf(stderr, "the drive has stopped: %s\n", drive.stop_cause()->code.c_str());
        return 1;
    }
    const double p50 = at_share(behind_ms, 0.5), p99 = at_share(behind_ms, 0.99);
    std::printf(
        "cycle of 10 ms over loopback, %d of them: behind its due time p50 %.3f ms, p99 "
        "%.3f ms (at most %.1f), %.3f ms at most\n",
        kCycles, p50, p99, kMost_ms, behind_ms.back());
    if (!out.empty()) {
        if (std::FILE* file = std::fopen(out.c_str(), "w")) {
            std::fprintf(file, "{\"p50_ms\": %.4f, \"p99_ms\": %.4f, \"most_ms\": %.4f}\n", p50,
                         p99, behind_ms.back());
            std::fclose(file);
        }
    }
    return p99 <= kMost_ms ? 0 : 1;
}

}  // namespace
}  // namespace pulseline::agent

int main(int argc, char** argv) {
    const std::string name = "--benchmark_out=";
    std::string out;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word.rfind(name, 0) == 0) out = word.substr(name.size());
    }
    return pulseline::agent::run(out);
}
