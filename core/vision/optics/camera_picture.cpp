#include "core/vision/optics/camera_picture.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/vision/optics/optics.hpp"

namespace pulseline::vision {
namespace {

// Colours of the dashboard's measurement overlay, blue green red.
const cv::Scalar kOverlay(0xe0, 0x66, 0x1a);
const cv::Scalar kCasing(0xff, 0xff, 0xff);
const cv::Scalar kCross(0x1c, 0x17, 0x12);
constexpr int kShift = 4;  // sub-pixel bits of OpenCV's drawing functions

cv::Point fixed(Pixel half_size) {
    constexpr double kOne = 1 << kShift;
    return {static_cast<int>(std::lround(half_size.u * kOne)),
            static_cast<int>(std::lround(half_size.v * kOne))};
}
cv::Size half_of(cv::Size size) {
    return {std::max(1, size.width / 2), std::max(1, size.height / 2)};
}
Pixel halved(Pixel p) { return {(p.u - 0.5) / 2, (p.v - 0.5) / 2}; }

void line(cv::Mat& picture, Pixel a, Pixel b, const cv::Scalar& colour, int width) {
    cv::line(picture, fixed(a), fixed(b), colour, width, cv::LINE_AA, kShift);
}

void crosshair(cv::Mat& picture, Pixel centre) {
    const double right = picture.cols - 1;
    const double bottom = picture.rows - 1;
    constexpr double kDash = 18;
    constexpr double kPeriod = 25;
    const auto stroke = [&](Pixel from, Pixel to) {
        line(picture, from, to, kCross, 3);
        const Pixel way = to - from;
        const double length = std::hypot(way.u, way.v);
        for (double t = 0; t < length; t += kPeriod)
            line(picture, from + (t / length) * way,
                 from + (std::min(length, t + kDash) / length) * way, kCasing, 1);
    };
    stroke({0, centre.v}, {right, centre.v});
    stroke({centre.u, 0}, {centre.u, bottom});
}

void brackets(cv::Mat& picture, const plant::Camera& camera,
              const geometry::Pose2& camera_from_code, double size_m) {
    // Half a quiet zone outside the code, so that they touch neither modules nor the sheet's edge.
    constexpr double kOutside = 1.16;
    constexpr double kArm = 0.2;  // of the side
    const auto outer = code_corners(camera, camera_from_code, kOutside * size_m);
    for (const auto& [colour, width] : {std::pair{kCasing, 9}, {kOverlay, 6}}) {
        for (std::size_t i = 0; i < 4; ++i) {
            const Pixel corner = outer[i];
            for (const std::size_t other : {(i + 1) % 4, (i + 3) % 4})
                line(picture, halved(corner), halved(corner + kArm * (outer[other] - corner)),
                     colour, width);
        }
    }
    const auto code = code_corners(camera, camera_from_code, 1.03 * size_m);
    for (std::size_t i = 0; i < 4; ++i)
        line(picture, halved(code[i]), halved(code[(i + 1) % 4]), kOverlay, 1);
}

void offset(cv::Mat& picture, Pixel from, Pixel to) {
    for (const auto& [colour, width, radius] :
         {std::tuple{kCasing, 8, 11}, std::tuple{kOverlay, 4, 7}}) {
        line(picture, from, to, colour, width);
        cv::circle(picture, fixed(to), radius << kShift, colour, -1, cv::LINE_AA, kShift);
    }
}

}  // namespace

cv::Mat annotate(const cv::Mat& grey, const plant::Camera& camera,
                 const std::optional<geometry::Pose2>& body_from_code, double code_size_m) {
    cv::Mat half;
    cv::resize(grey, half, half_of(grey.size()), 0, 0, cv::INTER_AREA);
    cv::Mat picture;
    cv::cvtColor(half, picture, cv::COLOR_GRAY2BGR);
    const Pixel axis = halved({camera.cu_px, camera.cv_px});
    crosshair(picture, axis);
    if (!body_from_code) return picture;
    const geometry::Pose2 camera_from_code = inverse(camera.body_from_camera) * *body_from_code;
    brackets(picture, camera, camera_from_code, code_size_m);
    offset(picture, axis,
           halved(distorted(camera, ideal_pixel(camera, camera_from_code.position()))));
    return picture;
}

std::vector<std::uint8_t> encode_jpeg(const cv::Mat& image, const plant::Camera& camera,
                                      std::size_t max_bytes) {
    cv::Mat half = image;
    if (image.cols > camera.width_px / 2)
        cv::resize(image, half, half_of({camera.width_px, camera.height_px}), 0, 0, cv::INTER_AREA);
    std::vector<std::uint8_t> bytes;
    for (int quality = 85; quality >= 5; quality -= 10) {
        cv::imencode(".jpg", half, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
        if (bytes.size() <= max_bytes) break;
    }
    return bytes;
}

}  // namespace pulseline::vision
