#include "core/simulation/world/image_conditions.hpp"

#include "core/base/angle.hpp"

namespace pulseline::simulation {
namespace {

double uniform(std::mt19937_64& random, double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
}
int integer(std::mt19937_64& random, int from, int to) {
    return std::uniform_int_distribution<int>(from, to)(random);
}

}  // namespace

ImageConditions ImageConditions::clean(std::mt19937_64& random) {
    ImageConditions c;
    c.floor_reflectance = uniform(random, 0.22, 0.55);
    c.seed = random();
    return c;
}

ImageConditions ImageConditions::nominal(std::mt19937_64& random) {
    ImageConditions c = clean(random);
    c.blur_sigma_px = uniform(random, 0.6, 1.2);
    c.read_noise = uniform(random, 1, 2.5);
    c.shot_noise = 0.04;
    c.exposure = uniform(random, 0.6, 0.98);
    c.gradient_u = uniform(random, -0.2, 0.2);
    c.gradient_v = uniform(random, -0.2, 0.2);
    c.vignetting = uniform(random, 0, 0.25);
    c.dirt_blobs = integer(random, 3, 8);
    return c;
}

ImageConditions ImageConditions::hard(std::mt19937_64& random) {
    ImageConditions c = clean(random);
    c.blur_sigma_px = uniform(random, 0.8, 2.2);
    if (uniform(random, 0, 1) < 0.4) {
        c.motion_blur_px = uniform(random, 1, 6);
        c.motion_direction_rad = uniform(random, 0, kPi);
    }
    c.tilt_u_rad = radians(uniform(random, -0.3, 0.3));
    c.tilt_v_rad = radians(uniform(random, -0.3, 0.3));
    c.height_error_m = uniform(random, -0.003, 0.003);
    c.read_noise = uniform(random, 2, 6);
    c.shot_noise = 0.12;
    c.exposure = uniform(random, 0.3, 1.05);
    c.gradient_u = uniform(random, -0.55, 0.55);
    c.gradient_v = uniform(random, -0.55, 0.55);
    c.vignetting = uniform(random, 0, 0.25);
    c.dirt_blobs = integer(random, 14, 33);
    c.dirt_max_m = 0.004;
    if (uniform(random, 0, 1) < 0.35) c.tape_m = uniform(random, 0.001, 0.004);
    c.specular = uniform(random, 0, 1) < 0.3;
    return c;
}

double sample_k1(std::mt19937_64& random) {
    return uniform(random, 0, 1) < 0.5 ? 0 : uniform(random, -0.12, 0.06);
}

}  // namespace pulseline::simulation
