#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <random>
#include <string>
#include <thread>

#include "server/agent/simulated_controller.hpp"
#include "server/agent/tcp_machine.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/plant/loads.hpp"
#include "tests/server/agent/small_hall.hpp"

// The controller of a machine and its protocol: frames in, frames out, and over a real socket.
namespace pulseline::agent {
namespace {

using namespace machine;
using simulation::testing::straight;

constexpr double kLoad_kg = 18000;

plant::Plant hall() {
    plant::Plant plant = testing::small_plant();
    auto& type = plant.vehicle_types[0];
    const auto whole = pulseline::testing::platform();
    type.kinematics = whole.kinematics;
    type.wheels = whole.wheels;
    type.brackets = whole.brackets;
    type.parking = whole.parking;
    type.scanners = plant::usual_scanners(type.footprint);
    type.mass_kg = whole.mass_kg;
    type.max_load_kg = whole.max_load_kg;
    plant::builders::put_on(plant, 0, "A-101", kLoad_kg);
    return plant;
}

/// Somebody puts a box 7 m ahead of the middle of the vehicle.
Fault box_after(double time_s) {
    Fault box;
    box.kind = Fault::Kind::kObstacle;
    box.place = {27, 10};
    box.after_s = time_s;
    return box;
}

class ControllerTest : public ::testing::Test {
protected:
    std::string refusal(const Frame& frame) {
        const auto answers = controller.handle(frame);
        const auto* refused = answers.empty() ? nullptr : std::get_if<Refused>(&answers.back());
        return refused ? refused->why.substr(0, refused->why.find(':')) : "";
    }
    Hello hello() const {
        Hello hello;
        for (const auto& axis : plant::axes_of(type)) {
            hello.axes.push_back({axis.name, axis.position_gain_per_s});
        }
        return hello;
    }
    SetPoints points(Mode mode, double speed_mps = 0) {
        SetPoints points;
        points.cycle = ++cycle;
        points.mode = mode;
        if (mode != Mode::kBraked) points.wheels.assign(type.wheels.size(), {speed_mps, 0});
        return points;
    }
    Feedback feedback(const SetPoints& points) {
        const auto answers = controller.handle(points);
        return std::get<Feedback>(answers.back());
    }

    simulation::World world = simulation::make_world(hall(), 1);
    const plant::VehicleType& type = world.plant.vehicle_types[0];
    SimulatedController controller{
        world, world.plant.vehicles[0], type, {20, 10, 0}, {1, {}, false, {box_after(1)}}};
    std::uint32_t cycle = 0;
};

TEST_F(ControllerTest, WantsToKnowWhoItIsAndSaysWhatItHas) {
    EXPECT_EQ(refusal(points(Mode::kBraked)), "hello_first");
    EXPECT_EQ(refusal(Hello{kVersion + 1, 0.01, 0.1, {}}), "unknown_version");
    auto other = hello();
    other.cycle_s = 0.02;
    EXPECT_EQ(refusal(other), "unknown_cycle");
    other = hello();
    other.axes.pop_back();
    EXPECT_EQ(refusal(other), "wrong_axes");
    other = hello();
    other.axes[3].name = "fifth/steering";
    EXPECT_EQ(refusal(other), "unknown_axis");
    other = hello();
    other.axes[0].position_gain_per_s = 4;
    EXPECT_EQ(refusal(other), "other_gain");
    const auto answers = controller.handle(hello());
    const auto& told = std::get<Description>(answers.at(0));
    ASSERT_EQ(told.wheels.size(), type.wheels.size());
    EXPECT_EQ(told.wheels[0], type.wheels[0].name);
    EXPECT_EQ(told.brackets.size(), 4u);
    EXPECT_EQ(told.feet.size(), 4u);
    EXPECT_EQ(told.cameras, (std::vector<std::string>{"front", "back"}));
}

/// A program that says anything at any time.
class AnyProgram {
public:
    AnyProgram(std::uint64_t seed, Hello hello, std::size_t wheels)
        : random_(seed), hello_(std::move(hello)), wheels_(wheels) {}

