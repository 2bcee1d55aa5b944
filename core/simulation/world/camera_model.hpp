#pragma once

#include <optional>
#include <random>
#include <span>

#include "core/simulation/world/floor_camera.hpp"
#include "core/vision/marker_reading.hpp"

namespace pulseline::simulation {

/// Errors of vision::read_qr as bench_vision measures them on nominal images; taken for every kind.
struct ReadingErrors {
    double sigma_px = 0.0016;  // centre, per axis
    double sigma_angle_rad = 9e-6;
    double rms_px = 0.035;
    double inlier_share = 0.97;
};

/// The code nearest to the middle of what `camera` sees with all its modules in view, read with
/// the measured error instead of an image; nothing when no code is wholly in view.
std::optional<vision::MarkerReading> analytic_reading(const plant::Camera& camera,
                                                      const Pose2& hall_from_body,
                                                      std::span<const FloorCode> codes,
                                                      std::mt19937_64& random,
                                                      const ReadingErrors& errors = {});

}  // namespace pulseline::simulation
