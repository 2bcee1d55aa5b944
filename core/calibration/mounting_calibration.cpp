#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/calibration/camera_calibration.hpp"

namespace pulseline::calibration {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;  // foot x, y, heading, height, tilt u, v
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t kFewestPoints = 6;
constexpr double kMostSigmaTilt_rad = 1.75e-4;  // 0.01 deg is 0.08 mm on the floor
constexpr double kMostSigmaHeight_m = 0.001;

plant::Camera moved(plant::Camera camera, const Vector6& by) {
    camera.body_from_camera.x_m += by[0];
    camera.body_from_camera.y_m += by[1];
    camera.body_from_camera.heading_rad = wrap(camera.body_from_camera.heading_rad + by[2]);
    camera.height_m += by[3];
    camera.tilt_u_rad += by[4];
    camera.tilt_v_rad += by[5];
    return camera;
}

Pixel project(const plant::Camera& camera, Point2 body) {
    return vision::distorted(camera,
                             vision::ideal_pixel(camera, inverse(camera.body_from_camera) * body));
}

struct Equations {
    Matrix6 normal = Matrix6::Zero();
    Vector6 right = Vector6::Zero();
    double squares = 0;
};

Equations equations(const plant::Camera& camera, std::span<const FloorPoint> points) {
    constexpr double kStep = 1e-6;
    Equations e;
    for (const FloorPoint& p : points) {
        const Pixel off = p.image - project(camera, p.body);
        Eigen::Matrix<double, 2, 6> j;
        for (int i = 0; i < 6; ++i) {
            const Vector6 step = kStep * Vector6::Unit(i);
            const Pixel d =
                0.5 / kStep *
                (project(moved(camera, step), p.body) - project(moved(camera, -step), p.body));
            j.col(i) << d.u, d.v;
        }
        const Eigen::Vector2d r{off.u, off.v};
        e.normal += j.transpose() * j;
        e.right += j.transpose() * r;
        e.squares += r.squaredNorm();
    }
    return e;
}

}  // namespace

Result<MountingCalibration> calibrate_mounting(const plant::Camera& start,
                                               std::span<const FloorPoint> points) {
    if (points.size() < kFewestPoints)
        return fail(Errc::kInvalid, "too_few_points", "Show more known points of the floor.");
    MountingCalibration out;
    out.camera = start;
    Equations e = equations(out.camera, points);
    for (int i = 0; i < 30; ++i) {
        const Vector6 step = e.normal.ldlt().solve(e.right);
        if (!step.allFinite()) break;
        const plant::Camera next = moved(out.camera, step);
        if (!(next.height_m > 0)) break;
        out.camera = next;
        e = equations(out.camera, points);
        if (step.norm() < 1e-10) break;
    }
    const double free = 2 * static_cast<double>(points.size()) - 6;
    const double variance = std::max(e.squares / free, 1e-8);
    const Vector6 sigma = (variance * e.normal.inverse().diagonal()).cwiseSqrt();
    out.rms_px = std::sqrt(e.squares / static_cast<double>(points.size()));
    out.sigma_foot_m = std::max(sigma[0], sigma[1]);
    out.sigma_heading_rad = sigma[2];
    out.sigma_height_m = sigma[3];
    out.sigma_tilt_rad = std::max(sigma[4], sigma[5]);
    if (!(out.sigma_tilt_rad < kMostSigmaTilt_rad) || !(out.sigma_height_m < kMostSigmaHeight_m))
        return fail(
            Errc::kInvalid, "ill_conditioned",
            "The points do not determine tilt and height. Spread them over the whole view.", {},
            {{"sigma_tilt_rad", out.sigma_tilt_rad}, {"sigma_height_m", out.sigma_height_m}});
    for (const FloorPoint& p : points)
        out.residuals.push_back({p.image, p.image - project(out.camera, p.body)});
    return out;
}

}  // namespace pulseline::calibration
