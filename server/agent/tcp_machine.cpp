#include "server/agent/tcp_machine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/gravity.hpp"
#include "core/base/params.hpp"
#include "core/vda5050/actions.hpp"
#include "server/agent/body_status.hpp"

namespace pulseline::agent {
namespace {

using namespace machine;
using kinematics::WheelMotion;
using onboard::Wheels;

constexpr std::string_view kAllParts = "all";

}  // namespace

class TcpMachine::TcpWheels final : public Wheels {
public:
    TcpWheels(MachineController& controller, const plant::VehicleType& type)
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

    MachineController& controller_;
    const plant::VehicleType& type_;
    std::vector<WheelMotion> present_;
    std::vector<WheelMotion> measured_;
};

class TcpMachine::TcpEquipment final : public onboard::Equipment {
public:
    TcpEquipment(MachineController& controller, const plant::VehicleType& type)
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

    MachineController& controller_;
    const plant::VehicleType& type_;
    std::vector<std::string> action_types_;
    std::optional<std::uint32_t> under_way_;
    std::optional<std::string> failure_;
    std::uint32_t lifts_ = 0;
};

class TcpMachine::TcpShutter final : public Shutter {
public:
    TcpShutter(MachineController& controller, const plant::VehicleType& type)
        : controller_(controller), type_(type) {}

    Result<Shutter::Picture> expose(std::size_t camera, Wish) override {
        auto told = controller_.expose(type_.cameras[camera].name);
        if (!told) return fail(told.error());
        const cv::Mat bytes(told->height_px, told->width_px, CV_8UC1, told->grey.data());
        return Shutter::Picture{bytes.clone(), told->age_s};
    }

private:
    MachineController& controller_;
    const plant::VehicleType& type_;
};

class TcpMachine::TcpScanners final : public onboard::Scanners {
public:
    TcpScanners(MachineController& controller, const plant::VehicleType& type)
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
    MachineController& controller_;
    const plant::VehicleType& type_;
};

Result<std::unique_ptr<TcpMachine>> TcpMachine::open(const MachineAddress& address,
                                                     const plant::VehicleType& type,
                                                     Settings settings) {
    std::vector<std::string> own_pictures;
    for (std::size_t i = 0; i < settings.sources.size(); ++i) {
        if (settings.sources[i]) own_pictures.push_back(type.cameras[i].name);
    }
    auto controller =
        std::make_unique<MachineController>(address, type, settings.watchdog_s, own_pictures);
    if (auto reached = controller->reach(); !reached) return fail(reached.error());
    return std::unique_ptr<TcpMachine>(
        new TcpMachine(std::move(controller), type, std::move(settings)));
}

TcpMachine::TcpMachine(std::unique_ptr<MachineController> controller,
                       const plant::VehicleType& type, Settings settings)
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
