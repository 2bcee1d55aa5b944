#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/pose2.hpp"
#include "core/plant/plant.hpp"

/// The camera model (README.md): pixel centres at integers, u right, v down, radial
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

/// Rotation from the tilted camera's axes to the level ones, row by row.
struct Levelling {
    std::array<double, 9> m{1, 0, 0, 0, 1, 0, 0, 0, 1};

    explicit Levelling(const plant::Camera& camera) {
        // Series: these run for every profile, and mounted cameras tilt by less than 0.5 rad.
        const auto sine = [](double t) {
            const double t2 = t * t;
            return t * (1 - t2 / 6 * (1 - t2 / 20 * (1 - t2 / 42 * (1 - t2 / 72))));
        };
        const double su = sine(camera.tilt_u_rad), sv = sine(camera.tilt_v_rad);
        const double cu = std::sqrt(1 - su * su), cv = std::sqrt(1 - sv * sv);
        m = {cu, 0, su, -sv * su, cv, sv * cu, -cv * su, -sv, cv * cu};
    }
};
inline bool is_level(const plant::Camera& camera) {
    return camera.tilt_u_rad == 0 && camera.tilt_v_rad == 0;
}

/// Ideal pixel offset of an image point: from the point straight below the optical centre, as a
/// camera without tilt and distortion at the same place would see it.
inline Pixel undistorted(const plant::Camera& camera, Pixel image) {
    const Pixel d{image.u - camera.cu_px, image.v - camera.cv_px};
    const double q = camera.k1 * (d.u * d.u + d.v * d.v) / (camera.f_px * camera.f_px);
    const Pixel p = undistortion(q) * d;
    if (is_level(camera)) return p;
    const auto m = Levelling(camera).m;
    const double f = camera.f_px;
    const double k = f / (m[6] * p.u + m[7] * p.v + m[8] * f);
    return {k * (m[0] * p.u + m[1] * p.v + m[2] * f), k * (m[3] * p.u + m[4] * p.v + m[5] * f)};
}

/// Image point of an ideal pixel offset.
inline Pixel distorted(const plant::Camera& camera, Pixel ideal) {
    if (!is_level(camera)) {  // the transpose turns back
        const auto m = Levelling(camera).m;
        const double f = camera.f_px;
        const double k = f / (m[2] * ideal.u + m[5] * ideal.v + m[8] * f);
        ideal = {k * (m[0] * ideal.u + m[3] * ideal.v + m[6] * f),
                 k * (m[1] * ideal.u + m[4] * ideal.v + m[7] * f)};
    }
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

/// Floor point in the camera's frame (foot of the optical centre, x along +u, y to the LEFT of it,
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
