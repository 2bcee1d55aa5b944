#include "core/vision/qr/qr_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "core/simulation/world/floor_camera.hpp"

namespace pulseline::vision {
namespace {

using geometry::Pose2;
using simulation::FloorCode;
using simulation::ImageConditions;

/// A rendered view: the vehicle stands at the origin, so hall and body frame are one.
struct View {
    plant::Camera camera;
    Pose2 camera_from_code{0.004, -0.003, 1.2};
    std::string payload = "ST04-F";
    double size_m = 0.060;
    bool mirrored = false;
    ImageConditions conditions;

    cv::Mat image() const {
        const std::vector<FloorCode> codes{{payload, camera_from_code, size_m, mirrored}};
        return simulation::render_floor(camera, {}, codes, conditions);
    }
    Pixel true_centre() const {
        return simulation::FloorProjection(camera, conditions)
            .image_from_floor(camera_from_code.position());
    }
};

double error_px(const QrReading& reading, const View& view) {
    const Pixel d = reading.centre - view.true_centre();
    return std::hypot(d.u, d.v);
}

TEST(ReadQr, FindsEveryNominalCodeToAHundredthOfAPixel) {
    std::mt19937_64 random{5};
    std::uniform_real_distribution<double> any(-1, 1);
    double squares = 0;
    double angle_squares = 0;
    const int images = 60;
    for (int i = 0; i < images; ++i) {
        View view;
        view.camera.k1 = simulation::sample_k1(random);
        view.conditions = ImageConditions::nominal(random);
        view.camera_from_code = {0.04 * any(random), 0.025 * any(random), kPi * any(random)};
        view.payload = i % 2 == 0 ? "ST07-F" : "ST12-B";

        const auto reading = read_qr(view.image(), view.camera);

        ASSERT_TRUE(reading) << "image " << i << ": " << reading.error().reason.code;
        EXPECT_EQ(reading->payload, view.payload);
        EXPECT_NEAR(reading->scale_ratio, 1, 1e-3);
        const double angle =
            wrap(reading->angle_rad - (kPi / 2 - view.camera_from_code.heading_rad));
        squares += std::pow(error_px(*reading, view), 2);
        angle_squares += angle * angle;
        EXPECT_LT(error_px(*reading, view), 6 * reading->sigma_px) << "image " << i;
    }
    EXPECT_LT(std::sqrt(squares / images), 0.01);
    EXPECT_LT(degrees(std::sqrt(angle_squares / images)), 0.002);
}

TEST(ReadQr, ACodeInTheCornerOfTheImageIsReadAsWell) {
    for (const double side_u : {-1, 1}) {
        for (const double side_v : {-1, 1}) {
            View view;
            view.camera.k1 = -0.1;
            view.camera_from_code = {side_u * 0.055, side_v * 0.038, kPi / 2};
            const auto reading = read_qr(view.image(), view.camera);
            ASSERT_TRUE(reading) << reading.error().reason.code;
            EXPECT_LT(error_px(*reading, view), 0.01);
        }
    }
}

TEST(ReadQr, NeverLiesAboutACodeThatLeavesTheImage) {
    for (double beyond_m = 0; beyond_m < 0.04; beyond_m += 0.004) {
        View view;
        view.camera_from_code = {0.0585 + beyond_m, 0, 1.55};
        const auto reading = read_qr(view.image(), view.camera);
        if (reading) {
            EXPECT_LT(error_px(*reading, view), 0.05) << beyond_m;
            EXPECT_LE(beyond_m, 0.016);
        }
    }
}

TEST(ReadQr, NeverLiesAboutACodePartlyCovered) {
    int refused = 0;
    for (int covered_px = 40; covered_px <= 360; covered_px += 40) {
        View view;
        cv::Mat image = view.image();
        const Pixel c = view.true_centre();
        cv::rectangle(
            image,
            {static_cast<int>(c.u) - 220, static_cast<int>(c.v) - 220, covered_px, covered_px},
            cv::Scalar(70), -1);
        const auto reading = read_qr(image, view.camera);
        refused += reading ? 0 : 1;
        if (reading) {
            EXPECT_EQ(reading->payload, view.payload);
            EXPECT_LT(error_px(*reading, view), 0.05) << covered_px;
        }
    }
    EXPECT_GE(refused, 4);
}

TEST(ReadQr, ReadsACodeWithDirtOnItsFinderPatterns) {
    const View view;
    const cv::Mat clean = view.image();
    const auto reference = read_qr(clean, view.camera);
    ASSERT_TRUE(reference);
    for (const std::size_t corner : {0U, 1U, 3U}) {
        const Pixel in = 0.86 * (reference->corners[corner] - reference->centre);
        cv::Mat image = clean.clone();
        cv::circle(image,
                   {static_cast<int>(reference->centre.u + in.u),
                    static_cast<int>(reference->centre.v + in.v)},
                   16, cv::Scalar(150), -1);
        const auto reading = read_qr(image, view.camera);
        ASSERT_TRUE(reading) << corner << ": " << reading.error().reason.code;
        EXPECT_EQ(reading->payload, view.payload);
        EXPECT_LT(error_px(*reading, view), 0.02);
    }
}

TEST(ReadQr, RefusesAMirroredCode) {
    View view;
    view.mirrored = true;
    const auto reading = read_qr(view.image(), view.camera);
    ASSERT_FALSE(reading);
    EXPECT_EQ(reading.error().reason.code, "mirrored");
}

TEST(ReadQr, RefusesACodeOfTheWrongSize) {
    View view;
    view.size_m = 0.050;
    const auto reading = read_qr(view.image(), view.camera);
    ASSERT_FALSE(reading);
    EXPECT_EQ(reading.error().reason.code, "scale_off");
}

TEST(ReadQr, RefusesWhenTheCameraHangsTooLow) {
    View view;
    view.conditions.height_error_m = -0.012;
    const auto reading = read_qr(view.image(), view.camera);
    ASSERT_FALSE(reading);
    EXPECT_EQ(reading.error().reason.code, "scale_off");
}

TEST(ReadQr, RefusesImagesWithoutACode) {
    const plant::Camera camera;
    std::mt19937_64 random{1};
    const cv::Mat floor =
        simulation::render_floor(camera, {}, {}, ImageConditions::nominal(random));
    const cv::Mat black(camera.height_px, camera.width_px, CV_8U, cv::Scalar(0));
    const cv::Mat white(camera.height_px, camera.width_px, CV_8U, cv::Scalar(255));
    cv::Mat noise(camera.height_px, camera.width_px, CV_8U);
    cv::RNG(4).fill(noise, cv::RNG::UNIFORM, 0, 256);
    for (const cv::Mat& image : {floor, black, white, noise}) {
        const auto reading = read_qr(image, camera);
        ASSERT_FALSE(reading);
        EXPECT_EQ(reading.error().reason.code, "no_code");
    }
}

TEST(ReadQr, RefusesAnImageThatIsNotTheCameras) {
    const plant::Camera camera;
    for (const cv::Mat& image : {cv::Mat(), cv::Mat(512, 640, CV_8U),
                                 cv::Mat(camera.height_px, camera.width_px, CV_8UC3)}) {
        const auto reading = read_qr(image, camera);
        ASSERT_FALSE(reading);
        EXPECT_EQ(reading.error().reason.code, "bad_image");
    }
}

}  // namespace
}  // namespace pulseline::vision