    Frame next() {
        switch (pick(30)) {
            case 0:
                return hello_;
            case 1:
                return Lift{number(), Lift::What(pick(5)), part(), anything(), speed()};
            case 2:
                return Lift{number(), Lift::What::kBracketHeight, part(), 0.05, {}};
            case 3:
                return pick(3) == 0 ? Frame(StopLifts{}) : Frame(Look{number()});
            case 4:
                return SwitchOff{static_cast<std::uint8_t>(pick(8))};
            case 5:
                return pick(60) == 0 ? Frame(Expose{number(), static_cast<std::uint8_t>(pick(3))})
                                     : Frame(Look{number()});
            case 6:
                return pick(10) == 0 ? Frame(Feedback{}) : points();
            default:
                return points();
        }
    }

private:
    std::uint32_t pick(std::uint32_t below) {
        return static_cast<std::uint32_t>(random_() % below);
    }
    std::uint32_t number() { return static_cast<std::uint32_t>(random_()); }
    std::optional<std::uint8_t> part() {
        return pick(3) == 0 ? std::nullopt : std::optional(static_cast<std::uint8_t>(pick(6)));
    }
    std::optional<double> speed() {
        return pick(2) == 0 ? std::nullopt : std::optional(anything());
    }
    double anything() {
        constexpr double kValues[] = {0, -1, 0.1, -0.3, 1e-9, 3, 1e6, -1e6, 1e300};
        return kValues[pick(9)];
    }
    Frame points() {
        SetPoints points;
        points.cycle = number();
        points.mode = Mode(pick(3));
        const std::size_t count = points.mode == Mode::kBraked ? 0 : wheels_;
        points.wheels.resize(pick(50) == 0 ? pick(9) : count);
        const double mps = pick(20) == 0 ? anything() : 0.3;
        for (auto& wheel : points.wheels) wheel = {mps, pick(20) == 0 ? anything() : 0};
        return points;
    }

