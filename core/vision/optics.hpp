#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/pose2.hpp"
#include "core/plant/plant.hpp"

/// The camera model of design.md section 10: pixel centres at integers, u right, v down, radial
/// distortion x_d = x (1 + k1 r^2) with r in units of F.
namespace pulseline::vision {

struct Pixel {
    double u = 0;
    double v = 0;
};
inline Pixel operator+(Pixel a, Pixel b) { return {a.u + b.u, a.v + b.v}; }
inline Pixel operator-(Pixel a, Pixel b) { return {a.u - b.u, a.v - b.v}; }
inline Pixel operator*(double k, Pixel a) { return {k * a.u, k * a.v}; }

/// Factor s with x_undistorted = s x_distorted, for q = k1 r_d^2: s + q s^3 = 1.
inline double undistortion(double q) {
    double s = 1 - q;
    for (int i = 0; i < 3; ++i) s -= (s + q * s * s * s - 1) / (1 + 3 * q * s * s);
    return s;
}

/// Ideal pixel offset from the principal point, of an image point.
inline Pixel undistorted(const plant::Camera& camera, Pixel image) {
    const Pixel d{image.u - camera.cu_px, image.v - camera.cv_px};
    const double q = camera.k1 * (d.u * d.u + d.v * d.v) / (camera.f_px * camera.f_px);
    return undistortion(q) * d;
}

/// Image point of an ideal pixel offset from the principal point.
inline Pixel distorted(const plant::Camera& camera, Pixel ideal) {
    const double r2 = (ideal.u * ideal.u + ideal.v * ideal.v) / (camera.f_px * camera.f_px);
    const double s = 1 + camera.k1 * r2;
    return {camera.cu_px + s * ideal.u, camera.cv_px + s * ideal.v};
}

inline bool in_image(const plant::Camera& camera, Pixel p, double margin_px = 0) {
    return p.u >= margin_px && p.v >= margin_px && p.u <= camera.width_px - 1 - margin_px &&
           p.v <= camera.height_px - 1 - margin_px;
}

/// Pixels per metre of floor.
inline double pixels_per_metre(const plant::Camera& camera) {
    return camera.f_px / camera.height_m;
}

/// Floor point in the camera's frame (foot of the optical axis, x along +u, y to the LEFT of it,
/// that is along -v) of an ideal pixel offset. No mirror: +v is to the right of +u.
inline geometry::Point2 floor_point(const plant::Camera& camera, Pixel ideal) {
    const double k = 1 / pixels_per_metre(camera);
    return {k * ideal.u, -k * ideal.v};
}
inline Pixel ideal_pixel(const plant::Camera& camera, geometry::Point2 floor) {
    const double k = pixels_per_metre(camera);
    return {k * floor.x_m, -k * floor.y_m};
}

/// Image points of the corners of a square code: top left, top right, bottom right, bottom left as
/// printed. `camera_from_code`: heading = direction of its "up" edge.
inline std::array<Pixel, 4> code_corners(const plant::Camera& camera,
                                         const geometry::Pose2& camera_from_code, double size_m) {
    const double h = size_m / 2;
    const std::array<geometry::Point2, 4> corners{
        {{h, h}, {h, -h}, {-h, -h}, {-h, h}}};  // x up, y to the left
    std::array<Pixel, 4> image;
    std::ranges::transform(corners, image.begin(), [&](geometry::Point2 p) {
        return distorted(camera, ideal_pixel(camera, camera_from_code * p));
    });
    return image;
}

}  // namespace pulseline::vision
