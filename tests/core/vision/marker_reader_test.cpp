#include "core/vision/marker_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <random>
#include <span>

#include "core/localisation/reading_speed.hpp"
#include "tests/core/vision/marker_view.hpp"

namespace pulseline::vision {
namespace {

using plant::MarkerKind;
using simulation::ImageConditions;

class EveryKind : public testing::TestWithParam<MarkerKind> {
protected:
    MarkerView view() const {
        MarkerView v;
        v.kind = GetParam();
        v.payload = v.kind == MarkerKind::kQr ? "ST04-F" : "17";
        return v;
    }
};

TEST_P(EveryKind, IsFoundOnNominalImagesToAHundredthOfAPixel) {
    std::mt19937_64 random{5};
    std::uniform_real_distribution<double> any(-1, 1);
    double squares = 0;
    double angle_squares = 0;
    double chi2 = 0;
    constexpr int kImages = 30;
    for (int i = 0; i < kImages; ++i) {
        MarkerView v = view();
        v.camera.k1 = simulation::sample_k1(random);
        v.conditions = ImageConditions::nominal(random);
        v.camera_from_code = {0.04 * any(random), 0.02 * any(random), kPi * any(random)};
        if (v.kind != MarkerKind::kQr) v.payload = std::to_string(1 + 8 * i);

        const auto reading = v.read();

        ASSERT_TRUE(reading) << i << ": " << reading.error().reason.code;
        EXPECT_EQ(reading->payload, v.payload);
        const double angle = wrap(reading->angle_rad - (kPi / 2 - v.camera_from_code.heading_rad));
        squares += std::pow(v.error_px(*reading), 2);
        angle_squares += angle * angle;
        chi2 += std::pow(v.error_px(*reading) / reading->sigma_px, 2) / 2;
    }
    EXPECT_LT(std::sqrt(squares / kImages), 0.01);
    EXPECT_LT(degrees(std::sqrt(angle_squares / kImages)), 0.0025);
    // An honest sigma: neither boastful nor useless.
    EXPECT_GT(chi2 / kImages, 0.35);
    EXPECT_LT(chi2 / kImages, 1.8);
}

/// The figure by which vehicles are slowed down over codes: up to it all are read, whatever way the
/// motion goes, and far beyond hardly one. Codes are surely read up to twice as much: the figure
/// leaves room for what else a floor does to a picture.
TEST_P(EveryKind, IsReadThroughTheSmearThatSpeedsReckonWith) {
    std::mt19937_64 random{11};
    std::uniform_real_distribution<double> any(-1, 1);
    constexpr int kImages = 20;
    for (const double times : {1.0, 2.0, 20.0}) {
        const double smear_px = times * localisation::kMostSmear_px;
        int read = 0;
        for (int i = 0; i < kImages; ++i) {
            MarkerView v = view();
            v.conditions = ImageConditions::nominal(random);
            v.conditions.motion_blur_px = smear_px;
            v.conditions.motion_direction_rad = kPi * any(random);
            v.camera_from_code = {0.04 * any(random), 0.02 * any(random), kPi * any(random)};
            const auto reading = v.read();
            read += reading && reading->payload == v.payload;
        }
        std::printf("[ smear    ] %s, %.0f px: %d of %d read\n", plant::to_string(GetParam()),
                    smear_px, read, kImages);
        if (times <= 2) {
            EXPECT_EQ(read, kImages);
        }
        if (times == 20) {
            EXPECT_LE(read, kImages / 10);
        }
    }
}

TEST_P(EveryKind, NeverLiesOnHardImages) {
    std::mt19937_64 random{77};
    std::uniform_real_distribution<double> any(-1, 1);
    int found = 0;
    constexpr int kImages = 30;
    for (int i = 0; i < kImages; ++i) {
        MarkerView v = view();
        v.camera.k1 = simulation::sample_k1(random);
        v.conditions = ImageConditions::hard(random);
        v.camera_from_code = {0.03 * any(random), 0.02 * any(random), kPi * any(random)};
        const auto reading = v.read();
        if (!reading) continue;
        ++found;
        EXPECT_EQ(reading->payload, v.payload) << i;
        EXPECT_LT(v.error_px(*reading), 0.3) << i;
    }
    EXPECT_GE(found, 24);
}

TEST_P(EveryKind, IsRefusedWhenPrintedInAnotherSize) {
    MarkerView v = view();
    v.size_m = 0.84 * plant::usual_size_m(v.kind);
    const auto reading = v.read();
    ASSERT_FALSE(reading);
    EXPECT_EQ(reading.error().reason.code, "scale_off");
}

TEST_P(EveryKind, AMirroredPrintIsNeverReadAsItself) {
    MarkerView v = view();
    v.mirrored = true;
    const auto reading = v.read();
    if (v.kind == MarkerKind::kLandmark) {
        // Symmetric dots, no checksum: it is another landmark, which the survey refuses.
        ASSERT_TRUE(reading);
        EXPECT_NE(reading->payload, v.payload);
    } else {
        ASSERT_FALSE(reading);
        EXPECT_EQ(reading.error().reason.code, "mirrored");
    }
}

TEST_P(EveryKind, KnowsItsCameraIsTiltedWhenCalibratedSo) {
    MarkerView v = view();
    v.camera.tilt_u_rad = radians(1.5);
    v.camera.tilt_v_rad = radians(-0.8);
    const auto reading = v.read();
    ASSERT_TRUE(reading) << reading.error().reason.code;
    EXPECT_NEAR(reading->x_m, v.camera_from_code.x_m, 2e-6);
    EXPECT_NEAR(-reading->y_m, v.camera_from_code.y_m, 2e-6);
    EXPECT_NEAR(wrap(reading->angle_rad - (kPi / 2 - v.camera_from_code.heading_rad)), 0, 3e-5);
}

// Integrity: what could move the centre without a word is refused with its reason.

TEST_P(EveryKind, ACameraThatHangsAskewIsRefused) {
    MarkerView v = view();
    plant::Camera askew = v.camera;
    askew.tilt_u_rad = radians(2.0);
    askew.tilt_v_rad = radians(1.5);
    // Under its foot, as the reader takes it to lie.
    const auto axis = simulation::FloorProjection(askew, {}).floor_from_image({639.5, 511.5});
    v.camera = askew;
    v.camera_from_code = {axis.x_m, axis.y_m, 1.2};
    const auto reading = read_marker(v.kind, v.image(), plant::Camera{});
    ASSERT_FALSE(reading);
    EXPECT_EQ(reading.error().reason.code, "tilt_off");
}

TEST_P(EveryKind, AStretchedPrintIsRefused) {
    const MarkerView v = view();
    const cv::Mat image = v.image();
    ASSERT_TRUE(read_marker(v.kind, image, v.camera));
    // One printer's axis 2 % longer than the other: a homography's centre and a similarity's part.
    cv::Mat stretched;
    const cv::Matx23d stretch(1.01, 0, -0.01 * 639.5, 0, 0.99, 0.01 * 511.5);
    cv::warpAffine(image, stretched, stretch, image.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    const auto reading = read_marker(v.kind, stretched, v.camera);
    ASSERT_FALSE(reading);
    EXPECT_EQ(reading.error().reason.code, "fit_poor");
}

TEST_P(EveryKind, AWavyPrintIsRefused) {
    const MarkerView v = view();
    const cv::Mat image = v.image();
    cv::Mat map_u(image.size(), CV_32F);
    cv::Mat map_v(image.size(), CV_32F);
    for (int row = 0; row < image.rows; ++row) {
        for (int column = 0; column < image.cols; ++column) {
            map_u.at<float>(row, column) = static_cast<float>(column + 1.5 * std::sin(row / 25.0));
            map_v.at<float>(row, column) = static_cast<float>(row + 1.5 * std::sin(column / 25.0));
        }
    }
    cv::Mat wavy;
    cv::remap(image, wavy, map_u, map_v, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    const auto reading = read_marker(v.kind, wavy, v.camera);
    ASSERT_FALSE(reading);
    EXPECT_EQ(reading.error().reason.code, "fit_poor");
}

TEST_P(EveryKind, ImagesWithoutOneAreRefused) {
    const MarkerView v = view();
    const plant::Camera& c = v.camera;
    cv::Mat noise(c.height_px, c.width_px, CV_8U);
    cv::RNG(4).fill(noise, cv::RNG::UNIFORM, 0, 256);
    for (const cv::Mat& image : {cv::Mat(c.height_px, c.width_px, CV_8U, cv::Scalar(0)),
                                 cv::Mat(c.height_px, c.width_px, CV_8U, cv::Scalar(255)), noise}) {
        const auto reading = read_marker(v.kind, image, c);
        ASSERT_FALSE(reading);
        EXPECT_EQ(reading.error().reason.code, "no_code");
    }
    for (const cv::Mat& image :
         {cv::Mat(), cv::Mat(64, 64, CV_8U), cv::Mat(c.height_px, c.width_px, CV_8UC3)}) {
        const auto reading = read_marker(v.kind, image, c);
        ASSERT_FALSE(reading);
        EXPECT_EQ(reading.error().reason.code, "bad_image");
    }
}

TEST_P(EveryKind, ImagesOfAnySizeAreRefusedWhenNothingIsOnThem) {
    for (const int width : {1, 2, 3, 5, 7, 8, 15, 31, 64, 200}) {
        for (const int height : {1, 2, 3, 5, 7, 8, 15, 31, 64, 200}) {
            plant::Camera camera;
            camera.width_px = width;
            camera.height_px = height;
            cv::Mat image(height, width, CV_8U);
            cv::RNG(4).fill(image, cv::RNG::UNIFORM, 0, 256);
            const auto reading = read_marker(GetParam(), image, camera);
            ASSERT_FALSE(reading);
            EXPECT_EQ(reading.error().reason.code, "no_code") << width << " x " << height;
        }
    }
}

TEST_P(EveryKind, AMarkerOfAnotherKindIsNotTakenForIt) {
    for (const MarkerKind other : {MarkerKind::kQr, MarkerKind::kAprilTag, MarkerKind::kLandmark}) {
        if (other == GetParam()) continue;
        MarkerView v = view();
        v.kind = other;
        v.payload = other == MarkerKind::kQr ? "ST04-F" : "17";
        EXPECT_FALSE(read_marker(GetParam(), v.image(), v.camera));
    }
}

ReaderOptions expecting(const geometry::Pose2& body_from_marker) {
    ReaderOptions options;
    options.expected = ExpectedMarker{body_from_marker};
    return options;
}

TEST_P(EveryKind, OneThatIsExpectedIsPlacedAsWell) {
    MarkerView v = view();
    v.camera.body_from_camera = {5.3, 0.1, 0.7};
    v.camera.k1 = -0.1;
    const auto body_from_marker = v.camera.body_from_camera * v.camera_from_code;
    v.conditions.seed = 3;
    const std::vector<simulation::FloorCode> codes{
        {v.payload, body_from_marker, v.code().size_m, false, v.kind}};
    const cv::Mat image = simulation::render_floor(v.camera, {}, codes, v.conditions);
    const auto anywhere = read_marker(v.kind, image, v.camera);
    ASSERT_TRUE(anywhere);
    const auto expected =
        read_marker(v.kind, image, v.camera,
                    expecting(body_from_marker * geometry::Pose2{0.008, -0.006, 0.012}));
    ASSERT_TRUE(expected) << expected.error().reason.code;
    EXPECT_EQ(expected->payload, v.payload);
    EXPECT_NEAR(expected->centre.u, anywhere->centre.u, 0.01);
    EXPECT_NEAR(expected->centre.v, anywhere->centre.v, 0.01);
    EXPECT_NEAR(expected->angle_rad, anywhere->angle_rad, 1e-5);
}

TEST_P(EveryKind, AWrongExpectationHidesNoMarker) {
    const MarkerView v = view();
    const cv::Mat image = v.image();
    for (const geometry::Pose2 off : {geometry::Pose2{0.04, 0, 0},
                                      {0, 0, kPi},
                                      {3, -7, 0.2},
                                      {0.09, 0.07, 0.1},
                                      {1e9, 1e9, 1e9}}) {
        const auto reading =
            read_marker(v.kind, image, v.camera, expecting(v.camera_from_code * off));
        ASSERT_TRUE(reading) << off.x_m << " " << off.y_m;
        EXPECT_EQ(reading->payload, v.payload);
    }
}

/// A grey sheet over part of the marker; marker coordinates of the print: right and down, 1 is half
/// its side.
void cover(cv::Mat& image, const MarkerReading& marker, cv::Rect2d part) {
    const Pixel right =
        0.25 * (marker.corners[1] - marker.corners[0] + marker.corners[2] - marker.corners[3]);
    const Pixel down{-right.v, right.u};
    std::vector<cv::Point> corners;
    for (const auto& [a, b] : {std::pair{part.x, part.y},
                               {part.x + part.width, part.y},
                               {part.x + part.width, part.y + part.height},
                               {part.x, part.y + part.height}}) {
        const Pixel p = marker.centre + a * right + b * down;
        corners.emplace_back(static_cast<int>(p.u), static_cast<int>(p.v));
    }
    cv::fillConvexPoly(image, corners, cv::Scalar(150));
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind,
                         testing::Values(MarkerKind::kQr, MarkerKind::kAprilTag,
                                         MarkerKind::kLandmark),
                         [](const auto& param) { return plant::to_string(param.param); });

/// Reads of twelve views with parts of the print covered, where it is expected and anywhere.
struct Reads {
    int expected = 0;
    int anywhere = 0;
};
Reads read_covered(MarkerView v, std::span<const cv::Rect2d> parts) {
    Reads reads;
    for (int i = 0; i < 12; ++i) {
        v.camera_from_code.heading_rad = 0.5 * i;
        v.conditions.seed = static_cast<std::uint64_t>(i);
        cv::Mat image = v.image();
        const auto whole = read_marker(v.kind, image, v.camera);
        if (!whole) continue;
        for (const auto& part : parts) cover(image, *whole, part);
        const auto off = geometry::Pose2{0.004, -0.003, 0.008};
        const auto reading =
            read_marker(v.kind, image, v.camera, expecting(v.camera_from_code * off));
        reads.anywhere += read_marker(v.kind, image, v.camera).has_value();
        reads.expected += reading && reading->payload == v.payload && v.error_px(*reading) < 0.1;
    }
    return reads;
}

TEST(ReadExpected, OneFinderSuffices) {
    MarkerView v;
    v.kind = MarkerKind::kQr;
    v.payload = "ST04-F";
    const cv::Rect2d finders[] = {{-1.1, -1.1, 0.8, 0.8}, {0.3, -1.1, 0.8, 0.8}};
    const Reads reads = read_covered(v, finders);
    EXPECT_GE(reads.expected, 11);
    EXPECT_LE(reads.anywhere, 1);
}

TEST(ReadExpected, ThreeDotsSuffice) {
    MarkerView v;
    v.kind = MarkerKind::kLandmark;
    const cv::Rect2d dots[] = {{-0.12, -0.57, 0.24, 0.24}, {-0.47, -0.32, 0.24, 0.24}};
    const Reads reads = read_covered(v, dots);
    EXPECT_GE(reads.expected, 11);
    EXPECT_LE(reads.anywhere, 1);
}

TEST(ReadMarkers, FindsBothTagsOfOneView) {
    const plant::Camera camera;
    const std::vector<simulation::FloorCode> codes{
        {"3", {-0.045, 0.01, 0.4}, 0.050, false, MarkerKind::kAprilTag},
        {"250", {0.045, -0.01, -1.0}, 0.050, false, MarkerKind::kAprilTag}};
    const cv::Mat image = simulation::render_floor(camera, {}, codes, {});
    const auto first = read_marker(MarkerKind::kAprilTag, image, camera);
    ASSERT_TRUE(first);
    auto found = read_others(*first, image, camera);
    ASSERT_EQ(found.size(), 1U);
    found.push_back(*first);
    std::ranges::sort(found, {}, &MarkerReading::x_m);
    EXPECT_EQ(found[0].payload, "3");
    EXPECT_EQ(found[1].payload, "250");
    EXPECT_NEAR(found[1].x_m, 0.045, 5e-6);
}

TEST(ReadLandmark, LightThatClipsThePaperIsNoGlare) {
    MarkerView v;
    v.kind = MarkerKind::kLandmark;
    for (const double exposure : {0.95, 1.0, 1.05, 1.1, 1.15}) {
        for (const int payload : {1, 85, 127}) {
            v.payload = std::to_string(payload);
            v.conditions.exposure = exposure;
            v.conditions.gradient_u = 0.1;
            v.conditions.seed = static_cast<std::uint64_t>(payload);
            const auto reading = v.read();
            ASSERT_TRUE(reading) << exposure << " " << payload << ": "
                                 << reading.error().reason.code;
            EXPECT_EQ(reading->payload, v.payload) << exposure;
        }
    }
}

TEST(ReadLandmark, GlareOverASectorIsRefusedNotGuessed) {
    MarkerView v;
    v.kind = MarkerKind::kLandmark;
    v.payload = "85";
    v.camera_from_code = {0, 0, kPi / 2};
    v.conditions.exposure = 0.7;
    const cv::Mat image = v.image();
    const double px = pixels_per_metre(v.camera);
    for (int k = 0; k < 8; ++k) {
        cv::Mat spoilt = image.clone();
        const double t = (k + 0.5) * kPi / 4;
        const Pixel at = v.true_centre() + 0.035 * px * Pixel{std::sin(t), -std::cos(t)};
        cv::circle(spoilt, {static_cast<int>(at.u), static_cast<int>(at.v)}, 130, cv::Scalar(255),
                   -1);
        const auto reading = read_marker(v.kind, spoilt, v.camera);
        if (reading) {
            EXPECT_EQ(reading->payload, "85") << k;
        }
    }
}

}  // namespace
}  // namespace pulseline::vision
