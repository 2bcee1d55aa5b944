#include "core/localisation/error_budget.hpp"

#include <cmath>

namespace pulseline::localisation {
namespace {

/// Errors of motion that grow with how a machine and its floor are kept; stiffness is no error.
void scale(DriveErrors& drive, double times) {
    for (double* error :
         {&drive.diameter_common, &drive.diameter_each, &drive.wheel_place,
          &drive.steering_common_rad, &drive.steering_each_rad, &drive.play_m, &drive.scrub_m,
          &drive.roller_slip, &drive.grade, &drive.wander_m_per_sqrt_m,
          &drive.wander_rad_per_sqrt_m, &drive.wander_rad_per_sqrt_rad, &drive.patch_slip,
          &drive.settle_m, &drive.settle_rad, &drive.fine_m, &drive.fine_rad}) {
        *error *= times;
    }
}

void scale(CameraErrors& camera, double times) {
    for (double* error :
         {&camera.mounting_m, &camera.mounting_rad, &camera.tilt_rad, &camera.focal_share,
          &camera.principal_px, &camera.k1, &camera.height_m, &camera.loaded_height_m}) {
        *error *= times;
    }
}

}  // namespace

ErrorBudget ErrorBudget::kind() {
    ErrorBudget budget;
    scale(budget.drive, 0.5);
    budget.camera = {5e-5, 1e-4, radians(0.01), 0.001, 0.1, 0.001, 2e-4, 5e-4};
    budget.marker.print_share = 2e-4;
    budget.marker.print_m = 2e-5;
    budget.slip_sensor.scale *= 0.5;
    return budget;
}

ErrorBudget ErrorBudget::harsh() {
    constexpr double kTimes = 2;
    ErrorBudget budget;
    scale(budget.drive, kTimes);
    scale(budget.camera, kTimes);
    budget.marker.print_share *= kTimes;
    budget.marker.print_m *= kTimes;
    budget.receiver.place_m *= kTimes;
    budget.receiver.clock_s *= kTimes;
    budget.reflector.mounting_m *= kTimes;
    budget.reflector.mounting_rad *= kTimes;
    budget.reflector.clock_s *= kTimes;
    budget.reflector.remission *= kTimes;
    budget.reflector.shining_things *= 2;
    budget.slip_sensor.scale *= kTimes;
    return budget;
}

ErrorBudget ErrorBudget::named(std::string_view name) {
    if (name == "kind") return kind();
    if (name == "harsh") return harsh();
    return nominal();
}

std::vector<ErrorTerm> code_terms(const ErrorBudget& budget, const plant::Camera& camera,
                                  double offset_m, bool loaded) {
    const CameraErrors& c = budget.camera;
    const double height_m = loaded ? std::hypot(c.height_m, c.loaded_height_m) : c.height_m;
    const double r = offset_m / camera.height_m;  // of the ray, in units of F
    return {{"mounting", c.mounting_m},
            {"mounting turned", offset_m * c.mounting_rad},
            {"tilt", camera.height_m * c.tilt_rad},
            {"principal point", c.principal_px * camera.height_m / camera.f_px},
            {"focal length", offset_m * c.focal_share},
            {"height", offset_m * height_m / camera.height_m},
            {"lens", offset_m * c.k1 * r * r},
            {"print", budget.marker.print_m}};
}

double code_sigma_m(const ErrorBudget& budget, const plant::Camera& camera, double offset_m,
                    double image_m, bool loaded) {
    double sum = image_m * image_m;
    for (const ErrorTerm& term : code_terms(budget, camera, offset_m, loaded)) {
        sum += term.sigma_m * term.sigma_m;
    }
    return std::sqrt(sum);
}

double code_sigma_rad(const ErrorBudget& budget, double image_rad) {
    const CameraErrors& c = budget.camera;
    return std::hypot(c.mounting_rad, c.tilt_rad * c.tilt_rad, image_rad);
}

}  // namespace pulseline::localisation
