#include "core/vision/papers/li_landmark.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/plant/marker_geometry.hpp"

namespace pulseline::vision {
namespace {

namespace landmark = plant::landmark;

cv::Mat black_parts(const cv::Mat& grey) {
    cv::Mat smooth;
    cv::blur(grey, smooth, {3, 3});
    cv::Mat black;
    cv::threshold(smooth, black, 0, 255, cv::THRESH_BINARY_INV | cv::THRESH_OTSU);
    const cv::Mat element = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
    cv::morphologyEx(black, black, cv::MORPH_OPEN, element);
    cv::morphologyEx(black, black, cv::MORPH_CLOSE, element);
    return black;
}

/// Centroids of black blobs that pass the constraints of section 3.2.
std::vector<Pixel> dot_centroids(const cv::Mat& black, double radius_px) {
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(black, contours, cv::RETR_TREE, cv::CHAIN_APPROX_NONE);
    std::vector<Pixel> dots;
    const double expected = kPi * radius_px * radius_px;
    for (const auto& contour : contours) {
        const double area = cv::contourArea(contour);
        if (area < 0.6 * expected || area > 1.5 * expected) continue;
        const double length = cv::arcLength(contour, true);
        if (4 * kPi * area / (length * length) < 0.75) continue;
        std::vector<cv::Point> hull;
        cv::convexHull(contour, hull);
        if (area / cv::contourArea(hull) < 0.9) continue;
        const cv::Rect box = cv::boundingRect(contour);
        const cv::Moments m = cv::moments(black(box), true);
        const Pixel at{box.x + m.m10 / m.m00, box.y + m.m01 / m.m00};
        if (black.at<std::uint8_t>(static_cast<int>(at.v), static_cast<int>(at.u)) != 0)
            dots.push_back(at);
    }
    return dots;
}

double cross(Pixel a, Pixel b) { return a.u * b.v - a.v * b.u; }
double dot(Pixel a, Pixel b) { return a.u * b.u + a.v * b.v; }

/// B = line(A, D) x line(E, F); signed lengths along A -> D.
bool cross_ratio_fits(Pixel a, Pixel c, Pixel d, Pixel e, Pixel f) {
    const Pixel way = d - a;
    const double length2 = dot(way, way);
    const double off = std::abs(cross(c - a, way)) / length2;  // C lies on the line
    const double turn = cross(way, f - e);
    if (off > 0.03 || turn == 0) return false;
    const double b = cross(e - a, f - e) / turn;
    const double tc = dot(c - a, way) / length2;
    const double ratio = (tc / (tc - b)) / (1 / (1 - b));
    return std::abs(ratio - landmark::kCrossRatio) < 0.1;
}

}  // namespace

std::optional<LiLandmark> li_landmark(const cv::Mat& grey, const plant::Camera& camera,
                                      double size_m) {
    const double px_per_unit = pixels_per_metre(camera) * size_m / (2 * landmark::kOuter_m);
    const cv::Mat black = black_parts(grey);
    std::vector<Pixel> found = dot_centroids(black, landmark::kDot_m * px_per_unit);
    if (found.size() > 20) return std::nullopt;
    for (Pixel& p : found) p = undistorted(camera, p);
    std::optional<LiLandmark> best;
    const auto near = [](Pixel way, double length) {
        return std::abs(std::hypot(way.u, way.v) - length) < 0.1 * length;
    };
    for (const Pixel a : found) {
        for (const Pixel d : found) {
            if (!near(d - a, 0.038 * px_per_unit)) continue;
            const Pixel up = (1 / 0.038) * (a - d);
            const Pixel right{-up.v, up.u};
            std::array<const Pixel*, 5> all{};
            for (std::size_t i = 0; i < all.size(); ++i) {
                // Dots are looked for about where A and D put them.
                const Pixel want =
                    d + (landmark::kDots[i].up_m + 0.020) * up + landmark::kDots[i].right_m * right;
                double nearest = 0.002 * px_per_unit;
                for (const Pixel& p : found) {
                    const double off = std::hypot(p.u - want.u, p.v - want.v);
                    if (off < nearest) nearest = off, all[i] = &p;
                }
            }
            if (std::ranges::any_of(all, [](const Pixel* p) { return p == nullptr; })) continue;
            if (!cross_ratio_fits(*all[0], *all[1], *all[2], *all[3], *all[4])) continue;
            LiLandmark landmark_found;
            Pixel image, marker;
            for (std::size_t i = 0; i < all.size(); ++i) {
                landmark_found.dots[i] = distorted(camera, *all[i]);
                image = image + 0.2 * *all[i];
                marker = marker + 0.2 * Pixel{landmark::kDots[i].right_m, -landmark::kDots[i].up_m};
            }
            double along = 0, across = 0, size2 = 0;
            for (std::size_t i = 0; i < all.size(); ++i) {
                const Pixel p =
                    Pixel{landmark::kDots[i].right_m, -landmark::kDots[i].up_m} - marker;
                const Pixel q = *all[i] - image;
                along += dot(p, q), across += cross(p, q), size2 += dot(p, p);
            }
            const double c = along / size2, s = across / size2;
            const Pixel centre =
                image - Pixel{c * marker.u - s * marker.v, s * marker.u + c * marker.v};
            landmark_found.centre = distorted(camera, centre);
            landmark_found.angle_rad = std::atan2(s, c);
            for (int k = 0; k < landmark::kSectors; ++k) {
                const double t = (k + 0.5) * kPi / 4;
                const Pixel m{0.035 * std::sin(t), -0.035 * std::cos(t)};
                const Pixel at =
                    distorted(camera, centre + Pixel{c * m.u - s * m.v, s * m.u + c * m.v});
                if (!in_image(camera, at)) return std::nullopt;
                const bool dark = black.at<std::uint8_t>(static_cast<int>(std::lround(at.v)),
                                                         static_cast<int>(std::lround(at.u))) != 0;
                landmark_found.code = 2 * landmark_found.code + (dark ? 0 : 1);
            }
            best = landmark_found;
        }
    }
    return best;
}

LiPose li_p4p(const LiLandmark& landmark, const plant::Camera& camera) {
    std::array<Eigen::Vector2d, 4> marker_m;
    std::array<Eigen::Vector2d, 4> rays;
    constexpr std::array<std::size_t, 4> kUsed{0, 2, 3, 4};  // A, D, E, F
    for (std::size_t i = 0; i < 4; ++i) {
        const auto& dot = plant::landmark::kDots[kUsed[i]];
        marker_m[i] = {dot.right_m, -dot.up_m};
        const Pixel p = undistorted(camera, landmark.dots[kUsed[i]]);
        rays[i] = {p.u / camera.f_px, p.v / camera.f_px};
    }
    return li_p4p(marker_m, rays);
}

LiPose li_p4p(const std::array<Eigen::Vector2d, 4>& marker_m,
              const std::array<Eigen::Vector2d, 4>& rays) {
    double size = 0;  // marker coordinates about 1, for the conditioning
    for (const auto& m : marker_m) size = std::max(size, m.norm());
    Eigen::Matrix<double, 8, 9> a = Eigen::Matrix<double, 8, 9>::Zero();
    for (int i = 0; i < 4; ++i) {
        const Eigen::Vector2d m = marker_m[static_cast<std::size_t>(i)] / size;
        const Eigen::Vector2d r = rays[static_cast<std::size_t>(i)];
        for (int k = 0; k < 2; ++k) {  // unknowns: n, o, p
            a(2 * i + k, k) = m[0];
            a(2 * i + k, 2) = -r[k] * m[0];
            a(2 * i + k, 3 + k) = m[1];
            a(2 * i + k, 5) = -r[k] * m[1];
            a(2 * i + k, 6 + k) = 1;
            a(2 * i + k, 8) = -r[k];
        }
    }
    const Eigen::JacobiSVD<Eigen::Matrix<double, 8, 9>> svd(a, Eigen::ComputeFullV);
    Eigen::Matrix<double, 9, 1> x = svd.matrixV().col(8);
    if (x[8] < 0) x = -x;
    const double scale = 1 / std::sqrt(x.segment<3>(0).norm() * x.segment<3>(3).norm());
    const Eigen::Vector3d n = scale * x.segment<3>(0);
    const Eigen::Vector3d o = scale * x.segment<3>(3);
    const Eigen::Vector3d p = size * scale * x.segment<3>(6);
    Eigen::Matrix3d m;
    m << n, o, n.cross(o);
    const Eigen::JacobiSVD<Eigen::Matrix3d> polar(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d rotation = polar.matrixU() * polar.matrixV().transpose();
    if (rotation.determinant() < 0) {
        Eigen::Matrix3d flip = Eigen::Vector3d(1, 1, -1).asDiagonal();
        rotation = polar.matrixU() * flip * polar.matrixV().transpose();
    }
    return {rotation, p};
}

}  // namespace pulseline::vision
