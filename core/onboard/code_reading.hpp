#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/base/result.hpp"
#include "core/localisation/dual_camera.hpp"
#include "core/localisation/error_budget.hpp"
#include "core/vda5050/messages.hpp"
#include "core/vision/marker_reading.hpp"

/// What a vehicle makes of the codes in the pictures of the floor below it.
namespace pulseline::onboard {

/// A code read in a picture of `camera`, in the body frame. `loaded`: the vehicle carries its load.
vda5050::CameraReading code_reading(const plant::Camera& camera,
                                    const vision::MarkerReading& reading,
                                    const localisation::ErrorBudget& errors, bool loaded);
vda5050::CameraReading no_code(const plant::Camera& camera, std::string why);
/// Where a reading has its code; nothing when it found none.
std::optional<geometry::Pose2> body_from_code(const vda5050::CameraReading& reading);

/// The pose that the readings give, with the survey that an order brings. Errors: those of
/// localisation::locate.
Result<localisation::PoseFix> locate_stop(std::span<const vda5050::CameraReading> readings,
                                          const vda5050::StopTarget& target,
                                          const localisation::ErrorBudget& errors);
vda5050::StopMeasurement measurement_of(const localisation::PoseFix& fix);

}  // namespace pulseline::onboard