    std::mt19937_64 random_;
    Hello hello_;
    std::size_t wheels_;
};

TEST_F(ControllerTest, WhateverAProgramSaysIsAnsweredOnceAndItStaysWhole) {
    int driven = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        AnyProgram program(seed, hello(), type.wheels.size());
        for (int i = 0; i < 2000; ++i) {
            const Frame frame = program.next();
            const auto answers = controller.handle(frame);
            const auto count = [&](auto is) { return std::ranges::count_if(answers, is); };
            const auto refused =
                count([](const Frame& f) { return f.index() == Frame(Refused{}).index(); });
            ASSERT_LE(refused, 1);
            if (const auto* points = std::get_if<SetPoints>(&frame); points && refused == 0) {
                ASSERT_EQ(count([&](const Frame& f) {
                              const auto* told = std::get_if<Feedback>(&f);
                              return told != nullptr && told->cycle == points->cycle;
                          }),
                          1);
            }
            for (const Frame& answer : answers) {
                ASSERT_TRUE(decode(encode(answer))) << "seed " << seed << ", frame " << i;
            }
            driven += controller.braked() ? 0 : 1;
            if (refused == 1) controller.part();
            if (i % 97 == 0) controller.wait(0.2);
            const auto& pose = controller.true_pose();
            ASSERT_TRUE(std::isfinite(pose.x_m + pose.y_m + pose.heading_rad))
                << "seed " << seed << ", frame " << i;
        }
        controller.part();
        EXPECT_TRUE(controller.braked());
    }
    EXPECT_GT(driven, 2000) << "else it was hardly talked with";
}

TEST_F(ControllerTest, DrivesWhatItIsToldAndBrakesWhenNobodyTells) {
    controller.handle(hello());
    for (int i = 0; i < 300; ++i) feedback(points(Mode::kRoll, 0.3));
    EXPECT_GT(controller.true_pose().x_m, 20.3);
    EXPECT_FALSE(controller.braked());
    controller.wait(0.05);
    EXPECT_FALSE(controller.braked());
    controller.wait(0.06);
    EXPECT_TRUE(controller.braked());
    const auto stands = controller.true_pose();
    const auto told = feedback(points(Mode::kBraked));
    EXPECT_EQ(told.cycle, cycle);
    EXPECT_EQ(told.wheels[0].speed_mps, 0);
    EXPECT_EQ(controller.true_pose(), stands);
}

TEST_F(ControllerTest, ShowsWhatItsScannersSeeAndWhatStandsInItsWay) {
    controller.handle(hello());
    const auto before = std::get<Scans>(controller.handle(Look{1}).at(0));
    controller.apply_faults(0.5);
    const auto early = std::get<Scans>(controller.handle(Look{2}).at(0));
    controller.apply_faults(0.6);
    const auto late = std::get<Scans>(controller.handle(Look{3}).at(0));
    const auto returns_near = [](const Scans& told) {
        std::size_t count = 0;
        for (const auto& scan : told.scans) {
            count += static_cast<std::size_t>(std::ranges::count_if(
                scan.ranges_m, [](float range_m) { return range_m > 0 && range_m < 2.5F; }));
        }
        return count;
    };
    EXPECT_EQ(late.id, 3u);
    EXPECT_EQ(late.scans.size(), type.scanners.size());
    EXPECT_EQ(returns_near(early), returns_near(before)) << "not yet";
    EXPECT_GT(returns_near(late), returns_near(before) + 10);
}

TEST_F(ControllerTest, AWheelWhoseBearingGrindsGetsTooHotAndItsDriveIsOffUntilItHasCooled) {
    Fault grinds;
    grinds.kind = Fault::Kind::kBearing;
    grinds.part = "front drive";
    SimulatedController grinding{
        world, world.plant.vehicles[0], type, {20, 10, 0}, {1, {}, false, {grinds}}};
    ASSERT_TRUE(SimulatedController::has(grinds.kind));
    grinding.apply_faults(0);
    grinding.handle(hello());
    const auto told = [&](Mode mode, double speed_mps) {
        return std::get<Feedback>(grinding.handle(points(mode, speed_mps)).back()).wheels[4];
    };
    Feedback::Wheel wheel;
    const double step_mps = type.max_accel_mps2 * type.control.cycle_s;
    for (int i = 0; i < 60'000 && wheel.fault.empty(); ++i) {
        wheel = told(Mode::kRoll, std::min(type.max_speed_mps, i * step_mps));
    }
    EXPECT_EQ(wheel.fault, "servo_overtemperature");
    EXPECT_GE(wheel.temperature_c, type.drive_temperatures.hot_c);
    for (int i = 0; i < 60'000 && !wheel.fault.empty(); ++i) wheel = told(Mode::kBraked, 0);
    EXPECT_EQ(wheel.fault, "");
    EXPECT_LT(wheel.temperature_c, type.drive_temperatures.warm_c);
}

TEST_F(ControllerTest, SetPointsForOtherWheelsThanItHasMoveNothing) {
    controller.handle(hello());
    auto wrong = points(Mode::kRoll, 0.3);
    wrong.wheels.pop_back();
    EXPECT_EQ(refusal(wrong), "wrong_wheels");
    EXPECT_EQ(controller.true_pose(), (geometry::Pose2{20, 10, 0}));
    EXPECT_EQ(refusal(SwitchOff{99}), "unknown_wheel");
    EXPECT_EQ(refusal(Expose{1, 9}), "unknown_camera");
    EXPECT_EQ(refusal(Refused{"me"}), "not_for_a_machine");
}

TEST_F(ControllerTest, LiftsOneThingAtATimeAndHoldsItWhenNobodyTells) {
    controller.handle(hello());
    const auto ended = [&](const Frame& frame) {
        const auto answers = controller.handle(frame);
        return answers.empty() ? std::nullopt : std::optional(std::get<LiftEnded>(answers.front()));
    };
    const auto until_ended = [&]() -> std::optional<LiftEnded> {
        for (int i = 0; i < 3000; ++i) {
            const auto answers = controller.handle(points(Mode::kBraked));
            if (answers.size() > 1) return std::get<LiftEnded>(answers.front());
        }
        return std::nullopt;
    };
    EXPECT_FALSE(ended(Lift{1, Lift::What::kBracketHeight, {}, 0.02, {}}));
    const auto second = ended(Lift{2, Lift::What::kLowerFeet, {}, 0, {}});
    ASSERT_TRUE(second);
    EXPECT_EQ(second->outcome, LiftEnded::Outcome::kRefused);
    EXPECT_EQ(second->why, "lifts_moving");
    const auto first = until_ended();
    ASSERT_TRUE(first);
    EXPECT_EQ(*first, (LiftEnded{1, LiftEnded::Outcome::kDone, {}}));
    EXPECT_NEAR(feedback(points(Mode::kBraked)).brackets[2].height_m, 0.02, 3e-4);

    EXPECT_EQ(ended(Lift{3, Lift::What::kBracketHeight, {}, 0.5, {}})->outcome,
              LiftEnded::Outcome::kRefused);
    EXPECT_EQ(ended(Lift{4, Lift::What::kRaiseFeet, 7, 0, {}})->outcome,
              LiftEnded::Outcome::kRefused);
    EXPECT_FALSE(ended(Lift{5, Lift::What::kBracketHeight, {}, 0.1, {}}));
    for (int i = 0; i < 100; ++i) feedback(points(Mode::kBraked));
    controller.wait(0.2);
    const auto held = until_ended();
    ASSERT_TRUE(held);
    EXPECT_LT(feedback(points(Mode::kBraked)).brackets[0].height_m, 0.08);
}

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
