#include "server/agent/body_status.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace pulseline::agent {
namespace {

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

vda5050::VehicleError wheel_fault(const std::string& wheel, const std::string& what) {
    return {"wheelFault", false, "the drive of wheel " + wheel + " " + what, {{"wheel", wheel}}};
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
    const bool told = std::ranges::any_of(
        state.wheels, [&](const auto& w) { return w.name == wheel && !w.fault.empty(); });
    if (!told) state.errors.push_back(wheel_fault(wheel, "has a fault"));
}

void write_wheel_faults(const plant::VehicleType& type, vda5050::StateMessage& state) {
    for (const auto& wheel : state.wheels) {
        if (wheel.fault.empty()) continue;
        const auto whole = [](double c) { return std::to_string(std::lround(c)); };
        state.errors.push_back(wheel_fault(
            wheel.name, wheel.fault == kTooHot ? "is too hot, " + whole(wheel.temperature_c) +
                                                     " degrees; it goes again below " +
                                                     whole(type.drive_temperatures.warm_c)
                                               : "has a fault"));
    }
}

BodyStatus::BodyStatus(const onboard::Drive& motion) : motion_(motion), heat_(motion.type()) {
    for (const auto& wheel : motion.type().wheels) wheels_.push_back({wheel.name, 0, 0, 0, ""});
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
    rolling_ = wheel_motions();
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
        wheels_[i].steering_rad = rolling_[i].angle_rad;
        wheels_[i].speed_mps = std::abs(rolling_[i].speed_mps);
        rolling_[i].speed_mps /= motion_.time_factor();
    }
    heat_.step(dt_s * motion_.time_factor(), rolling_);
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
        wheels_[i].temperature_c = heat_.temperature_c(i);
        wheels_[i].fault = "";
        if (wheels_[i].name == faulty_wheel()) wheels_[i].fault = kDriveFault;
        if (wheels_[i].name == broken_wheel_) wheels_[i].fault = "steering_drive_fault";
        if (heat_.is_off(i)) wheels_[i].fault = kTooHot;
    }
}

void BodyStatus::write_state(vda5050::StateMessage& state) const {
    state.wheels = wheels_;
    write_wheel_faults(motion_.type(), state);
    write_stop(motion_, state);
}

}  // namespace pulseline::agent
