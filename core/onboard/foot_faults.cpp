#include "core/onboard/foot_faults.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/gravity.hpp"

namespace pulseline::onboard {
namespace {

constexpr double kTouches_n = 1000;  // less is a foot that stands on nothing
constexpr double kCarried = 0.25;    // of the vehicle's own weight: the feet hold it up

std::string whole(double number) { return std::to_string(std::lround(number)); }

}  // namespace

std::vector<vda5050::VehicleError> foot_faults(const plant::VehicleType& type,
                                               const std::vector<vda5050::ParkingFoot>& feet) {
    if (!type.parking || feet.empty()) return {};
    double carried_n = 0;
    for (const auto& foot : feet) {
        if (foot.extension_m <= plant::kFootDown_m || !foot.force_n) return {};
        carried_n += *foot.force_n;
    }
    if (carried_n < kCarried * type.mass_kg * kGravity_mps2) return {};
    std::vector<vda5050::VehicleError> faults;
    for (const auto& foot : feet) {
        const double force_n = *foot.force_n;
        if (force_n > type.parking->rating_n) {
            faults.push_back({"footOverloaded",
                              false,
                              "Foot " + foot.name + " bears " + whole(force_n) + " N of " +
                                  whole(type.parking->rating_n) + " N.",
                              {{"foot", foot.name}, {"force_n", whole(force_n)}}});
        } else if (force_n < kTouches_n) {
            faults.push_back({"footLostContact",
                              false,
                              "Foot " + foot.name + " stands on nothing any more.",
                              {{"foot", foot.name}, {"force_n", whole(force_n)}}});
        }
    }
    return faults;
}

}  // namespace pulseline::onboard
