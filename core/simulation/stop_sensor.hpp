#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "core/fleet/vehicle_messages.hpp"
#include "core/simulation/camera_model.hpp"

namespace pulseline::simulation {

/// kRendered makes real images and reads them; kAnalytic draws the reader's measured error.
enum class Sensing { kRendered, kAnalytic };

/// What a vehicle knows of the floor below it: each camera expects the code next to its foot.
struct KnownFloor {
    Pose2 hall_from_body;      // as odometry has it
    std::vector<Pose2> codes;  // surveyed, hall frame
};

struct SensingOptions {
    Sensing mode = Sensing::kRendered;
    /// One sigma of the cameras' mounting and scale, part of every reading's sigma_m.
    double calibration_sigma_m = 0.0001;
    /// What the vehicle's cameras look for.
    plant::MarkerKind kind = plant::MarkerKind::kQr;
    double code_size_m = 0.060;
    std::optional<KnownFloor> known = {};
    bool dark = false;  // no light below the vehicle
};

struct StopView {
    std::vector<fleet::CameraReading> readings;  // one per camera, in their order
    std::vector<cv::Mat> images;                 // 8-bit grey, one per camera; none when analytic
};

/// What the cameras of a vehicle standing at the true pose see of the true codes. `actual` cameras
/// make the images, `calibrated` ones (what the vehicle believes; same order and size) interpret
/// them. Light, dirt and noise are nominal, drawn from `random`.
StopView sense_stop(std::span<const plant::Camera> actual,
                    std::span<const plant::Camera> calibrated, const Pose2& hall_from_body,
                    std::span<const FloorCode> codes, const SensingOptions& options,
                    std::mt19937_64& random);

/// Where a reading has its code; nothing when it found none.
std::optional<Pose2> body_from_code(const fleet::CameraReading& reading);

/// The reading of one camera as the vehicle reports it, in the body frame.
fleet::CameraReading camera_reading(const plant::Camera& calibrated,
                                    const vision::MarkerReading& reading,
                                    double calibration_sigma_m);

}  // namespace pulseline::simulation
