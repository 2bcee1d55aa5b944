#pragma once

#include "core/localisation/dual_camera.hpp"

namespace pulseline::localisation {

/// What spoils a code's place in the body frame beside the image noise, one sigma each (vision.md
/// section 5).
struct ErrorBudget {
    double survey_m = 1e-4;
    double mounting_m = 1e-4;
    double tilt_rad = 8.7e-4;        // 0.05 deg unknown tilt of the camera; 1.7e-4 when calibrated
    double relative_scale = 0.005;   // of pixels per metre; 0.001 when calibrated
    double height_change_m = 0.002;  // load on the tyres
    double print_m = 5e-5;
};

/// Sigma per axis [m] of a code seen `offset_m` from the foot of a camera `height_m` above the
/// floor, `image_m` being the image noise on the floor. Tilt moves the foot by height x tan(tilt);
/// scale and height stretch the offset.
double code_sigma_m(const ErrorBudget& budget, double height_m, double offset_m, double image_m);

}  // namespace pulseline::localisation
