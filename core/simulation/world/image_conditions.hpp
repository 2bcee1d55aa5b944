#pragma once

#include <cstdint>
#include <random>

namespace pulseline::simulation {

/// What spoils an image: the table of levels in core/vision/README.md. Lens distortion belongs to
/// the camera; rotation and offset to the vehicle's pose.
struct ImageConditions {
    double blur_sigma_px = 0.7;
    double motion_blur_px = 0;
    double motion_direction_rad = 0;
    double tilt_u_rad = 0;  // of the true camera against the calibrated one, towards +u
    double tilt_v_rad = 0;
    double height_error_m = 0;
    double read_noise = 1;     // grey levels
    double shot_noise = 0.01;  // variance per grey level
    double exposure = 0.9;
    double gradient_u = 0;  // relative change of light from the middle to the edge of the image
    double gradient_v = 0;
    double vignetting = 0;  // relative loss in the corners
    int dirt_blobs = 0;
    double dirt_min_m = 0.0005;  // radii
    double dirt_max_m = 0.0022;
    double tape_m = 0;  // width of a light bar across the code; 0: none
    bool specular = false;
    double floor_reflectance = 0.4;
    std::uint64_t seed = 1;  // noise and places of dirt

    static ImageConditions clean(std::mt19937_64& random);
    static ImageConditions nominal(std::mt19937_64& random);
    static ImageConditions hard(std::mt19937_64& random);
};

/// k1 as the level table samples it, for nominal and hard: none or -0.12 .. 0.06.
double sample_k1(std::mt19937_64& random);

}  // namespace pulseline::simulation
