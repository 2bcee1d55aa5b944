#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/papers/tang_picture.hpp"
#include "tests/core/vision/marker_view.hpp"

namespace pulseline::vision {
namespace {

MarkerView view_of_qr() {
    MarkerView view;
    view.kind = plant::MarkerKind::kQr;
    view.payload = "ST04-F";
    view.camera_from_code = {0.012, -0.007, 0.3};
    return view;
}

/// Figure 9 of the paper: the corners are those of the code, in the camera's own image and in one
/// of half its size.
TEST(TangSteps, FindTheFourCornersOfACodeAtBothSizes) {
    const MarkerView view = view_of_qr();
    for (const double scale : {1.0, 0.5}) {
        cv::Mat image;
        cv::resize(view.image(), image, {}, scale, scale, cv::INTER_AREA);
        const TangSteps steps = tang_steps(image, view.camera, 0.060);
        ASSERT_TRUE(steps.corners) << scale;
        const auto expected = code_corners(view.camera, view.camera_from_code, 0.060);
        for (const Pixel& corner : *steps.corners) {
            double nearest_px = 1e9;
            for (const Pixel& one : expected)
                nearest_px = std::min(
                    nearest_px, std::hypot(corner.u - scale * one.u, corner.v - scale * one.v));
            EXPECT_LT(nearest_px, 5 * scale) << "the paper's way is no better";
        }
        EXPECT_EQ(steps.smooth.size(), image.size());
        EXPECT_EQ(steps.edges.size(), image.size());
        const int edges = cv::countNonZero(steps.edges);
        EXPECT_GT(edges, 500 * scale * scale);
        EXPECT_EQ(edges, cv::countNonZero(steps.edges == 255)) << "0 or 255";
    }
}

TEST(TangSteps, FindNoneOnABareFloorAndDrawNoneThen) {
    const MarkerView view = view_of_qr();
    const cv::Mat bare(512, 640, CV_8U, cv::Scalar(120));
    const TangSteps steps = tang_steps(bare, view.camera, 0.060);
    EXPECT_FALSE(steps.corners);
    EXPECT_FALSE(tang_corners(bare, view.camera, 0.060));
    const cv::Mat picture = tang_picture(bare, steps, view.camera);
    EXPECT_EQ(picture.type(), CV_8UC3);
    // Forwards is up and to the right as the camera is mounted; elsewhere the floor is as it was.
    EXPECT_EQ(picture.at<cv::Vec3b>(20, 20), cv::Vec3b(120, 120, 120));
    EXPECT_EQ(picture.at<cv::Vec3b>(256, 420), cv::Vec3b(0xe0, 0x66, 0x1a)) << "its x axis";
}

}  // namespace
}  // namespace pulseline::vision
