#include "core/simulation/world/floor_camera.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "core/simulation/world/floor_print.hpp"

namespace pulseline::simulation {
namespace {

using geometry::Point2;
using vision::Pixel;

constexpr double kTexel_m = 0.0002;
constexpr int kTextureSide = 1024;  // 0.2 m of floor, then it repeats
constexpr float kFullScale = 255;

/// Relative roughness of a concrete floor: fine grain, soft patches and specks; repeats seamlessly.
const cv::Mat& floor_texture() {
    static const cv::Mat texture = [] {
        std::mt19937_64 random{7};
        std::normal_distribution<float> normal;
        cv::Mat grain(kTextureSide, kTextureSide, CV_32F);
        cv::Mat patches(kTextureSide, kTextureSide, CV_32F);
        for (int i = 0; i < kTextureSide * kTextureSide; ++i) {
            grain.ptr<float>()[i] = normal(random);
            patches.ptr<float>()[i] = normal(random);
        }
        const auto smooth = [](const cv::Mat& in, double sigma) {
            cv::Mat tiled;
            cv::Mat out;
            const int border = static_cast<int>(4 * sigma) + 1;
            cv::copyMakeBorder(in, tiled, border, border, border, border, cv::BORDER_WRAP);
            cv::GaussianBlur(tiled, out, {}, sigma);
            cv::Mat cut = out(cv::Rect(border, border, kTextureSide, kTextureSide)).clone();
            cv::Scalar mean;
            cv::Scalar deviation;
            cv::meanStdDev(cut, mean, deviation);
            return cv::Mat((cut - mean[0]) / deviation[0]);
        };
        cv::Mat sum = 1 + 0.04 * smooth(grain, 1.5) + 0.05 * smooth(patches, 40);
        for (int i = 0; i < 160; ++i) {
            const cv::Point at(static_cast<int>(random() % kTextureSide),
                               static_cast<int>(random() % kTextureSide));
            cv::circle(sum, at, static_cast<int>(random() % 3), cv::Scalar(i % 3 ? 0.75 : 1.2), -1);
        }
        return sum;
    }();
    return texture;
}

/// Standard normal numbers; every image starts somewhere else in each row.
const std::vector<float>& noise_table() {
    static const std::vector<float> table = [] {
        std::mt19937_64 random{11};
        std::normal_distribution<float> normal;
        std::vector<float> values(1U << 20U);
        for (float& v : values) v = normal(random);
        return values;
    }();
    return table;
}

/// Floor points, camera floor frame, at the corners of all pixels: (i, j) belongs to image point
/// (i - 0.5, j - 0.5). Exact every fourth pixel, linear between: 1e-4 px at the strongest
/// distortion.
class CornerGrid {
public:
    CornerGrid(const plant::Camera& camera, const FloorProjection& projection)
        : points_(cv::Size(camera.width_px + 1, camera.height_px + 1), CV_32FC2) {
        const int knots = camera.width_px / kStep + 2;
        std::vector<cv::Vec2f> above(static_cast<std::size_t>(knots));
        std::vector<cv::Vec2f> below(above.size());
        const auto exact_row = [&](std::vector<cv::Vec2f>& row, int v) {
            for (int k = 0; k < knots; ++k) {
                const Point2 p = projection.floor_from_image({k * kStep - 0.5, v - 0.5});
                row[static_cast<std::size_t>(k)] = {static_cast<float>(p.x_m),
                                                    static_cast<float>(p.y_m)};
            }
        };
        exact_row(below, 0);
        for (int v = 0; v < points_.rows; ++v) {
            if (v % kStep == 0) {
                std::swap(above, below);
                exact_row(below, v + kStep);
            }
            const float down = static_cast<float>(v % kStep) / kStep;
            auto* row = points_.ptr<cv::Vec2f>(v);
            cv::Vec2f left = above[0] + down * (below[0] - above[0]);
            for (int u = 0; u < points_.cols; u += kStep) {
                const auto k = static_cast<std::size_t>(u / kStep + 1);
                const cv::Vec2f right = above[k] + down * (below[k] - above[k]);
                const cv::Vec2f step = (right - left) / kStep;
                for (int i = 0; i < std::min(kStep, points_.cols - u); ++i)
                    row[u + i] = left + static_cast<float>(i) * step;
                left = right;
            }
        }
    }
    const cv::Vec2f* row(int v) const { return points_.ptr<cv::Vec2f>(v); }

private:
    static constexpr int kStep = 4;
    cv::Mat points_;
};

cv::Mat bare_floor(const plant::Camera& camera, const CornerGrid& grid,
                   const Pose2& hall_from_camera, double reflectance) {
    const cv::Mat& texture = floor_texture();
    cv::Mat image(camera.height_px, camera.width_px, CV_32F);
    const auto c = static_cast<float>(std::cos(hall_from_camera.heading_rad) / kTexel_m);
    const auto s = static_cast<float>(std::sin(hall_from_camera.heading_rad) / kTexel_m);
    const double period_m = kTexel_m * kTextureSide;
    const auto origin = [&](double value) {  // kept small and positive, so that int() is floor()
        return static_cast<float>((value - period_m * std::floor(value / period_m)) / kTexel_m +
                                  16 * kTextureSide);
    };
    const float x0 = origin(hall_from_camera.x_m);
    const float y0 = origin(hall_from_camera.y_m);
    const auto level = static_cast<float>(reflectance);
    for (int v = 0; v < image.rows; ++v) {
        const cv::Vec2f* floor = grid.row(v);
        auto* row = image.ptr<float>(v);
        for (int u = 0; u < image.cols; ++u) {
            const int i = static_cast<int>(x0 + c * floor[u][0] - s * floor[u][1]);
            const int j = static_cast<int>(y0 + s * floor[u][0] + c * floor[u][1]);
            row[u] = level * texture.ptr<float>(j & (kTextureSide - 1))[i & (kTextureSide - 1)];
        }
    }
    return image;
}

void add_dirt(cv::Mat& image, const FloorProjection& projection, const plant::Camera& camera,
              const ImageConditions& conditions, std::mt19937_64& random) {
    const auto uniform = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    const double scale = vision::pixels_per_metre(camera);
    for (int i = 0; i < conditions.dirt_blobs; ++i) {
        const Pixel at{uniform(0.1, 0.9) * image.cols, uniform(0.05, 0.95) * image.rows};
        const double r = scale * uniform(conditions.dirt_min_m, conditions.dirt_max_m);
        const double squash = uniform(0.6, 1);
        const double turn = uniform(0, kPi);
        const auto shade =
            static_cast<float>(uniform(0, 1) < 0.6 ? uniform(0.05, 0.3) : uniform(0.55, 0.85));
        const int left = std::max(0, static_cast<int>(at.u - r) - 1);
        const int right = std::min(image.cols - 1, static_cast<int>(at.u + r) + 1);
        const int top = std::max(0, static_cast<int>(at.v - r) - 1);
        const int low = std::min(image.rows - 1, static_cast<int>(at.v + r) + 1);
        for (int v = top; v <= low; ++v) {
            for (int u = left; u <= right; ++u) {
                const double a = std::cos(turn) * (u - at.u) + std::sin(turn) * (v - at.v);
                const double b =
                    (std::cos(turn) * (v - at.v) - std::sin(turn) * (u - at.u)) / squash;
                const auto cover =
                    static_cast<float>(std::clamp(r + 0.5 - std::hypot(a, b), 0.0, 1.0));
                float& pixel = image.at<float>(v, u);
                pixel += cover * (shade - pixel);
            }
        }
    }
    if (conditions.tape_m > 0) {
        const double turn = uniform(0, kPi);
        const double offset_m = uniform(-0.02, 0.02);
        const Pixel middle{image.cols / 2.0, image.rows / 2.0};
        const double half_px = scale * conditions.tape_m / 2;
        for (int v = 0; v < image.rows; ++v) {
            for (int u = 0; u < image.cols; ++u) {
                const double d = std::cos(turn) * (u - middle.u) + std::sin(turn) * (v - middle.v) -
                                 offset_m * scale;
                const auto cover =
                    static_cast<float>(std::clamp(half_px + 0.5 - std::abs(d), 0.0, 1.0));
                float& pixel = image.at<float>(v, u);
                pixel += cover * (0.75F - pixel);
            }
        }
    }
    if (conditions.specular) {
        const Point2 at{uniform(-0.04, 0.04), uniform(-0.04, 0.04)};
        const Pixel spot = projection.image_from_floor(at);
        const double radius = scale * uniform(0.004, 0.012);
        for (int v = 0; v < image.rows; ++v)
            for (int u = 0; u < image.cols; ++u)
                image.at<float>(v, u) += static_cast<float>(
                    1.5 * std::exp(-0.5 * (std::pow(u - spot.u, 2) + std::pow(v - spot.v, 2)) /
                                   (radius * radius)));
    }
}

void blur(cv::Mat& image, const ImageConditions& conditions) {
    if (conditions.blur_sigma_px > 0) {
        const int side = 2 * static_cast<int>(std::ceil(4 * conditions.blur_sigma_px)) + 1;
        cv::GaussianBlur(image, image, {side, side}, conditions.blur_sigma_px,
                         conditions.blur_sigma_px, cv::BORDER_REPLICATE);
    }
    if (conditions.motion_blur_px > 0) {
        const int reach = static_cast<int>(conditions.motion_blur_px / 2) + 2;
        cv::Mat kernel = cv::Mat::zeros(2 * reach + 1, 2 * reach + 1, CV_32F);
        constexpr int kSteps = 64;
        for (int i = 0; i < kSteps; ++i) {  // a moved point, spread bilinearly
            const double t = ((i + 0.5) / kSteps - 0.5) * conditions.motion_blur_px;
            const double x = reach + t * std::cos(conditions.motion_direction_rad);
            const double y = reach + t * std::sin(conditions.motion_direction_rad);
            const int x0 = static_cast<int>(x);
            const int y0 = static_cast<int>(y);
            for (int k = 0; k < 4; ++k) {
                const double wx = k % 2 == 0 ? 1 - (x - x0) : x - x0;
                const double wy = k / 2 == 0 ? 1 - (y - y0) : y - y0;
                kernel.at<float>(y0 + k / 2, x0 + k % 2) += static_cast<float>(wx * wy / kSteps);
            }
        }
        cv::filter2D(image, image, -1, kernel, {-1, -1}, 0, cv::BORDER_REPLICATE);
    }
}

/// Light on the scene, sensor noise, 8 bits.
cv::Mat expose(const cv::Mat& scene, const ImageConditions& conditions, std::mt19937_64& random) {
    const std::vector<float>& noise = noise_table();
    const float half_w = static_cast<float>(scene.cols) / 2;
    const float half_h = static_cast<float>(scene.rows) / 2;
    const float corner2 = half_w * half_w + half_h * half_h;
    const auto read2 = static_cast<float>(conditions.read_noise * conditions.read_noise);
    const auto shot = static_cast<float>(conditions.shot_noise);
    const auto gu = static_cast<float>(conditions.gradient_u);
    const auto gv = static_cast<float>(conditions.gradient_v);
    const auto vignetting = static_cast<float>(conditions.vignetting);
    const auto gain = static_cast<float>(conditions.exposure) * kFullScale;
    cv::Mat image(scene.size(), CV_8U);
    std::vector<float> line(static_cast<std::size_t>(scene.cols));
    for (int v = 0; v < scene.rows; ++v) {
        const auto* in = scene.ptr<float>(v);
        auto* out = image.ptr<std::uint8_t>(v);
        const float* n =
            noise.data() + random() % (noise.size() - static_cast<std::size_t>(scene.cols));
        const float y = static_cast<float>(v) - half_h;
        for (int u = 0; u < scene.cols; ++u) {
            const float x = static_cast<float>(u) - half_w;
            const float light = (1 + gu * x / half_w + gv * y / half_h) *
                                (1 - vignetting * (x * x + y * y) / corner2);
            const float value = std::max(0.0F, gain * light * in[u]);
            line[static_cast<std::size_t>(u)] =
                value + std::sqrt(read2 + shot * value) * n[u] + 0.5F;
        }
        for (int u = 0; u < scene.cols; ++u)
            out[u] = static_cast<std::uint8_t>(
                std::clamp(line[static_cast<std::size_t>(u)], 0.0F, kFullScale));
    }
    return image;
}

}  // namespace

FloorProjection::FloorProjection(const plant::Camera& camera, const ImageConditions& conditions)
    : camera_(camera), height_m_(camera.height_m + conditions.height_error_m) {
    // Rays are (u, v, F) in the camera's axes; turned first about v, then about u.
    const double tilt_u = camera.tilt_u_rad + conditions.tilt_u_rad;
    const double tilt_v = camera.tilt_v_rad + conditions.tilt_v_rad;
    const double cu = std::cos(tilt_u);
    const double su = std::sin(tilt_u);
    const double cv = std::cos(tilt_v);
    const double sv = std::sin(tilt_v);
    floor_from_ray_ = {cu, 0, su, -sv * su, cv, sv * cu, -cv * su, -sv, cv * cu};
}

Point2 FloorProjection::floor_from_image(Pixel image) const {
    // Newton's method on r + k1 r^3 = r_d: the simulation has its own lens.
    const auto& m = floor_from_ray_;
    const double f = camera_.f_px;
    const Pixel d{image.u - camera_.cu_px, image.v - camera_.cv_px};
    const double rd = std::hypot(d.u, d.v) / f;
    double r = rd;
    for (int i = 0; i < 4; ++i)
        r -= (r + camera_.k1 * r * r * r - rd) / (1 + 3 * camera_.k1 * r * r);
    const Pixel p = (rd > 0 ? r / rd : 1) * d;
    const double k = height_m_ / (m[6] * p.u + m[7] * p.v + m[8] * f);
    return {k * (m[0] * p.u + m[1] * p.v + m[2] * f), -k * (m[3] * p.u + m[4] * p.v + m[5] * f)};
}

Pixel FloorProjection::image_from_floor(Point2 floor) const {
    const auto& m = floor_from_ray_;  // a rotation: its transpose goes back
    const double x = floor.x_m;
    const double y = -floor.y_m;
    const double z = height_m_;
    const double k = camera_.f_px / (m[2] * x + m[5] * y + m[8] * z);
    const Pixel p{k * (m[0] * x + m[3] * y + m[6] * z), k * (m[1] * x + m[4] * y + m[7] * z)};
    const double r = std::hypot(p.u, p.v) / camera_.f_px;
    return Pixel{camera_.cu_px, camera_.cv_px} + (1 + camera_.k1 * r * r) * p;
}

cv::Mat render_floor(const plant::Camera& camera, const Pose2& hall_from_body,
                     std::span<const FloorCode> codes, const ImageConditions& conditions) {
    std::mt19937_64 random{conditions.seed};
    const FloorProjection projection(camera, conditions);
    const CornerGrid grid(camera, projection);
    const Pose2 hall_from_camera = hall_from_body * camera.body_from_camera;

    cv::Mat scene = bare_floor(camera, grid, hall_from_camera, conditions.floor_reflectance);
    for (const FloorCode& code : codes)
        print_code(scene, code, inverse(hall_from_camera) * code.pose, projection,
                   [&](int v) { return grid.row(v); });
    add_dirt(scene, projection, camera, conditions, random);
    blur(scene, conditions);
    return expose(scene, conditions, random);
}

}  // namespace pulseline::simulation
