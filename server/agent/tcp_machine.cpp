#include "server/agent/tcp_machine.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "core/base/gravity.hpp"
#include "core/base/params.hpp"
#include "core/vda5050/actions.hpp"
#include "server/agent/body_status.hpp"
#include "server/base/log.hpp"

namespace pulseline::agent {
namespace {

using namespace machine;
using namespace std::chrono_literals;
using kinematics::WheelMotion;
using onboard::Wheels;

constexpr auto kReach = 2s;
constexpr auto kPictureTime = 2s;  // exposed and carried over
constexpr auto kScanTime = 1s;
constexpr double kAgain_s = 1;               // between two tries to reach it
constexpr std::uint32_t kScanCycles = 4;     // between two turns, while somebody looks at them
constexpr std::uint32_t kFreshCycles = 6;    // older than that a turn is waited for
constexpr std::uint32_t kLookedCycles = 50;  // nobody has looked for so long: no more are asked for
constexpr std::string_view kAllParts = "all";

Status same_names(const char* part, const std::vector<std::string>& told,
                  const std::vector<std::string>& wanted) {
    if (told == wanted) return {};
    const auto list = [](const std::vector<std::string>& names) {
        std::string text;
        for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
        return text;
    };
    return fail(Errc::kConflict, "machine_not_of_type",
                std::string("The machine has other ") + part + " than its type in the plant: " +
                    list(told) + " instead of " + list(wanted) + ".",
                {}, {{"part", part}, {"told", list(told)}, {"wanted", list(wanted)}});
}

template <class Part>
std::vector<std::string> names_of(const std::vector<Part>& parts) {
    std::vector<std::string> names;
    for (const auto& part : parts) names.push_back(part.name);
    return names;
}

std::vector<std::string> feet_of(const plant::VehicleType& type) {
    return type.parking ? names_of(type.parking->feet) : std::vector<std::string>{};
}

/// `pictured`: the cameras that the machine takes pictures of; it may name the others, too.
Status is_of_type(const Description& told, const plant::VehicleType& type,
                  const std::vector<std::string>& pictured) {
    if (auto same = same_names("wheels", told.wheels, names_of(type.wheels)); !same) return same;
    if (auto same = same_names("brackets", told.brackets, names_of(type.brackets)); !same)
        return same;
    if (auto same = same_names("feet", told.feet, feet_of(type)); !same) return same;
    const auto all = names_of(type.cameras);
    const auto& cameras = told.cameras == pictured ? pictured : all;
    if (auto same = same_names("cameras", told.cameras, cameras); !same) return same;
    return same_names("scanners", told.scanners, names_of(type.scanners));
}

}  // namespace

/// The line to the machine with what it has told last, and its coming back.
class TcpMachine::Controller {
public:
    Controller(MachineAddress address, const plant::VehicleType& type, const Settings& settings)
        : address_(std::move(address)),
          type_(type),
          watchdog_s_(settings.watchdog_s),
          pictured_(names_of(type.cameras)) {
        for (std::size_t i = 0; i < settings.sources.size(); ++i) {
            if (settings.sources[i]) std::erase(pictured_, type.cameras[i].name);
        }
    }

    Status reach() {
        auto link = MachineLink::open(address_, kReach);
        if (!link) return fail(link.error());
        Hello hello;
        hello.cycle_s = type_.control.cycle_s;
        hello.watchdog_s = watchdog_s_;
        for (const auto& axis : plant::axes_of(type_)) {
            hello.axes.push_back({axis.name, axis.position_gain_per_s});
        }
        if (auto sent = link->send(hello); !sent) return sent;
        auto answer = link->receive(kReach);
        if (!answer) return fail(answer.error());
        if (const auto* refused = std::get_if<Refused>(&*answer)) {
            return fail(Errc::kConflict, "machine_refused",
                        "The machine refuses: " + refused->why + ".", {}, {{"why", refused->why}});
        }
        const auto* description = std::get_if<Description>(&*answer);
        if (description == nullptr) {
            return fail(Errc::kConflict, "machine_refused", "The machine does not say what it is.",
                        {}, {{"why", "no description"}});
        }
        if (description->version != kVersion) {
            const auto why = "it speaks version " + std::to_string(description->version);
            return fail(Errc::kConflict, "machine_refused", "The machine refuses: " + why + ".", {},
                        {{"why", why}});
        }
        if (auto same = is_of_type(*description, type_, pictured_); !same) return same;
        cameras_ = description->cameras;
        dead_cycles_ = description->dead_cycles;
        link_.emplace(std::move(*link));
        exchange(Mode::kBraked, {});
        return lost() ? fail(Errc::kConflict, "machine_silent", "The machine does not answer.")
                      : Status{};
    }

