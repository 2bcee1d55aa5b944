#include "server/agent/tcp_machine.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

#include "tests/server/agent/machine_rig.hpp"

// A machine behind its controller, over a real socket.
namespace pulseline::agent {
namespace {

using simulation::testing::straight;

/// The controller on a socket, for one program after the other.
class SocketHost {
public:
    explicit SocketHost(SimulatedController& controller) : controller_(controller) { open(); }
    ~SocketHost() { close(); }

    void open() {
        listener_ = ::socket(AF_INET, SOCK_STREAM, 0);
        const int on = 1;
        ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port = htons(port_);
        ASSERT_EQ(::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
        socklen_t size = sizeof address;
        ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
        port_ = ntohs(address.sin_port);
        ::listen(listener_, 4);
        thread_ = std::thread([this] { serve(); });
    }
    /// The machine is gone, with its program's line.
    void close() {
        if (listener_ < 0) return;
        ::shutdown(listener_, SHUT_RDWR);
        {
            const std::lock_guard lock(mutex_);
            if (program_ >= 0) ::shutdown(program_, SHUT_RDWR);
        }
        thread_.join();
        ::close(std::exchange(listener_, -1));
    }
    void fall_silent() { silent_ = true; }
    MachineAddress address() const { return {"127.0.0.1", std::to_string(port_)}; }
    geometry::Pose2 true_pose() {
        const std::lock_guard lock(mutex_);
        return controller_.true_pose();
    }

private:
    void serve() {
        for (;;) {
            const int program = ::accept(listener_, nullptr, nullptr);
            if (program < 0) return;
            {
                const std::lock_guard lock(mutex_);
                program_ = program;
            }
            talk(program);
            const std::lock_guard lock(mutex_);
            controller_.part();
            program_ = -1;
            ::close(program);
        }
    }
    void talk(int program) {
        std::string read;
        char bytes[4096];
        for (ssize_t got; (got = ::recv(program, bytes, sizeof bytes, 0)) > 0;) {
            read.append(bytes, static_cast<std::size_t>(got));
            for (auto size = frame_size(read); size && *size && read.size() >= **size;
                 size = frame_size(read)) {
                const auto frame = decode(std::string_view(read).substr(0, **size));
                read.erase(0, **size);
                if (!frame) return;
                if (silent_) continue;
                std::string answers;
                {
                    const std::lock_guard lock(mutex_);
                    for (const auto& answer : controller_.handle(*frame)) answers += encode(answer);
                }
                for (std::size_t sent = 0; sent < answers.size();) {
                    const auto more =
                        ::send(program, answers.data() + sent, answers.size() - sent, MSG_NOSIGNAL);
                    if (more <= 0) return;
                    sent += static_cast<std::size_t>(more);
                }
            }
        }
    }

    SimulatedController& controller_;
    std::mutex mutex_;
    std::thread thread_;
    std::atomic<bool> silent_ = false;
    int listener_ = -1;
    int program_ = -1;
    std::uint16_t port_ = 0;
};

class TcpMachineTest : public ControllerTest {
protected:
    TcpMachineTest() {
        open(3);  // a test's host lets nobody run every 10 ms
    }
    void open(double watchdog_s) {
        auto opened = TcpMachine::open(host.address(), type, {1, true, world.errors, watchdog_s});
        if (!opened) throw std::runtime_error(opened.error().what);
        machine = std::move(*opened);
    }
    void run(double time_s) {
        for (double t_s = 0; t_s < time_s; t_s += 0.01) {
            machine->drive().step(0.01);
            machine->step(0.01);
        }
    }
    vda5050::StateMessage state() {
        vda5050::StateMessage state;
        machine->write_state(state);
        return state;
    }

