#include "api/vda5050/pose.hpp"

#include <cmath>

#include "api/vda5050/limits.hpp"
#include "core/base/angle.hpp"

namespace pulseline::vda5050 {

Json encode_position(const geometry::Pose2& pose, bool initialized, const std::string& map_id) {
    return {{"x", finite(pose.x_m)},
            {"y", finite(pose.y_m)},
            {"theta", wrap(finite(pose.heading_rad))},
            {"mapId", map_id},
            {"positionInitialized", initialized}};
}

geometry::Pose2 decode_position(json::ObjectReader& position) {
    return {position.number("x", limits::kPlace_m), position.number("y", limits::kPlace_m),
            wrap(position.number("theta", limits::kAngle_rad))};
}

Json encode_velocity(double velocity_mps, double turn_rate_radps) {
    return {{"vx", finite(velocity_mps)}, {"vy", 0.0}, {"omega", finite(turn_rate_radps)}};
}

Velocity decode_velocity(json::ObjectReader& message) {
    auto velocity = message.object_if_any("velocity");
    if (!velocity) return {};
    const double vx = velocity->number_or("vx", 0, limits::kVelocity_mps);
    const double vy = velocity->number_or("vy", 0, limits::kVelocity_mps);
    const double speed = std::hypot(vx, vy);
    return {vx < 0 ? -speed : speed, velocity->number_or("omega", 0, limits::kTurnRate_radps)};
}

}  // namespace pulseline::vda5050