    /// One cycle. Without an answer in the watchdog's time the line counts as lost.
    void exchange(Mode mode, std::span<const WheelMotion> wanted) {
        ++cycles_;
        if (!link_) return;
        SetPoints points;
        points.cycle = ++number_;
        points.mode = mode;
        for (const auto& wheel : wanted)
            points.wheels.push_back({wheel.speed_mps, wheel.angle_rad});
        if (!say(points)) return;
        // Asked for beforehand, a turn is there when it is looked at, and no cycle waits for it.
        if (looked_at_ && number_ - *looked_at_ < kLookedCycles && number_ % kScanCycles == 0)
            ask_to_look();
        const auto answer_time = std::chrono::duration_cast<MachineLink::Duration>(
            std::chrono::duration<double>(watchdog_s_));
        while (link_) {
            auto frame = hear(answer_time);
            if (!frame) return;
            auto* told = std::get_if<Feedback>(&*frame);
            if (told == nullptr) {
                note(std::move(*frame));
            } else if (told->cycle == number_) {
                return take(std::move(*told));
            }
        }
    }

    bool say(const Frame& frame) {
        if (!link_) return false;
        const auto sent = link_->send(frame);
        if (!sent) lose(sent.error());
        return sent.has_value();
    }

    Result<Picture> expose(const std::string& camera) {
        const std::uint32_t id = ++pictures_;
        const auto number = std::ranges::find(cameras_, camera) - cameras_.begin();
        if (!say(Expose{id, static_cast<std::uint8_t>(number)})) {
            return fail(Errc::kConflict, "machine_silent", "The machine does not answer.");
        }
        for (;;) {
            auto frame = hear(kPictureTime);
            if (!frame) return fail(frame.error());
            auto* picture = std::get_if<Picture>(&*frame);
            if (picture == nullptr) {
                note(std::move(*frame));
            } else if (picture->id == id) {
                return std::move(*picture);
            }
        }
    }

    /// The newest turn of the scanners; nothing: the line is lost.
    const Scans* look() {
        looked_at_ = number_;
        if (scans_ && number_ - scans_at_ <= kFreshCycles) return &*scans_;
        const std::uint32_t id = ask_to_look();
        while (link_) {
            auto frame = hear(kScanTime);
            if (!frame) break;
            note(std::move(*frame));
            if (scans_ && scans_->id == id) return &*scans_;
        }
        return nullptr;
    }

    void try_again(double dt_s) {
        since_try_s_ += dt_s;
        if (link_ || since_try_s_ < kAgain_s) return;
        since_try_s_ = 0;
        if (const auto reached = reach(); !reached) {
            link_.reset();
            return;
        }
        server::log::info("machine.reached", {{"host", address_.host}, {"port", address_.port}});
    }

    bool lost() const { return !link_; }
    const Feedback& told() const { return told_; }
    int dead_cycles() const { return dead_cycles_; }
    std::uint32_t cycle() const { return number_; }
    /// Exchanged since the last call.
    int take_cycles() { return std::exchange(cycles_, 0); }
    std::vector<LiftEnded> take_ended() { return std::exchange(ended_, {}); }

private:
    Result<Frame> hear(MachineLink::Duration timeout) {
        if (!link_) return fail(Errc::kConflict, "machine_silent", "The machine does not answer.");
        auto frame = link_->receive(timeout);
        if (!frame) {
            lose(frame.error());
        } else if (const auto* refused = std::get_if<Refused>(&*frame)) {
            const Error error{Errc::kConflict,
                              {"machine_refused", {{"why", refused->why}}},
                              "The machine refuses: " + refused->why + ".",
                              {}};
            lose(error);
            return fail(error);
        }
        return frame;
    }

    void note(Frame frame) {
        if (auto* ended = std::get_if<LiftEnded>(&frame)) ended_.push_back(std::move(*ended));
        auto* scans = std::get_if<Scans>(&frame);
        if (scans == nullptr) return;
        if (scans->scans.size() != type_.scanners.size()) {
            return lose({Errc::kInvalid,
                         {"machine_frame_broken", {{"why", "scanners are missing"}}},
                         "The machine tells of other scanners than it has.",
                         {}});
        }
        scans_ = std::move(*scans);
        scans_at_ = number_;
    }

