#pragma once

#include "api/vda5050/header.hpp"
#include "core/vda5050/messages.hpp"

/// Motion primitives as edges (guide section 8). Angles: heading = tangent of the way +
/// orientation, so moving to the vehicle's left is orientation -pi/2.
namespace pulseline::vda5050 {

/// Adds orientation, trajectory and so on of a segment to an edge.
void encode_motion(Json& edge, const kinematics::Segment& segment);
/// The segment an edge between two nodes means. Without a trajectory: a turn on the spot when the
/// nodes share their place, else straight on.
kinematics::Segment decode_motion(json::ObjectReader& edge, const OrderNode& from,
                                  const OrderNode& to);

}  // namespace pulseline::vda5050