    SocketHost host{controller};
    std::unique_ptr<TcpMachine> machine;
};

TEST_F(TcpMachineTest, DrivesByItsOwnReckoningToWhereItWasSent) {
    auto& drive = machine->drive();
    drive.set_believed({20, 10, 0});
    drive.append(straight({20, 10, 0}, 4));
    run(30);
    ASSERT_TRUE(drive.idle());
    EXPECT_FALSE(drive.stop_cause());
    EXPECT_NEAR(drive.believed_pose().x_m, 24, 2e-3);
    EXPECT_NEAR(host.true_pose().x_m, 24, 0.05);
    EXPECT_NEAR(host.true_pose().y_m, 10, 0.05);
    EXPECT_GT(state().wheels[0].temperature_c, 22);
}

TEST_F(TcpMachineTest, LiftsAndTellsWhatItCarries) {
    EXPECT_NEAR(state().load_kg, kLoad_kg, 0.02 * kLoad_kg);
    vda5050::Action up;
    up.type = "setBracketHeight";
    up.params = {{"bracket", std::string("all")}, {"height_m", 0.02}};
    ASSERT_FALSE(machine->equipment().begin(up));
    EXPECT_TRUE(machine->equipment().busy());
    run(10);
    EXPECT_FALSE(machine->equipment().busy());
    EXPECT_FALSE(machine->equipment().failure());
    EXPECT_NEAR(*state().brackets[1].height_m, 0.02, 3e-4);
    vda5050::Action wrong = up;
    wrong.params[0].value = std::string("fifth");
    EXPECT_EQ(machine->equipment().begin(wrong)->rfind("unknown_bracket", 0), 0u);
    up.params[1].value = 0.9;
    ASSERT_FALSE(machine->equipment().begin(up));
    run(0.1);
    ASSERT_TRUE(machine->equipment().failure());
    EXPECT_EQ(machine->equipment().failure()->rfind("out_of_stroke", 0), 0u);
}

TEST_F(TcpMachineTest, ItsPicturesAreReadAndTellWhereItStands) {
    machine->drive().set_believed({20, 10, 0});
    const auto measured = machine->cameras().measure(testing::target_of(world.plant));
    ASSERT_TRUE(measured) << measured.error().what;
    EXPECT_LT(distance(measured->pose.position(), host.true_pose().position()), 2e-3);
    EXPECT_EQ(machine->cameras().pictures().size(), 2u);
}

TEST_F(TcpMachineTest, ItsScannersSeeTheHallAsFreshAsTheyAreAskedForAndNothingWithoutALine) {
    onboard::Scanners* scanners = machine->scanners();
    ASSERT_NE(scanners, nullptr);
    controller.apply_faults(1);
    std::vector<control::Scan> scans;
    const auto hits = [&] {
        std::size_t count = 0;
        for (const auto& scan : scans) {
            count += static_cast<std::size_t>(std::ranges::count_if(
                scan.ranges_m, [](float r) { return control::is_return(r); }));
        }
        return count;
    };
    const auto ranges = [&] {
        std::vector<std::vector<float>> all;
        for (const auto& scan : scans) all.push_back(scan.ranges_m);
        return all;
    };
    scanners->scan(scans);
    ASSERT_EQ(scans.size(), type.scanners.size());
    EXPECT_EQ(scans[0].body_from_sensor, type.scanners[0].body_from_scanner);
    EXPECT_FALSE(scans[0].blind);
    EXPECT_GT(hits(), 10u);
    const auto first = ranges();
    run(0.1);
    scanners->scan(scans);
    EXPECT_NE(ranges(), first) << "another turn, with other noise";
    run(2);  // nobody looks
    scanners->scan(scans);
    const auto late = ranges();
    EXPECT_NE(late, first);

    host.close();
    run(0.1);
    scanners->scan(scans);
    for (const auto& scan : scans) EXPECT_TRUE(scan.blind);
    EXPECT_EQ(hits(), 0u) << "what it saw before is no way to drive by";
    host.open();
    run(2);
    scanners->scan(scans);
    EXPECT_FALSE(scans[0].blind);
}

TEST_F(TcpMachineTest, AControllerThatHearsAndSaysNothingIsLostAfterTheWatchdogsTime) {
    machine.reset();  // it talks with one program
    open(0.3);
    machine->drive().set_believed({20, 10, 0});
    machine->drive().append(straight({20, 10, 0}, 4));
    run(1);
    ASSERT_FALSE(machine->drive().stop_cause());
    host.fall_silent();
    const auto began = std::chrono::steady_clock::now();
    run(0.02);
    EXPECT_GE(std::chrono::steady_clock::now() - began, std::chrono::milliseconds(300));
    ASSERT_TRUE(machine->drive().stop_cause());
    EXPECT_EQ(machine->drive().stop_cause()->code, onboard::stop_causes::kMachineSilent);
}

TEST_F(TcpMachineTest, AControllerThatIsGoneStopsTheDriveUntilAPersonHasLooked) {
    auto& drive = machine->drive();
    drive.set_believed({20, 10, 0});
    drive.append(straight({20, 10, 0}, 12));
    run(8);
    ASSERT_GT(drive.velocity_mps(), 0.1);
    host.close();
    run(1);
    ASSERT_TRUE(drive.standing()) << "or it would be told to drive on as soon as it is back";
    ASSERT_TRUE(drive.stop_cause());
    EXPECT_EQ(drive.stop_cause()->code, onboard::stop_causes::kMachineSilent);
    EXPECT_EQ(state().errors.back().type, "machineSilent");
    EXPECT_TRUE(controller.braked());
    vda5050::Action up;
    up.type = "raiseParking";
    EXPECT_EQ(*machine->equipment().begin(up), "machine_silent");
    drive.acknowledge();
    EXPECT_TRUE(drive.stop_cause()) << "it is still gone";

    host.open();
    const auto stands = host.true_pose();
    run(2);
    EXPECT_TRUE(drive.stop_cause());
    EXPECT_EQ(host.true_pose(), stands) << "nothing moves by itself";
    drive.acknowledge();
    ASSERT_FALSE(drive.stop_cause());
    run(40);
    EXPECT_FALSE(drive.stop_cause());
    EXPECT_NEAR(host.true_pose().x_m, 32, 0.1) << "then it drives on to where it was sent";
}

TEST_F(TcpMachineTest, AMachineOfAnotherTypeIsNotDriven) {
    plant::VehicleType other = type;
    other.cameras[0].name = "seventh";
    machine.reset();
    auto opened = TcpMachine::open(host.address(), other, {});
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().reason.code, "machine_not_of_type");
    EXPECT_NE(opened.error().what.find("seventh"), std::string::npos);
    other = type;
    other.control.drive_gain_per_s = 3;
    opened = TcpMachine::open(host.address(), other, {});
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().reason.code, "machine_refused");
    EXPECT_NE(opened.error().what.find("other_gain"), std::string::npos);
    EXPECT_EQ(TcpMachine::open({"127.0.0.1", "1"}, type, {}).error().reason.code,
              "machine_not_reached");
    for (const char* wrong : {"127.0.0.1:80", "tcp://host", "tcp://:80", "tcp://host:", ""})
        EXPECT_FALSE(parse_machine(wrong)) << wrong;
}

}  // namespace
}  // namespace pulseline::agent