    std::uint32_t ask_to_look() {
        say(Look{++looks_});
        return looks_;
    }

    void take(Feedback told) {
        const bool whole = told.wheels.size() == type_.wheels.size() &&
                           told.brackets.size() == type_.brackets.size() &&
                           told.feet.size() == feet_of(type_).size();
        if (whole) {
            told_ = std::move(told);
            return;
        }
        lose({Errc::kInvalid,
              {"machine_frame_broken", {{"why", "parts are missing"}}},
              "The machine tells of other parts than it has.",
              {}});
    }

    void lose(const Error& error) {
        if (!link_) return;
        server::log::error("machine.lost", {{"what", error.what}});
        link_.reset();
        scans_.reset();
        since_try_s_ = 0;
        for (auto& wheel : told_.wheels) wheel.speed_mps = 0;
    }

    MachineAddress address_;
    const plant::VehicleType& type_;
    double watchdog_s_;
    std::vector<std::string> pictured_;  // cameras without a source of their own
    std::vector<std::string> cameras_;   // as it counts them
    std::optional<MachineLink> link_;
    Feedback told_;
    std::vector<LiftEnded> ended_;
    std::uint32_t number_ = 0;
    std::uint32_t pictures_ = 0;
    std::uint32_t looks_ = 0;
    std::optional<Scans> scans_;  // the newest
    std::uint32_t scans_at_ = 0;  // cycle in which they came
    std::optional<std::uint32_t> looked_at_;
    int cycles_ = 0;
    int dead_cycles_ = 0;
    double since_try_s_ = 0;
};

class TcpMachine::TcpWheels final : public Wheels {
public:
    TcpWheels(Controller& controller, const plant::VehicleType& type)
        : controller_(controller), type_(type) {
        take();
    }

    void roll(std::span<const WheelMotion> wanted) override { exchange(Mode::kRoll, wanted); }
    void steer(std::span<const WheelMotion> wanted) override { exchange(Mode::kSteer, wanted); }
    void brake() override { exchange(Mode::kBraked, {}); }

    const std::vector<WheelMotion>& present() const override { return present_; }
    const std::vector<WheelMotion>& measured() const override { return measured_; }
    bool aligned(std::span<const WheelMotion> wanted, double limit_rad) const override {
        for (std::size_t i = 0; i < measured_.size(); ++i) {
            if (!type_.wheels[i].steered) continue;
            if (std::abs(measured_[i].angle_rad - wanted[i].angle_rad) > limit_rad) return false;
        }
        return true;
    }
    bool settled() const override { return controller_.lost() || controller_.told().settled; }
    bool lost() const override { return controller_.lost(); }
    std::optional<std::string> fault() const override {
        return first([](const Feedback::Wheel& wheel) { return !wheel.fault.empty(); });
    }
    std::optional<std::string> lagging() const override {
        return first([](const Feedback::Wheel& wheel) { return wheel.lagging; });
    }
    void switch_off(const std::string& wheel) override {
        const auto found = std::ranges::find(type_.wheels, wheel, &plant::Wheel::name);
        if (found == type_.wheels.end()) return;
        controller_.say(SwitchOff{static_cast<std::uint8_t>(found - type_.wheels.begin())});
    }
    std::optional<double> slip_share() const override { return controller_.told().slip_share; }
    int dead_cycles() const override { return controller_.dead_cycles(); }

private:
    void exchange(Mode mode, std::span<const WheelMotion> wanted) {
        controller_.exchange(mode, wanted);
        take();
    }

    void take() {
        present_.clear();
        measured_.clear();
        for (const auto& wheel : controller_.told().wheels) {
            present_.push_back({wheel.steered_to_rad, 0});
            measured_.push_back({wheel.angle_rad, wheel.speed_mps});
        }
    }

    template <class Is>
    std::optional<std::string> first(Is is) const {
        const auto& wheels = controller_.told().wheels;
        for (std::size_t i = 0; i < wheels.size(); ++i) {
            if (is(wheels[i])) return type_.wheels[i].name;
        }
        return std::nullopt;
    }

    Controller& controller_;
    const plant::VehicleType& type_;
    std::vector<WheelMotion> present_;
    std::vector<WheelMotion> measured_;
};

class TcpMachine::TcpEquipment final : public onboard::Equipment {
public:
    TcpEquipment(Controller& controller, const plant::VehicleType& type)
        : controller_(controller),
          type_(type),
          action_types_{vda5050::kStartCharging, vda5050::kStopCharging} {
        if (!type.brackets.empty()) action_types_.emplace_back(vda5050::kSetBracketHeight);
        if (type.parking) {
            action_types_.insert(action_types_.end(),
                                 {vda5050::kRaiseParking, vda5050::kLowerParking});
        }
    }

