#include "core/simulation/world/stop_sensor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/localisation/dual_camera.hpp"
#include "core/onboard/code_reading.hpp"
#include "core/plant/marker_geometry.hpp"
#include "core/vision/optics/camera_picture.hpp"

namespace pulseline::simulation {
namespace {

std::vector<plant::Camera> platform_cameras() {
    plant::Camera front;
    front.name = "front";
    front.body_from_camera = {5.346, 0, 0};
    front.k1 = -0.06;
    plant::Camera back = front;
    back.name = "back";
    back.body_from_camera = {-5.346, 0, 0};
    return {front, back};
}

/// A station with its two codes below the cameras of a platform standing there.
struct Stop {
    Pose2 station{50, 20, radians(45)};
    std::vector<FloorCode> codes{{"ST04-F", station* Pose2{5.346, 0, 0.1}},
                                 {"ST04-B", station* Pose2{-5.346, 0, -0.2}}};

    Result<localisation::PoseFix> locate(const StopView& view) const {
        std::vector<localisation::CodeObservation> seen;
        for (const auto& r : view.readings)
            if (r.found) seen.push_back({r.payload, r.code, r.angle_rad, r.sigma_m, 1e-5});
        std::vector<localisation::SurveyedCode> survey;
        for (const auto& c : codes) survey.push_back({c.payload, c.pose, 1e-5, 1e-5});
        return localisation::locate(seen, survey);
    }
};

class SenseStop : public ::testing::TestWithParam<Sensing> {
protected:
    /// One millimetre is much for cameras that were calibrated where they are.
    static SensingOptions calibrated_well() {
        SensingOptions options{GetParam()};
        options.errors = localisation::ErrorBudget::kind();
        return options;
    }
};

TEST_P(SenseStop, PoseOfThirtyStopsIsRightToFiveHundredthsOfAMillimetre) {
    const Stop stop;
    const auto cameras = platform_cameras();
    std::mt19937_64 random{17};
    std::uniform_real_distribution<double> offset_m(-0.030, 0.030);
    std::uniform_real_distribution<double> turn_deg(-0.2, 0.2);
    double worst_m = 0;
    double worst_rad = 0;
    int measured = 0;
    for (int i = 0; i < 30; ++i) {
        const Pose2 truth =
            stop.station * Pose2{offset_m(random), offset_m(random), radians(turn_deg(random))};

        const StopView view = sense_stop(cameras, cameras, truth, stop.codes, {GetParam()}, random);

        ASSERT_EQ(view.readings.size(), 2U);
        EXPECT_EQ(view.images.size(), GetParam() == Sensing::kRendered ? 2U : 0U);
        // At 30 mm and 0.2 deg a turned code may leave the image: 42 mm of room, 19 + 30 used.
        if (!view.readings[0].found || !view.readings[1].found) continue;
        ++measured;
        const auto fix = stop.locate(view);
        ASSERT_TRUE(fix) << fix.error().what;
        worst_m =
            std::max(worst_m, std::hypot(fix->pose.x_m - truth.x_m, fix->pose.y_m - truth.y_m));
        worst_rad = std::max(worst_rad, std::abs(wrap(fix->pose.heading_rad - truth.heading_rad)));
    }
    EXPECT_GE(measured, 20);
    EXPECT_LT(worst_m, 0.05e-3);
    EXPECT_LT(degrees(worst_rad), 0.001);
}

INSTANTIATE_TEST_SUITE_P(BothModes, SenseStop,
                         ::testing::Values(Sensing::kRendered, Sensing::kAnalytic),
                         [](const auto& mode) {
                             return mode.param == Sensing::kRendered ? "Rendered" : "Analytic";
                         });

TEST_P(SenseStop, AWrongMountingShowsInTheReading) {
    const Stop stop;
    const auto calibrated = platform_cameras();
    auto actual = calibrated;
    actual[0].body_from_camera.x_m += 0.001;
    std::mt19937_64 random{2};

    const StopView view =
        sense_stop(actual, calibrated, stop.station, stop.codes, calibrated_well(), random);

    ASSERT_TRUE(view.readings[0].found);
    EXPECT_NEAR(view.readings[0].code.x_m, 5.346 - 0.001, 2e-5);
    const auto fix = stop.locate(view);
    ASSERT_FALSE(fix);
    EXPECT_EQ(fix.error().reason.code, "code_distance_mismatch");
}

TEST_P(SenseStop, ACodeOutOfViewIsReportedWithTheReason) {
    const Stop stop;
    const auto cameras = platform_cameras();
    std::mt19937_64 random{2};

    const StopView view = sense_stop(cameras, cameras, stop.station * Pose2{0, 0.5, 0}, stop.codes,
                                     {GetParam()}, random);

    for (const auto& reading : view.readings) {
        EXPECT_FALSE(reading.found);
        EXPECT_EQ(reading.why_not, "no_code");
    }
}

TEST(SenseStopOfOneCamera, ReadsTheKindItLooksForAmongOthers) {
    const std::vector<plant::Camera> camera{platform_cameras().front()};
    const Pose2 truth{30, 12, radians(70)};
    for (const auto kind : {plant::MarkerKind::kAprilTag, plant::MarkerKind::kLandmark}) {
        SensingOptions options;
        options.look = {kind, plant::usual_size_m(kind)};
        const Pose2 lies = truth * Pose2{5.346 + 0.004, -0.006, 0.3};
        const std::vector<FloorCode> codes{
            {"17", lies, options.look.size_m, false, kind},
            {"ST04-F", truth * Pose2{5.346, 0.5, 0}, 0.060, false, plant::MarkerKind::kQr}};
        std::mt19937_64 random{5};

        const StopView view = sense_stop(camera, camera, truth, codes, options, random);

        ASSERT_TRUE(view.readings[0].found) << view.readings[0].why_not;
        EXPECT_EQ(view.readings[0].payload, "17");
        EXPECT_NEAR(view.readings[0].code.x_m, 5.350, 3e-5);
        EXPECT_NEAR(view.readings[0].code.y_m, -0.006, 3e-5);
        EXPECT_NEAR(view.readings[0].angle_rad, 0.3, 1e-4);
    }
}

TEST(SenseStopOfOneCamera, ReadsTheCodeThatItExpectsOfTwoInView) {
    const std::vector<plant::Camera> camera{platform_cameras().front()};
    const Pose2 truth{30, 12, radians(70)};
    const std::vector<FloorCode> codes{{"ST04-F", truth * Pose2{5.346 + 0.042, 0.01, 0.1}},
                                       {"ST05-F", truth * Pose2{5.346 - 0.042, -0.01, -0.1}}};
    for (const FloorCode& wanted : codes) {
        SensingOptions options;
        options.known = KnownFloor{truth * Pose2{0.008, -0.005, 0.002}, {{wanted.pose, {}}}};
        std::mt19937_64 random{5};
        const StopView view = sense_stop(camera, camera, truth, codes, options, random);
        ASSERT_TRUE(view.readings[0].found) << view.readings[0].why_not;
        EXPECT_EQ(view.readings[0].payload, wanted.payload);
    }
}

TEST_P(SenseStop, ACodeOfAnotherKindOrSizeThanTheSurveySaysIsNotTaken) {
    const Stop stop;
    const auto cameras = platform_cameras();
    for (const plant::UsualCode wrong : {plant::UsualCode{plant::MarkerKind::kQr, 0.050},
                                         plant::UsualCode{plant::MarkerKind::kAprilTag, 0.060}}) {
        SensingOptions options{GetParam()};
        options.known = KnownFloor{stop.station, {}};
        for (const FloorCode& code : stop.codes) {
            options.known->codes.push_back({code.pose, wrong});
        }
        std::mt19937_64 random{2};
        const StopView view =
            sense_stop(cameras, cameras, stop.station, stop.codes, options, random);
        for (const auto& reading : view.readings) {
            EXPECT_FALSE(reading.found) << plant::to_string(wrong.kind) << " " << wrong.size_m;
            EXPECT_EQ(reading.why_not,
                      wrong.kind == plant::MarkerKind::kQr ? "scale_off" : "no_code");
        }
    }
}

TEST(CameraPicture, FitsTheFrameAndKeepsHalfTheSize) {
    const Stop stop;
    const auto cameras = platform_cameras();
    std::mt19937_64 random{9};
    const StopView view = sense_stop(cameras, cameras, stop.station * Pose2{0.01, -0.02, 0.002},
                                     stop.codes, {}, random);
    ASSERT_TRUE(view.readings[0].found);

    const cv::Mat picture =
        vision::annotate(view.images[0], cameras[0], onboard::body_from_code(view.readings[0]));

    EXPECT_EQ(picture.size(), cv::Size(640, 512));
    for (const cv::Mat& image : {picture, view.images[0]}) {
        const auto bytes = vision::encode_jpeg(image, cameras[0]);
        EXPECT_LE(bytes.size(), vision::kMaxPictureBytes);
        ASSERT_GT(bytes.size(), 1000U);
        EXPECT_EQ(bytes[0], 0xFF);
        EXPECT_EQ(bytes[1], 0xD8);
    }
}

TEST(CameraPicture, DrawsTheOffsetDotOverTheCode) {
    const auto cameras = platform_cameras();
    const cv::Mat grey(cameras[0].height_px, cameras[0].width_px, CV_8U, cv::Scalar(128));
    vda5050::CameraReading reading;
    reading.found = true;
    reading.code = {5.346 + 0.020, -0.010};
    reading.angle_rad = kPi / 2;
    const double px_m = 2 / vision::pixels_per_metre(cameras[0]);

    const cv::Mat picture = vision::annotate(grey, cameras[0], onboard::body_from_code(reading));

    const auto dot = picture.at<cv::Vec3b>(static_cast<int>(256 + 0.010 / px_m),
                                           static_cast<int>(320 + 0.020 / px_m));
    EXPECT_EQ(dot, cv::Vec3b(0xe0, 0x66, 0x1a));
}

}  // namespace
}  // namespace pulseline::simulation
