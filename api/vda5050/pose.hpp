#pragma once

#include "api/vda5050/header.hpp"
#include "core/geometry/pose2.hpp"

/// Parts that state and visualization share.
namespace pulseline::vda5050 {

Json encode_position(const geometry::Pose2& pose, bool initialized, const std::string& map_id);
geometry::Pose2 decode_position(json::ObjectReader& position);

/// `velocity_mps` negative backwards; sideways motion is told as its amount along x.
Json encode_velocity(double velocity_mps, double turn_rate_radps);
struct Velocity {
    double velocity_mps = 0;
    double turn_rate_radps = 0;
};
Velocity decode_velocity(json::ObjectReader& message);

}  // namespace pulseline::vda5050
