#include "core/simulation/world/true_camera.hpp"

namespace pulseline::simulation {

plant::Camera true_camera(plant::Camera camera, const localisation::CameraErrors& errors,
                          bool loaded, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const auto off = [&](double sigma) { return sigma * normal(random); };
    const double x_m = off(errors.mounting_m);
    const double y_m = off(errors.mounting_m);
    camera.body_from_camera =
        camera.body_from_camera * geometry::Pose2{x_m, y_m, off(errors.mounting_rad)};
    camera.tilt_u_rad += off(errors.tilt_rad);
    camera.tilt_v_rad += off(errors.tilt_rad);
    camera.f_px *= 1 + off(errors.focal_share);
    camera.cu_px += off(errors.principal_px);
    camera.cv_px += off(errors.principal_px);
    camera.k1 += off(errors.k1);
    camera.height_m += off(errors.height_m);
    // Drawn in any case: the same seed is the same camera, with and without its load.
    const double given_m = off(errors.loaded_height_m);
    if (loaded) camera.height_m += given_m;
    return camera;
}

}  // namespace pulseline::simulation
