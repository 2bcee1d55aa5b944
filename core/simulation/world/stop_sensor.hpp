#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "core/localisation/error_budget.hpp"
#include "core/simulation/world/camera_model.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::simulation {

/// kRendered makes real images and reads them; kAnalytic draws the reader's measured error.
enum class Sensing { kRendered, kAnalytic };

/// A code as the survey has it.
struct KnownCode {
    Pose2 pose;  // hall frame
    plant::UsualCode look;
};

/// What a vehicle knows of the floor below it: each camera expects the code next to its foot.
struct KnownFloor {
    Pose2 hall_from_body;  // as odometry has it
    std::vector<KnownCode> codes;
};

struct SensingOptions {
    Sensing mode = Sensing::kRendered;
    /// From which a reading's sigma_m is computed.
    localisation::ErrorBudget errors = {};
    bool loaded = false;
    /// What the vehicle's cameras look for where nothing is known of the floor.
    plant::UsualCode look = {};
    std::optional<KnownFloor> known = {};
    bool dark = false;  // no light below the vehicle
    /// Way of the camera over the floor during the exposure, in its frame: it smears the picture.
    geometry::Point2 smear_m = {};
};

struct StopView {
    std::vector<vda5050::CameraReading> readings;  // one per camera, in their order
    std::vector<cv::Mat> images;                   // 8-bit grey, one per camera; none when analytic
};

/// What the cameras of a vehicle at the true pose see of the true codes. `actual` cameras
/// make the images, `calibrated` ones (what the vehicle believes; same order and size) interpret
/// them. Light, dirt and noise are nominal, drawn from `random`.
StopView sense_stop(std::span<const plant::Camera> actual,
                    std::span<const plant::Camera> calibrated, const Pose2& hall_from_body,
                    std::span<const FloorCode> codes, const SensingOptions& options,
                    std::mt19937_64& random);

}  // namespace pulseline::simulation
