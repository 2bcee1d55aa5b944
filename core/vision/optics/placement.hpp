#pragma once

#include <cmath>

#include "core/vision/optics/optics.hpp"

namespace pulseline::vision {

/// Where a marker lies in the image, in ideal pixels about the principal point. Marker coordinates
/// (a right, b down as printed, 0 at the centre) are turned by angle, scaled by unit_px and
/// shifted; a small unknown tilt of the camera against its calibration adds a keystone: ideal
/// points p move along p/(1 + p.tilt/F), the marker's centre kept where it is.
struct Placement {
    Pixel centre;
    double angle_rad = 0;  // from +u to +v
    double unit_px = 1;    // pixels per marker unit
    Pixel keystone{};      // tilt / F, 1/px

    /// Offset from the centre, without keystone.
    Pixel turned(double a, double b) const {
        const double c = unit_px * std::cos(angle_rad);
        const double s = unit_px * std::sin(angle_rad);
        return {c * a - s * b, s * a + c * b};
    }
    Pixel at(double a, double b) const {
        const Pixel p = centre + turned(a, b);
        return p - keystone_shift(p) + keystone_shift(centre);
    }

private:
    Pixel keystone_shift(Pixel p) const {
        const double k = keystone.u * p.u + keystone.v * p.v;
        return (k / (1 + k)) * p;
    }
};

}  // namespace pulseline::vision
