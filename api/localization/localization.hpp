#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/localisation/dual_camera.hpp"
#include "core/plant/plant.hpp"
#include "core/plant/tolerance.hpp"
#include "core/vision/marker_reading.hpp"

/// Where a vehicle stands by images of its cameras: the whole way of a stop's measurement, for
/// anyone who has images.
namespace pulseline::api::localization {

struct CameraImage {
    std::string camera;  // by the vehicle type's name for it, "front"
    std::string bytes;   // PNG, JPEG, BMP or PGM of the camera's size
};

struct LocalizationQuestion {
    plant::VehicleId vehicle;
    /// Only the codes of this station count, and the deviation is from it; none: all of the plant,
    /// and the station that the first code belongs to.
    std::optional<int> station;
    std::vector<CameraImage> images;
};

struct CameraFinding {
    std::string camera;
    Result<vision::MarkerReading> reading;
    geometry::Pose2 body_from_marker;  // when there is a reading
    double sigma_m = 0;                // per axis, calibration and image noise together
    std::string picture;               // annotated JPEG
};

struct Localization {
    std::vector<CameraFinding> cameras;  // in the order of the images
    Result<localisation::PoseFix> fix;   // or why there is none
    const plant::Station* station = nullptr;
    plant::Deviation deviation;  // of the fix from the station, when there are both
};

/// Errors, the question's own: unknown_vehicle, unknown_station, unknown_camera, camera_twice,
/// image_unreadable, image_size {width_px, height_px}. What is wrong with the markers is in the
/// answer. `plant` has to outlive it.
Result<Localization> localize(const plant::Plant& plant, const LocalizationQuestion& question);

}  // namespace pulseline::api::localization
