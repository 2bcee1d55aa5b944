#include <algorithm>
#include <cmath>

#include "core/base/gravity.hpp"
#include "core/geometry/convex.hpp"
#include "core/plant/validate_parts.hpp"

namespace pulseline::plant::detail {
namespace {

/// Checks the numbers of one element.
class Numbers {
public:
    Numbers(std::string element, Faults& faults) : element_(std::move(element)), faults_(faults) {}

    bool finite(const char* field, double value) {
        if (std::isfinite(value)) return true;
        faults_.add(element_ + field, "not_finite", "The value is no finite number.",
                    "Write a number.");
        return false;
    }
    void positive(const char* field, double value) {
        if (!finite(field, value) || value > 0) return;
        faults_.add(element_ + field, "not_positive", "The value must be greater than 0.",
                    "Write the real one.");
    }
    void not_negative(const char* field, double value) {
        if (!finite(field, value) || value >= 0) return;
        faults_.add(element_ + field, "negative", "The value must not be negative.",
                    "Write 0 or more.");
    }
    void point(const std::string& field, Point2 p) {
        finite((field + "/x_m").c_str(), p.x_m);
        finite((field + "/y_m").c_str(), p.y_m);
    }
    void pose(const std::string& field, const Pose2& p) {
        point(field, p.position());
        finite((field + "/heading_rad").c_str(), p.heading_rad);
    }
    void fault(const char* field, const char* code, const char* what, const char* remedy) {
        faults_.add(element_ + field, code, what, remedy);
    }

private:
    std::string element_;
    Faults& faults_;
};

void check_camera(const Camera& c, Numbers n) {
    n.pose("/body_from_camera", c.body_from_camera);
    n.positive("/height_m", c.height_m);
    n.positive("/f_px", c.f_px);
    n.positive("/width_px", c.width_px);
    n.positive("/height_px", c.height_px);
    n.finite("/cu_px", c.cu_px);
    n.finite("/cv_px", c.cv_px);
    n.finite("/k1", c.k1);
    n.positive("/frame_rate_hz", c.frame_rate_hz);
    n.positive("/exposure_s", c.exposure_s);
    if (!c.loaded) return;
    n.pose("/loaded/body_from_camera", c.loaded->body_from_camera);
    n.positive("/loaded/height_m", c.loaded->height_m);
}

constexpr double kLeastStep_rad = 0.01 * kPi / 180;
constexpr double kMostStep_rad = 5 * kPi / 180;

void check_step(double step_rad, Numbers n) {
    if (n.finite("/step_rad", step_rad) &&
        (step_rad < kLeastStep_rad || step_rad > kMostStep_rad)) {
        n.fault("/step_rad", "scanner_step", "No laser scanner has such a step between its rays.",
                "Write the step of its data sheet, between 0.01 and 5 degrees.");
    }
}

void check_scanner(const LaserScanner& s, Numbers n) {
    n.pose("/pose", s.body_from_scanner);
    n.positive("/field_rad", s.field_rad);
    if (s.field_rad >= 2 * kPi) {
        n.fault("/field_rad", "scanner_field", "Its field of view is a full turn or more.",
                "Write the field of its data sheet, below 2 pi.");
    }
    check_step(s.step_rad, n);
    n.not_negative("/least_range_m", s.least_range_m);
    if (n.finite("/range_m", s.range_m) && s.range_m <= s.least_range_m) {
        n.fault("/range_m", "scanner_range", "It ends before the least range.",
                "Make range_m greater than least_range_m.");
    }
    n.not_negative("/sigma_m", s.sigma_m);
    n.not_negative("/most_error_m", s.most_error_m);
}

void check_navigation_scanner(const NavigationScanner& s, Numbers n) {
    n.pose("/pose", s.body_from_scanner);
    n.positive("/z_m", s.z_m);
    n.positive("/rate_hz", s.rate_hz);
    n.positive("/range_m", s.range_m);
    n.positive("/reflector_radius_m", s.reflector_radius_m);
    n.positive("/sigma_range_m", s.sigma_range_m);
    n.positive("/sigma_bearing_rad", s.sigma_bearing_rad);
    check_step(s.step_rad, n);
}

void check_parking(const VehicleType& t, const std::string& element, Faults& faults) {
    const ParkingGear& parking = *t.parking;
    Numbers n(element, faults);
    n.positive("/stroke_m", parking.stroke_m);
    n.not_negative("/clearance_m", parking.clearance_m);
    n.positive("/lift_m", parking.lift_m);
    n.positive("/speed_mps", parking.speed_mps);
    n.positive("/rating_n", parking.rating_n);
    if (parking.clearance_m + parking.lift_m > parking.stroke_m) {
        n.fault("/stroke_m", "stroke_too_short", "The feet end before they have raised it.",
                "Make stroke_m more than clearance_m and lift_m together.");
    }
    std::vector<Point2> places;
    for (std::size_t i = 0; i < parking.feet.size(); ++i) {
        Numbers(element + "/feet/" + std::to_string(i), faults)
            .point("/position", parking.feet[i].position);
        places.push_back(parking.feet[i].position);
    }
    if (places.size() < 3 || !geometry::contains(geometry::convex_hull(places), {0, 0})) {
        n.fault("/feet", "feet_do_not_hold", "On these feet the vehicle would tip.",
                "List three at least, round its middle.");
    }
    const double even_n = (t.mass_kg + t.max_load_kg) * kGravity_mps2 /
                          static_cast<double>(std::max<std::size_t>(1, places.size()));
    if (std::isfinite(parking.rating_n) && parking.rating_n < even_n) {
        n.fault("/rating_n", "feet_too_weak", "Its largest load is more than they may carry.",
                "Write the rating of one foot in newtons, or correct the masses.");
    }
}

// A position loop with two cycles of dead time swings from twice this on.
constexpr double kMostGainPerCycle = 0.25;
constexpr double kLeastCycle_s = 0.001;
constexpr double kMostCycle_s = 0.05;
constexpr double kRounding_s = 1e-9;

void check_control(const AxisControl& control, Numbers n) {
    const double cycle_s = control.cycle_s;
    if (!n.finite("/cycle_s", cycle_s)) return;
    const double whole_s = std::round(cycle_s / kLeastCycle_s) * kLeastCycle_s;
    if (cycle_s < kLeastCycle_s - kRounding_s || cycle_s > kMostCycle_s + kRounding_s ||
        std::abs(cycle_s - whole_s) > kRounding_s) {
        n.fault("/cycle_s", "cycle", "No controller takes set points in such a cycle.",
                "Write whole milliseconds, from 0.001 to 0.05 s.");
        return;
    }
    const auto gain = [&](const char* field, double gain_per_s) {
        n.positive(field, gain_per_s);
        if (std::isfinite(gain_per_s) && gain_per_s * cycle_s > kMostGainPerCycle) {
            n.fault(field, "gain_too_high", "With such a gain the axis swings at its cycle.",
                    "Keep the gain times the cycle at 0.25 or below.");
        }
    };
    gain("/drive_gain_per_s", control.drive_gain_per_s);
    gain("/steering_gain_per_s", control.steering_gain_per_s);
    gain("/lift_gain_per_s", control.lift_gain_per_s);
}

void check_temperatures(const DriveTemperatures& limits, Numbers n) {
    if (!n.finite("/warm_c", limits.warm_c) || !n.finite("/hot_c", limits.hot_c)) return;
    if (limits.warm_c > 0 && limits.hot_c > limits.warm_c) return;
    n.fault("/hot_c", "temperature_limits", "The temperatures of the drives are not in order.",
            "Give 0 < warm_c < hot_c, in degrees Celsius.");
}

void check_type(const VehicleType& t, const std::string& element, Faults& faults) {
    Numbers n(element, faults);
    n.positive("/max_speed_mps", t.max_speed_mps);
    n.positive("/max_accel_mps2", t.max_accel_mps2);
    n.positive("/max_turn_rate_radps", t.max_turn_rate_radps);
    n.positive("/max_turn_accel_radps2", t.max_turn_accel_radps2);
    n.positive("/max_steering_rate_radps", t.max_steering_rate_radps);
    n.not_negative("/min_turn_radius_m", t.min_turn_radius_m);
    n.positive("/max_arc_radius_m", t.max_arc_radius_m);
    n.not_negative("/clearance_m", t.clearance_m);
    n.positive("/height_m", t.height_m);
    n.positive("/usual_code/size_m", t.usual_code.size_m);
    if (t.slip_sensor) n.positive("/slip_sensor/noise_mps", t.slip_sensor->noise_mps);
    n.not_negative("/mass_kg", t.mass_kg);
    n.not_negative("/max_load_kg", t.max_load_kg);
    n.not_negative("/load_rules/bracket_rating_n", t.load_rules.bracket_rating_n);
    n.positive("/load_rules/most_unbalance", t.load_rules.most_unbalance);
    n.positive("/bracket_lift/stroke_m", t.bracket_lift.stroke_m);
    n.positive("/bracket_lift/speed_mps", t.bracket_lift.speed_mps);
    n.not_negative("/battery/critical_percent", t.battery.critical_percent);
    n.finite("/battery/low_percent", t.battery.low_percent);
    n.finite("/battery/enough_percent", t.battery.enough_percent);
    if (t.battery.critical_percent > t.battery.low_percent ||
        t.battery.low_percent >= t.battery.enough_percent || t.battery.enough_percent > 100) {
        n.fault("/battery", "battery_limits", "The battery's limits are not in order.",
                "Give critical_percent <= low_percent < enough_percent <= 100.");
    }
    if (t.max_arc_radius_m <= t.min_turn_radius_m) {
        n.fault("/max_arc_radius_m", "arc_radii", "No arc lies between least and largest radius.",
                "Make max_arc_radius_m greater than min_turn_radius_m.");
    }
    for (std::size_t i = 0; i < t.wheels.size(); ++i) {
        Numbers wheel(element + "/wheels/" + std::to_string(i), faults);
        wheel.point("/position", t.wheels[i].position);
        wheel.positive("/diameter_m", t.wheels[i].diameter_m);
    }
    for (std::size_t i = 0; i < t.casters.size(); ++i) {
        Numbers caster(element + "/casters/" + std::to_string(i), faults);
        caster.point("/position", t.casters[i].position);
        caster.positive("/diameter_m", t.casters[i].diameter_m);
    }
    check_control(t.control, {element + "/control", faults});
    check_temperatures(t.drive_temperatures, {element + "/drive_temperatures", faults});
    for (std::size_t i = 0; i < t.cameras.size(); ++i) {
        check_camera(t.cameras[i], {element + "/cameras/" + std::to_string(i), faults});
    }
    for (std::size_t i = 0; i < t.receivers.size(); ++i) {
        Numbers receiver(element + "/receivers/" + std::to_string(i), faults);
        receiver.point("/position", t.receivers[i].position);
        receiver.positive("/z_m", t.receivers[i].z_m);
    }
    for (std::size_t i = 0; i < t.scanners.size(); ++i) {
        check_scanner(t.scanners[i], {element + "/scanners/" + std::to_string(i), faults});
    }
    if (t.navigation_scanner) {
        check_navigation_scanner(*t.navigation_scanner, {element + "/navigation_scanner", faults});
    }
    if (t.parking) check_parking(t, element + "/parking", faults);
    for (std::size_t i = 0; i < t.brackets.size(); ++i) {
        Numbers(element + "/brackets/" + std::to_string(i), faults)
            .point("/position", t.brackets[i].position);
    }
}

void check_light_plane(const LightPlane& plane, Numbers n) {
    n.finite("/a", plane.a);
    n.finite("/b", plane.b);
    n.finite("/offset_m", plane.offset_m);
    if (plane.a == 0 && plane.b == 0) {
        n.fault("", "no_light_plane", "With a and b both 0 the sheet lies level and passes nobody.",
                "Write the values of its calibration.");
    }
}

void check_transmitter(const Transmitter& t, const std::string& element, Faults& faults) {
    Numbers n(element, faults);
    n.point("/position", t.position);
    n.positive("/z_m", t.z_m);
    n.finite("/roll_rad", t.roll_rad);
    n.finite("/pitch_rad", t.pitch_rad);
    n.finite("/heading_rad", t.heading_rad);
    n.positive("/rate_hz", t.rate_hz);
    check_light_plane(t.first, {element + "/first", faults});
    check_light_plane(t.second, {element + "/second", faults});
    n.positive("/range_m", t.range_m);
    n.positive("/elevation_rad", t.elevation_rad);
    if (std::isfinite(t.elevation_rad) && t.elevation_rad >= kPi / 2) {
        n.fault("/elevation_rad", "elevation_too_steep", "The light would shine past straight up.",
                "Write less than a quarter turn.");
    }
    n.positive("/sigma_rad", t.sigma_rad);
    n.positive("/sigma_place_m", t.sigma_place_m);
    n.positive("/sigma_turn_rad", t.sigma_turn_rad);
}

void check_grid(const OccupancyGrid& grid, Numbers n) {
    if (grid.empty()) return;
    n.positive("", grid.resolution_m);
    n.point("", grid.origin);
    if (grid.width <= 0 || grid.height <= 0 ||
        grid.occupied.size() !=
            static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height)) {
        n.fault("", "grid_size", "The grid does not have width x height cells.",
                "Load it again from its image.");
    }
}

void check_routing(const RoutingCost& r, Numbers n) {
    n.positive("/k_same", r.k_same);
    n.positive("/reference_step_m", r.reference_step_m);
    n.not_negative("/turn_threshold_rad", r.turn_threshold_rad);
    n.not_negative("/accuracy_k", r.accuracy_k);
    if (n.finite("/k_diff", r.k_diff) && r.k_diff < r.k_same) {
        n.fault("/k_diff", "turns_cheaper", "A change of direction would be cheaper than none.",
                "Make k_diff at least k_same.");
    }
}

}  // namespace

