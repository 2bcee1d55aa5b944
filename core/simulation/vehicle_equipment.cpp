#include "core/simulation/vehicle_equipment.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/angle.hpp"

namespace pulseline::simulation {
namespace {

constexpr double kBatteryPerMetre = 5e-4;   // per cent
constexpr double kChargePerSecond = 0.028;  // per cent: an hour from empty to full
constexpr double kContact_m = 0.05;
constexpr double kContact_rad = 2 * kPi / 180.0;
constexpr double kFeetDown_m = 0.12;
constexpr double kFeetSpeed_mps = 0.02;
constexpr const char* kFeet[] = {"front left", "front right", "back left", "back right"};

bool meets(const Pose2& charger, const Pose2& vehicle) {
    return geometry::distance(charger.position(), vehicle.position()) <= kContact_m &&
           std::abs(wrap(charger.heading_rad - vehicle.heading_rad)) <= kContact_rad;
}

}  // namespace

VehicleEquipment::VehicleEquipment(const plant::VehicleType& type, std::vector<Pose2> chargers,
                                   double battery_percent, double time_factor)
    : action_types_{"startCharging", "stopCharging"},
      chargers_(std::move(chargers)),
      time_factor_(time_factor),
      battery_percent_(battery_percent),
      has_feet_(!type.brackets.empty()) {
    if (has_feet_) action_types_.insert(action_types_.end(), {"raiseParking", "lowerParking"});
}

bool VehicleEquipment::runs(const std::string& action_type) const {
    return std::find(action_types_.begin(), action_types_.end(), action_type) !=
           action_types_.end();
}

std::optional<std::string> VehicleEquipment::begin(const std::string& action_type,
                                                   const Pose2& true_pose) {
    if (action_type == "stopCharging") {
        charging_ = false;
    } else if (action_type == "startCharging") {
        const bool contact = std::any_of(chargers_.begin(), chargers_.end(),
                                         [&](const Pose2& c) { return meets(c, true_pose); });
        if (!contact) return "noCharger: the contacts of no charger are touched here";
        charging_ = true;
    } else {
        wanted_feet_m_ = action_type == "lowerParking" ? kFeetDown_m : 0;
        moving_feet_ = true;
    }
    return std::nullopt;
}

void VehicleEquipment::step(double dt_s, double way_m) {
    const double charged = charging_ ? kChargePerSecond * time_factor_ * dt_s : 0;
    battery_percent_ =
        std::clamp(battery_percent_ + charged - kBatteryPerMetre * std::abs(way_m), 0.0, 100.0);
    if (!moving_feet_) return;
    const double step_m = kFeetSpeed_mps * time_factor_ * dt_s;
    feet_m_ += std::clamp(wanted_feet_m_ - feet_m_, -step_m, step_m);
    moving_feet_ = feet_m_ != wanted_feet_m_;
}

bool VehicleEquipment::holds_vehicle() const { return charging_ || feet_m_ > 0; }

void VehicleEquipment::write_state(fleet::StateMessage& state) const {
    state.battery_percent = battery_percent_;
    state.charging = charging_;
    state.parking_feet.clear();
    if (!has_feet_) return;
    for (const char* name : kFeet) state.parking_feet.push_back({name, feet_m_});
}

}  // namespace pulseline::simulation
