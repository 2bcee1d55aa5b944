#include "core/fleet/vehicle/state_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/fleet/state/fields.hpp"
#include "core/fleet/vehicle/readiness.hpp"

namespace pulseline::fleet {
namespace {

// Far below what moves a vehicle's floor (2 cm) or its place at a station (25 cm).
constexpr double kStill_m = 0.002;
constexpr double kStill_rad = 0.0005;
// Of the bracket's force: the limit of their balance is a tenth.
constexpr double kForceShare = 0.005;
constexpr double kForce_n = 20;
constexpr double kLift_m = 0.001;  // of feet and brackets
constexpr double kBattery_percent = 0.5;
constexpr double kLoad_kg = 0.5;

bool near(double a, double b, double within) { return std::abs(a - b) <= within; }

bool both_near(const std::optional<double>& a, const std::optional<double>& b, double within) {
    return a && b && near(*a, *b, within);
}

bool same_force(double a, double b) {
    return near(a, b, kForce_n + kForceShare * std::max(std::abs(a), std::abs(b)));
}

bool same_pose(const Pose2& a, const Pose2& b) {
    return geometry::distance(a.position(), b.position()) <= kStill_m &&
           std::abs(wrap(a.heading_rad - b.heading_rad)) <= kStill_rad;
}

/// Makes equal what is the same but for noise, so that the rest can be compared as it is.
void quiet(const vda5050::StateMessage& known, vda5050::StateMessage& next) {
    next.header_id = known.header_id;
    next.timestamp = known.timestamp;
    next.velocity_mps = known.velocity_mps;
    next.turn_rate_radps = known.turn_rate_radps;
    next.localization_score = known.localization_score;
    if (is_vague(known) == is_vague(next)) next.deviation_range_m = known.deviation_range_m;
    next.navigation = known.navigation;
    const bool both = known.pose && next.pose;
    if (both && (next.driving || same_pose(*known.pose, *next.pose))) {
        next.pose = known.pose;
        next.distance_since_last_node_m = known.distance_since_last_node_m;
    }
    if (near(known.battery_percent, next.battery_percent, kBattery_percent)) {
        next.battery_percent = known.battery_percent;
    }
    if (near(known.load_kg, next.load_kg, kLoad_kg)) next.load_kg = known.load_kg;
    const auto pairs = [](auto& from, auto& to, auto make_equal) {
        for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) {
            make_equal(from[i], to[i]);
        }
    };
    pairs(known.brackets, next.brackets,
          [](const vda5050::BracketStatus& from, vda5050::BracketStatus& to) {
              if (same_force(from.force_a_n, to.force_a_n)) to.force_a_n = from.force_a_n;
              if (same_force(from.force_b_n, to.force_b_n)) to.force_b_n = from.force_b_n;
              if (both_near(from.height_m, to.height_m, kLift_m)) to.height_m = from.height_m;
          });
    pairs(known.wheels, next.wheels,
          [](const vda5050::WheelStatus& from, vda5050::WheelStatus& to) {
              to.steering_rad = from.steering_rad;
              to.speed_mps = from.speed_mps;
              to.temperature_c = from.temperature_c;
          });
    pairs(known.parking_feet, next.parking_feet,
          [](const vda5050::ParkingFoot& from, vda5050::ParkingFoot& to) {
              if (near(from.extension_m, to.extension_m, kLift_m))
                  to.extension_m = from.extension_m;
              const bool told = from.force_n && to.force_n;
              if (told && same_force(*from.force_n, *to.force_n)) to.force_n = from.force_n;
          });
    // A vehicle that has lost its pose is told it from what its cameras and receivers see.
    if (!next.position_initialized) return;
    pairs(known.cameras, next.cameras,
          [](const vda5050::CameraReading& from, vda5050::CameraReading& to) {
              to.code = from.code;
              to.angle_rad = from.angle_rad;
              to.sigma_m = from.sigma_m;
              to.rms_px = from.rms_px;
              to.why_not = from.why_not;
          });
    pairs(known.receivers, next.receivers,
          [](const vda5050::ReceiverReading& from, vda5050::ReceiverReading& to) { to = from; });
}

}  // namespace

Duration seen_every(const vda5050::StateMessage& state) {
    return state.driving ? kDrivingEvery : kStandingEvery;
}

Duration to_next_beat(Duration now, Duration every, std::size_t number) {
    const auto length = static_cast<std::size_t>(every.count());
    const Duration own{static_cast<Duration::rep>(number % length)};
    return every - (now + own) % every;
}

bool may_change_decision(const vda5050::StateMessage& known, const vda5050::StateMessage& next) {
    vda5050::StateMessage quieted = next;
    quiet(known, quieted);
    journal::Writer a;
    journal::Writer b;
    a.put(known);
    b.put(quieted);
    return a.bytes() != b.bytes();
}

}  // namespace pulseline::fleet
