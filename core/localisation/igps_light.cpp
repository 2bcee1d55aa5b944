#include "core/localisation/igps_light.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/angle.hpp"
#include "core/localisation/line_of_sight.hpp"

namespace pulseline::localisation {
namespace {

constexpr double kTurn_rad = 2 * kPi;

double within_turn(double angle_rad) {
    const double left_rad = std::fmod(angle_rad, kTurn_rad);
    return left_rad < 0 ? left_rad + kTurn_rad : left_rad;
}

/// The head's angle at which a sheet passes the point, given in its frame. A whole plane would pass
/// it twice; `side` says on which side of (a, b) it shines, +1: to the left. Nothing where its
/// lean never reaches the point.
std::optional<double> passing_rad(const plant::LightPlane& sheet, const Eigen::Vector3d& point,
                                  double side) {
    const double reach_m = std::hypot(point.x(), point.y()) * std::hypot(sheet.a, sheet.b);
    const double share = -(point.z() + sheet.offset_m) / reach_m;
    if (!(std::abs(share) <= 1)) return std::nullopt;
    const double azimuth_rad = std::atan2(point.y(), point.x());
    const double normal_rad = std::atan2(sheet.b, sheet.a);
    return within_turn(azimuth_rad - normal_rad - side * std::acos(share));
}

}  // namespace

Result<LightAngles> feature_angles(const LightPulses& pulses) {
    const double turn_s = pulses.next_zero_s - pulses.zero_s;
    const double first = (pulses.first_s - pulses.zero_s) / turn_s;
    const double second = (pulses.second_s - pulses.zero_s) / turn_s;
    const auto in_turn = [](double share) { return share >= 0 && share <= 1; };
    if (!(turn_s > 0 && std::isfinite(turn_s)) || !in_turn(first) || !in_turn(second)) {
        return fail(Errc::kInvalid, "bad_pulses",
                    "The light of transmitter " + pulses.transmitter.str() +
                        " was not seen between the two zero pulses of one turn; send the pulses of "
                        "one turn.",
                    {}, {{"transmitter", pulses.transmitter.str()}});
    }
    return LightAngles{pulses.transmitter, kTurn_rad * first, kTurn_rad * second, {}, {}};
}

Eigen::Matrix3d hall_from_head(const plant::Transmitter& transmitter) {
    using Axis = Eigen::AngleAxisd;
    return (Axis(transmitter.heading_rad, Eigen::Vector3d::UnitZ()) *
            Axis(transmitter.pitch_rad, Eigen::Vector3d::UnitY()) *
            Axis(transmitter.roll_rad, Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
}

std::optional<LightAngles> light_on(const plant::Transmitter& transmitter,
                                    const Eigen::Vector3d& point) {
    const Eigen::Vector3d head(transmitter.position.x_m, transmitter.position.y_m, transmitter.z_m);
    const Eigen::Vector3d seen = hall_from_head(transmitter).transpose() * (point - head);
    const double level_m = std::hypot(seen.x(), seen.y());
    if (!(level_m > 0) || seen.norm() > transmitter.range_m) return std::nullopt;
    if (std::abs(std::atan2(seen.z(), level_m)) > transmitter.elevation_rad) return std::nullopt;
    const auto first_rad = passing_rad(transmitter.first, seen, 1);
    const auto second_rad = passing_rad(transmitter.second, seen, -1);
    if (!first_rad || !second_rad) return std::nullopt;
    return LightAngles{transmitter.id, *first_rad, *second_rad, {}, {}};
}

std::vector<plant::Transmitter> transmitters_in_view(const plant::Plant& plant,
                                                     const plant::HallId& hall,
                                                     const Eigen::Vector3d& point) {
    std::vector<plant::Transmitter> seen;
    for (const auto& transmitter : plant.transmitters) {
        if (transmitter.hall != hall || !light_on(transmitter, point)) continue;
        if (in_sight(plant, hall, transmitter.position, {point.x(), point.y()}))
            seen.push_back(transmitter);
    }
    return seen;
}

}  // namespace pulseline::localisation