void check_load_numbers(const Load& load, const std::string& element, Faults& faults) {
    Numbers n(element, faults);
    n.not_negative("/mass_kg", load.mass_kg);
    n.point("/centre", load.centre);
}

void check_numbers(const Plant& plant, Faults& faults) {
    for (std::size_t i = 0; i < plant.halls.size(); ++i) {
        check_grid(plant.halls[i].grid, {at("halls", i, "/occupancy_yaml"), faults});
    }
    for (std::size_t i = 0; i < plant.stations.size(); ++i) {
        const Station& s = plant.stations[i];
        Numbers n(at("stations", i), faults);
        n.pose("/pose", s.pose);
        n.positive("/tolerance/dx_m", s.tolerance.dx_m);
        n.positive("/tolerance/dy_m", s.tolerance.dy_m);
        n.positive("/tolerance/dheading_rad", s.tolerance.dheading_rad);
        n.not_negative("/number", s.number);
        if (s.support) n.not_negative("/support/height_m", s.support->height_m);
    }
    for (std::size_t i = 0; i < plant.markers.size(); ++i) {
        const Marker& m = plant.markers[i];
        Numbers n(at("markers", i), faults);
        n.pose("/pose", m.pose);
        n.positive("/size_m", m.size_m);
        n.positive("/sigma_xy_m", m.sigma_xy_m);
        n.positive("/sigma_heading_rad", m.sigma_heading_rad);
    }
    for (std::size_t i = 0; i < plant.transmitters.size(); ++i) {
        check_transmitter(plant.transmitters[i], at("transmitters", i), faults);
    }
    for (std::size_t i = 0; i < plant.reflectors.size(); ++i) {
        Numbers n(at("reflectors", i), faults);
        n.point("/position", plant.reflectors[i].position);
        n.positive("/sigma_m", plant.reflectors[i].sigma_m);
    }
    for (std::size_t i = 0; i < plant.vehicle_types.size(); ++i) {
        check_type(plant.vehicle_types[i], at("vehicle_types", i), faults);
    }
    for (std::size_t i = 0; i < plant.loads.size(); ++i) {
        check_load_numbers(plant.loads[i], at("loads", i), faults);
    }
    for (std::size_t i = 0; i < plant.nodes.size(); ++i) {
        Numbers(at("roadmap/nodes", i), faults).point("/position", plant.nodes[i].position);
    }
    for (std::size_t i = 0; i < plant.edges.size(); ++i) {
        Numbers n(at("roadmap/edges", i), faults);
        n.not_negative("/max_speed_mps", plant.edges[i].max_speed_mps);
        if (!plant.edges[i].corridor) continue;
        n.positive("/corridor/left_m", plant.edges[i].corridor->left_m);
        n.positive("/corridor/right_m", plant.edges[i].corridor->right_m);
    }
    check_routing(plant.routing, {"/routing", faults});
}

}  // namespace pulseline::plant::detail
