#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/localisation/igps_light.hpp"

namespace pulseline::localisation {

/// One sheet that passed a receiver: it lies in normal . (X - way - head) + offset = 0, hall frame,
/// |normal| = 1 (Wang, section 2, corrected: the print lost an inverse and mixed T_k into A).
struct LightRow {
    std::size_t transmitter = 0;  // its place among those given
    Eigen::Vector3d normal;
    double constant_m = 0;       // normal . X + constant_m = 0
    double per_rad_m = 0;        // how a radian of its angle moves it, at the receiver
    Eigen::Vector3d per_turn_m;  // and a radian of its transmitter's turn about each axis
    double sigma_m = 0;          // with all that is known of the transmitter
    Eigen::Vector3d gain;        // how its error moves the receiver's place
};

struct ReceiverFix {
    Eigen::Vector3d position;    // hall frame [m]
    Eigen::Matrix3d covariance;  // [m2]
    std::vector<LightRow> rows;  // it rests on
    /// A transmitter that contradicts all others: moved, or seen in a mirror. It is left out.
    std::optional<plant::TransmitterId> refused;
};

/// Weighted least squares over the sheets' planes: X = -(A^T W A)^-1 A^T W b, iterated for the
/// weights, which know the distances. Light of transmitters that are not given is passed over.
/// Fails with
/// - too_few_transmitters {seen}: two at least
/// - poor_geometry {sigma_m, limit_m}: they stand in one line with the receiver
/// - transmitters_disagree {seen}: at least one is wrong, and nobody can tell which
Result<ReceiverFix> locate_receiver(std::span<const LightAngles> light,
                                    std::span<const plant::Transmitter> transmitters);

}  // namespace pulseline::localisation
