#include "server/agent/body_status.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace pulseline::agent {
namespace {

constexpr double kAmbient_c = 22;
constexpr double kHeat_c = 18;        // above ambient at full speed for long
constexpr double kSeizedHeat_c = 90;  // besides, of a wheel whose bearing grinds
constexpr double kHeatTime_s = 600;

std::string text_of(const Param& param) {
    if (const auto* text = std::get_if<std::string>(&param.value)) return *text;
    const auto* number = std::get_if<double>(&param.value);
    return number == nullptr ? "" : std::to_string(*number);
}

/// A drive that has stopped of itself, as an error: it needs a person.
vda5050::VehicleError stopped_error(const Reason& cause) {
    vda5050::VehicleError error;
    error.fatal = true;
    if (cause.code == onboard::stop_causes::kMachineSilent) {
        error.type = "machineSilent";
        error.description = "the controller of its machine does not answer; its brakes are on";
    } else if (cause.code == onboard::stop_causes::kSlip) {
        error.type = "wheelSlip";
        error.description =
            "wheels and floor differ by the share " + text_of(cause.params.at(0)) + " of the speed";
    } else {
        error.type = "offPath";
        error.description = "the vehicle is " + text_of(cause.params.at(0)) + " m off its path";
    }
    for (const Param& param : cause.params)
        error.references.emplace_back(param.name, text_of(param));
    return error;
}

}  // namespace

void write_stop(const onboard::Drive& drive, vda5050::StateMessage& state) {
    const auto cause = drive.stop_cause();
    if (!cause) return;
    if (cause->code != onboard::stop_causes::kWheelFault) {
        state.errors.push_back(stopped_error(*cause));
        return;
    }
    const std::string wheel = text_of(cause->params.at(0));
    state.errors.push_back(
        {"wheelFault", false, "the drive of wheel " + wheel + " has a fault", {{"wheel", wheel}}});
}

BodyStatus::BodyStatus(const onboard::Drive& motion) : motion_(motion) {
    for (const auto& wheel : motion.type().wheels) {
        wheels_.push_back({wheel.name, 0, 0, kAmbient_c, ""});
    }
}

bool BodyStatus::seize_bearing(const std::string& name) {
    const bool known =
        std::ranges::find(wheels_, name, &vda5050::WheelStatus::name) != wheels_.end();
    if (known) hot_wheel_ = name;
    return known;
}

/// As the drive tells; one without a model of its wheels has those of its twist.
std::vector<kinematics::WheelMotion> BodyStatus::wheel_motions() const {
    auto told = motion_.wheels();
    if (!told.empty()) return told;
    const auto wheels = kinematics::wheels_of(motion_.type(), motion_.twist(), rolling_);
    return wheels ? *wheels : std::vector<kinematics::WheelMotion>(wheels_.size());
}

/// The wheel that the drive itself has found at fault; empty: none.
std::string BodyStatus::faulty_wheel() const {
    const auto cause = motion_.stop_cause();
    return cause && cause->code == onboard::stop_causes::kWheelFault ? text_of(cause->params.at(0))
                                                                     : "";
}

void BodyStatus::step(double dt_s) {
    const double full_mps = motion_.type().max_speed_mps * motion_.time_factor();
    rolling_ = wheel_motions();
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
        const double speed = std::abs(rolling_[i].speed_mps);
        wheels_[i].steering_rad = rolling_[i].angle_rad;
        wheels_[i].speed_mps = speed;
        const double heat_c = kHeat_c + (wheels_[i].name == hot_wheel_ ? kSeizedHeat_c : 0);
        const double target_c = kAmbient_c + heat_c * std::min(1.0, speed / full_mps);
        const double share = std::min(1.0, dt_s * motion_.time_factor() / kHeatTime_s);
        wheels_[i].temperature_c += share * (target_c - wheels_[i].temperature_c);
        wheels_[i].fault = "";
        if (wheels_[i].name == faulty_wheel()) wheels_[i].fault = "drive_fault";
        if (wheels_[i].name == broken_wheel_) wheels_[i].fault = "steering_drive_fault";
    }
}

void BodyStatus::write_state(vda5050::StateMessage& state) const {
    state.wheels = wheels_;
    const std::string at_fault = broken_wheel_.empty() ? faulty_wheel() : broken_wheel_;
    if (!at_fault.empty()) {
        state.errors.push_back({"wheelFault",
                                false,
                                "the drive of wheel " + at_fault + " has a fault",
                                {{"wheel", at_fault}}});
    }
    const auto cause = motion_.stop_cause();
    if (cause && cause->code != onboard::stop_causes::kWheelFault)
        state.errors.push_back(stopped_error(*cause));
}

}  // namespace pulseline::agent
