#pragma once

#include <span>
#include <vector>

#include "core/localisation/error_budget.hpp"
#include "core/plant/plant.hpp"

/// What one turn of a navigation scanner shows of the reflectors around it. Angles and places are
/// the scanner's: x ahead, counter-clockwise from above.
namespace pulseline::localisation {

/// A ray that came back brighter than from anything but a reflector.
struct BrightEcho {
    double angle_rad = 0;
    double range_m = 0;
    double remission = 0;  // share of what a reflector that fills the ray sends back
    double age_s = 0;      // against now, by the vehicle's clock; > 0: before
};

/// The axis of a reflector as neighbouring rays show it.
struct ReflectorSight {
    double bearing_rad = 0;
    double range_m = 0;
    double sigma_bearing_rad = 0;
    double sigma_range_m = 0;
    double age_s = 0;
    int rays = 0;
};

/// Rays side by side at the same range are one reflector: its bearing is the middle of their
/// brightness, and its face lies before the axis by pi/4 of its radius, on average. What is wider
/// than a reflector can be, metal or two behind each other, is none.
std::vector<ReflectorSight> reflector_sights(std::span<const BrightEcho> echoes,
                                             const plant::NavigationScanner& scanner,
                                             const ReflectorErrors& errors = {});

/// How bright a ray comes back that passes the axis of a reflector at this distance sideways: the
/// share of the beam, a disc that widens with the range, that lies on it.
double remission_at(const plant::NavigationScanner& scanner, double range_m, double beside_m);
/// Half of how wide the beam is there (NAV350 operating instructions, 3.10.3: 20 mm + 5 mrad).
double beam_radius_m(double range_m);
/// Less is not told from bare metal.
inline constexpr double kLeastRemission = 0.2;

}  // namespace pulseline::localisation
