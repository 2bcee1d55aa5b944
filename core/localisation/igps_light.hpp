#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.hpp"
#include "core/plant/plant.hpp"

/// The light of iGPS transmitters at a receiver (Wang, section 2): what is seen of it, and where it
/// is seen at all. Angles are those of the head since its zero pulse, counter-clockwise from above.
namespace pulseline::localisation {

using geometry::Point2;

/// What a receiver saw of one turn of one transmitter, by the receiver's own clock. Which one it
/// was, the time of its turn tells.
struct LightPulses {
    plant::TransmitterId transmitter;
    double zero_s = 0;       // the pulse that begins the turn
    double next_zero_s = 0;  // and the one that ends it
    double first_s = 0;      // its first sheet passes
    double second_s = 0;
};

/// The feature angles of one turn.
struct LightAngles {
    plant::TransmitterId transmitter;
    double first_rad = 0;
    double second_rad = 0;
    /// The receiver's way since each sheet's passing, hall frame; it has driven on meanwhile.
    Point2 way_first;
    Point2 way_second;
};

/// theta = 2 pi (t_p - t_z) / (t_z+1 - t_z); the print lacks the full turn. Fails with bad_pulses
/// when they do not lie in one turn.
Result<LightAngles> feature_angles(const LightPulses& pulses);

/// Turns the head's frame into the hall's.
Eigen::Matrix3d hall_from_head(const plant::Transmitter& transmitter);

/// The angles at which its sheets pass a point of the hall; nothing where it does not shine: too
/// far, or too high or low. What stands in between is not looked at.
std::optional<LightAngles> light_on(const plant::Transmitter& transmitter,
                                    const Eigen::Vector3d& point);

/// Of the hall's transmitters those whose light falls on the point.
std::vector<plant::Transmitter> transmitters_in_view(const plant::Plant& plant,
                                                     const plant::HallId& hall,
                                                     const Eigen::Vector3d& point);

}  // namespace pulseline::localisation