    const std::vector<std::string>& action_types() const override { return action_types_; }

    std::optional<std::string> begin(const vda5050::Action& action) override {
        failure_.reset();
        if (controller_.lost()) return "machine_silent";
        Lift lift;
        lift.id = ++lifts_;
        if (auto why_not = describe(action, lift)) return why_not;
        if (!controller_.say(lift)) return "machine_silent";
        under_way_ = lift.id;
        return std::nullopt;
    }
    bool busy() const override { return under_way_.has_value(); }
    std::optional<std::string> failure() const override { return failure_; }
    void abort() override { controller_.say(StopLifts{}); }
    bool holds_vehicle() const override {
        const auto& told = controller_.told();
        return told.charging || told.moving_lifts || busy() ||
               std::ranges::any_of(
                   told.feet, [](const auto& f) { return f.extension_m > plant::kFootDown_m; });
    }

    std::vector<vda5050::BracketStatus> brackets() override {
        std::vector<vda5050::BracketStatus> told;
        for (std::size_t i = 0; i < controller_.told().brackets.size(); ++i) {
            const auto& bracket = controller_.told().brackets[i];
            told.push_back(
                {type_.brackets[i].name, bracket.force_a_n, bracket.force_b_n, bracket.height_m});
        }
        return told;
    }

    void take_ended() {
        for (auto& ended : controller_.take_ended()) {
            if (under_way_ != ended.id) continue;
            under_way_.reset();
            if (ended.outcome != LiftEnded::Outcome::kDone) failure_ = std::move(ended.why);
        }
        // Its watchdog holds what lifts.
        if (controller_.lost() && under_way_) {
            under_way_.reset();
            failure_ = "machine_silent";
        }
    }

private:
    /// Why not.
    std::optional<std::string> describe(const vda5050::Action& action, Lift& lift) const {
        if (action.type == vda5050::kSetBracketHeight) {
            const auto height_m = number_param(action.params, "height_m");
            if (!height_m) return "bad_parameters: setBracketHeight needs bracket and height_m";
            lift.what = Lift::What::kBracketHeight;
            lift.height_m = *height_m;
            lift.speed_mps = number_param(action.params, "speed_mps");
            return choose(action, "bracket", names_of(type_.brackets), lift);
        }
        if (action.type == vda5050::kLowerParking || action.type == vda5050::kRaiseParking) {
            lift.what = action.type == vda5050::kLowerParking ? Lift::What::kLowerFeet
                                                              : Lift::What::kRaiseFeet;
            return choose(action, "foot", feet_of(type_), lift);
        }
        lift.what = action.type == vda5050::kStartCharging ? Lift::What::kStartCharging
                                                           : Lift::What::kStopCharging;
        return std::nullopt;
    }

    static std::optional<std::string> choose(const vda5050::Action& action, const char* part,
                                             const std::vector<std::string>& names, Lift& lift) {
        const auto* name = text_param(action.params, part);
        if (name == nullptr || *name == kAllParts) return std::nullopt;
        const auto found = std::ranges::find(names, *name);
        if (found == names.end()) return std::string("unknown_") + part + ": there is no " + *name;
        lift.one = static_cast<std::uint8_t>(found - names.begin());
        return std::nullopt;
    }

    Controller& controller_;
    const plant::VehicleType& type_;
    std::vector<std::string> action_types_;
    std::optional<std::uint32_t> under_way_;
    std::optional<std::string> failure_;
    std::uint32_t lifts_ = 0;
};

class TcpMachine::TcpShutter final : public Shutter {
public:
    TcpShutter(Controller& controller, const plant::VehicleType& type)
        : controller_(controller), type_(type) {}

    Result<Shutter::Picture> expose(std::size_t camera, Wish) override {
        auto told = controller_.expose(type_.cameras[camera].name);
        if (!told) return fail(told.error());
        const cv::Mat bytes(told->height_px, told->width_px, CV_8UC1, told->grey.data());
        return Shutter::Picture{bytes.clone(), told->age_s};
    }

private:
    Controller& controller_;
    const plant::VehicleType& type_;
};

class TcpMachine::TcpScanners final : public onboard::Scanners {
public:
    TcpScanners(Controller& controller, const plant::VehicleType& type)
        : controller_(controller), type_(type) {}

