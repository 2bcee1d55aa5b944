#include "core/vision/papers/tang_picture.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace pulseline::vision {
namespace {

// Colours of the dashboard's measurement overlay, blue green red.
const cv::Scalar kOverlay(0xe0, 0x66, 0x1a);
const cv::Scalar kCasing(0xff, 0xff, 0xff);
constexpr double kArm = 0.4;  // of the picture's height

cv::Point at(Pixel p) {
    return {static_cast<int>(std::lround(p.u)), static_cast<int>(std::lround(p.v))};
}

}  // namespace

cv::Mat tang_picture(const cv::Mat& grey, const TangSteps& steps, const plant::Camera& camera) {
    cv::Mat picture;
    cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
    const Pixel centre{0.5 * (grey.cols - 1), 0.5 * (grey.rows - 1)};
    // Image u is the camera's x, image v against its y; forwards is the body's x.
    const double mount_rad = camera.body_from_camera.heading_rad;
    const double arm_px = kArm * grey.rows;
    const Pixel ahead{arm_px * std::cos(mount_rad), arm_px * std::sin(mount_rad)};
    const Pixel left{arm_px * std::sin(mount_rad), -arm_px * std::cos(mount_rad)};
    for (const auto& [colour, width] : {std::pair{kCasing, 5}, {kOverlay, 2}}) {
        cv::arrowedLine(picture, at(centre), at(centre + ahead), colour, width, cv::LINE_AA, 0,
                        0.08);
        cv::arrowedLine(picture, at(centre), at(centre + left), colour, width, cv::LINE_AA, 0,
                        0.08);
        if (!steps.corners) continue;
        for (std::size_t i = 0; i < 4; ++i) {
            const Pixel corner = (*steps.corners)[i];
            cv::line(picture, at(corner), at((*steps.corners)[(i + 1) % 4]), colour, width / 2,
                     cv::LINE_AA);
            cv::circle(picture, at(corner), 5, colour, width, cv::LINE_AA);
        }
    }
    return picture;
}

}  // namespace pulseline::vision
