#include "core/simulation/machine/drive_heat.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::simulation {
namespace {

constexpr double kHallAir_c = 22;
constexpr double kDriving_k = 18;   // above it at full speed for long
constexpr double kGrinding_k = 90;  // besides, of a wheel whose bearing grinds
constexpr double kTime_s = 600;
constexpr double kGrindingTime_s = 150;  // what grinds is small and close to its thermometer

}  // namespace

DriveHeat::DriveHeat(const plant::VehicleType& type)
    : limits_(type.drive_temperatures), full_mps_(type.max_speed_mps) {
    for (const auto& wheel : type.wheels) drives_.push_back({wheel.name, kHallAir_c, false, false});
}

void DriveHeat::step(double own_s, std::span<const kinematics::WheelMotion> rolling) {
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        Drive& drive = drives_[i];
        const double speed = std::min(1.0, std::abs(rolling[i].speed_mps) / full_mps_);
        const double heat_k = kDriving_k + (drive.grinds ? kGrinding_k : 0);
        const double share = std::min(1.0, own_s / (drive.grinds ? kGrindingTime_s : kTime_s));
        drive.temperature_c += share * (kHallAir_c + heat_k * speed - drive.temperature_c);
        drive.off = drive.temperature_c >= (drive.off ? limits_.warm_c : limits_.hot_c);
    }
}

bool DriveHeat::seize_bearing(const std::string& wheel) {
    const auto found = std::ranges::find(drives_, wheel, &Drive::wheel);
    if (found == drives_.end()) return false;
    found->grinds = true;
    return true;
}

}  // namespace pulseline::simulation