    /// Without a line they are blind: it must not drive on what they saw before.
    void scan(std::vector<control::Scan>& scans) override {
        const Scans* told = controller_.look();
        scans.resize(type_.scanners.size());
        for (std::size_t i = 0; i < scans.size(); ++i) {
            scans[i].body_from_sensor = type_.scanners[i].body_from_scanner;
            scans[i].blind = told == nullptr || told->scans[i].blind;
            scans[i].ranges_m.clear();
            if (told == nullptr) continue;
            scans[i].first_rad = told->scans[i].first_rad;
            scans[i].step_rad = told->scans[i].step_rad;
            scans[i].ranges_m = told->scans[i].ranges_m;
        }
    }

private:
    Controller& controller_;
    const plant::VehicleType& type_;
};

Result<std::unique_ptr<TcpMachine>> TcpMachine::open(const MachineAddress& address,
                                                     const plant::VehicleType& type,
                                                     Settings settings) {
    auto controller = std::make_unique<Controller>(address, type, settings);
    if (auto reached = controller->reach(); !reached) return fail(reached.error());
    return std::unique_ptr<TcpMachine>(
        new TcpMachine(std::move(controller), type, std::move(settings)));
}

TcpMachine::TcpMachine(std::unique_ptr<Controller> controller, const plant::VehicleType& type,
                       Settings settings)
    : type_(type),
      controller_(std::move(controller)),
      wheels_(std::make_unique<TcpWheels>(*controller_, type)),
      equipment_(std::make_unique<TcpEquipment>(*controller_, type)),
      own_shutter_(std::make_unique<TcpShutter>(*controller_, type)),
      // It waits for pictures standing. What lifts meanwhile would stop if the machine heard
      // nothing.
      shutter_(type, std::move(settings.sources), *own_shutter_,
               [this] {
                   if (drive_.braked()) controller_->exchange(Mode::kBraked, {});
               }),
      scanners_(type.scanners.empty() ? nullptr
                                      : std::make_unique<TcpScanners>(*controller_, type)),
      drive_(type, *wheels_, geometry::Pose2{}, settings.time_factor),
      cameras_(type, drive_, shutter_, settings.errors, settings.loaded) {}

TcpMachine::~TcpMachine() = default;

onboard::Drive& TcpMachine::drive() { return drive_; }
Cameras& TcpMachine::cameras() { return cameras_; }
onboard::Equipment& TcpMachine::equipment() { return *equipment_; }
onboard::Scanners* TcpMachine::scanners() { return scanners_.get(); }

std::uint32_t TcpMachine::cycle() const { return controller_->cycle(); }

/// A drive that has exchanged nothing stands with its brakes on; what lifts goes on by cycles all
/// the same. Between the set points of one that moves, brakes would fall in.
void TcpMachine::step(double dt_s) {
    controller_->try_again(dt_s);
    if (controller_->take_cycles() == 0 && drive_.braked()) {
        const auto due = std::lround(dt_s * drive_.time_factor() / type_.control.cycle_s);
        for (long left = std::max(1L, due); left > 0; --left) {
            controller_->exchange(Mode::kBraked, {});
        }
        controller_->take_cycles();
    }
    equipment_->take_ended();
}

void TcpMachine::write_state(vda5050::StateMessage& state) {
    const Feedback& told = controller_->told();
    for (std::size_t i = 0; i < told.wheels.size(); ++i) {
        const auto& wheel = told.wheels[i];
        state.wheels.push_back({type_.wheels[i].name, wheel.angle_rad,
                                std::abs(wheel.speed_mps) * drive_.time_factor(),
                                wheel.temperature_c, wheel.fault});
    }
    state.battery_percent = told.battery_percent;
    state.charging = told.charging;
    state.e_stop = told.stopped ? "AUTOACK" : "NONE";
    state.brackets = equipment_->brackets();
    double load_n = 0;
    for (const auto& bracket : state.brackets) load_n += bracket.force_a_n + bracket.force_b_n;
    state.load_kg = load_n / kGravity_mps2;
    for (std::size_t i = 0; i < told.feet.size(); ++i) {
        state.parking_feet.push_back(
            {type_.parking->feet[i].name, told.feet[i].extension_m, told.feet[i].force_n});
    }
    write_wheel_faults(type_, state);
    write_stop(drive_, state);
}

}  // namespace pulseline::agent
