// Whatever lies on an image and wherever its borders cut it, the readers answer: a reading of
// finite numbers or a refusal. PULSELINE_IMAGES: so many images a kind.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <random>

#include "tests/core/vision/marker_view.hpp"

namespace pulseline::vision {
namespace {

using plant::MarkerKind;
using Random = std::mt19937_64;

constexpr std::array<MarkerKind, 3> kKinds{MarkerKind::kQr, MarkerKind::kAprilTag,
                                           MarkerKind::kLandmark};

int images_a_kind() {
    const char* wanted = std::getenv("PULSELINE_IMAGES");
    return wanted != nullptr ? std::max(1, std::atoi(wanted)) : 200;
}

double any(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}
int whole(Random& random, int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
}

/// Half the usual size, so that many images take little time.
plant::Camera small_camera() {
    plant::Camera camera;
    camera.width_px /= 2;
    camera.height_px /= 2;
    camera.f_px /= 2;
    camera.cu_px = (camera.width_px - 1) / 2.0;
    camera.cv_px = (camera.height_px - 1) / 2.0;
    return camera;
}

MarkerView any_view(MarkerKind kind, Random& random) {
    MarkerView view;
    view.kind = kind;
    view.payload = kind == MarkerKind::kQr ? "ST0" + std::to_string(whole(random, 1, 9)) + "-F"
                                           : std::to_string(whole(random, 1, 254));
    view.camera = small_camera();
    view.camera.k1 = simulation::sample_k1(random);
    view.conditions = whole(random, 0, 1) == 0 ? simulation::ImageConditions::nominal(random)
                                               : simulation::ImageConditions::hard(random);
    view.conditions.seed = random();
    view.mirrored = whole(random, 0, 9) == 0;
    view.camera_from_code = {any(random, -0.06, 0.06), any(random, -0.05, 0.05),
                             any(random, -kPi, kPi)};
    return view;
}

/// Cuts the image so that its left, right, upper or lower border, or two of them, go through the
/// marker or close by.
void crop(cv::Mat& image, plant::Camera& camera, const MarkerView& view, Random& random) {
    const Pixel middle = view.true_centre();
    const double size_px = view.code().size_m * pixels_per_metre(camera);
    int left = 0, top = 0, right = image.cols, bottom = image.rows;
    const auto cut = [&](double at) {
        return static_cast<int>(std::lround(at + any(random, -0.75, 0.75) * size_px));
    };
    const int borders = whole(random, 1, 15);
    if ((borders & 1) != 0) left = cut(middle.u - size_px / 2);
    if ((borders & 2) != 0) right = cut(middle.u + size_px / 2);
    if ((borders & 4) != 0) top = cut(middle.v - size_px / 2);
    if ((borders & 8) != 0) bottom = cut(middle.v + size_px / 2);
    left = std::clamp(left, 0, image.cols - 1);
    top = std::clamp(top, 0, image.rows - 1);
    right = std::clamp(right, left + 1, image.cols);
    bottom = std::clamp(bottom, top + 1, image.rows);
    // A copy, so that the memory ends where the image does.
    image = image(cv::Rect(left, top, right - left, bottom - top)).clone();
    camera.width_px = image.cols;
    camera.height_px = image.rows;
    camera.cu_px -= left;
    camera.cv_px -= top;
}

/// Specks, bars and sheets of any grey, a blur or noise.
void damage(cv::Mat& image, Random& random) {
    const auto place = [&] {
        return cv::Point(whole(random, -20, image.cols + 20), whole(random, -20, image.rows + 20));
    };
    const auto grey = [&] { return cv::Scalar(whole(random, 0, 255)); };
    for (int i = whole(random, 0, 6); i > 0; --i)
        cv::circle(image, place(), whole(random, 1, 30), grey(), -1);
    if (whole(random, 0, 3) == 0) cv::line(image, place(), place(), grey(), whole(random, 1, 25));
    if (whole(random, 0, 3) == 0) cv::rectangle(image, place(), place(), grey(), -1);
    if (whole(random, 0, 5) == 0) cv::GaussianBlur(image, image, {}, any(random, 0.5, 4));
    if (whole(random, 0, 5) == 0) {
        cv::Mat noise(image.size(), CV_8U);
        cv::RNG(random()).fill(noise, cv::RNG::UNIFORM, 0, whole(random, 2, 120));
        image += noise;
    }
}

void expect_finite(const MarkerReading& reading) {
    EXPECT_TRUE(std::isfinite(reading.x_m) && std::isfinite(reading.y_m) &&
                std::isfinite(reading.angle_rad) && std::isfinite(reading.sigma_px) &&
                std::isfinite(reading.sigma_angle_rad) && std::isfinite(reading.centre.u) &&
                std::isfinite(reading.centre.v));
}

class AnyImage : public testing::TestWithParam<MarkerKind> {};

TEST_P(AnyImage, IsReadOrRefusedByEveryReader) {
    const int images = images_a_kind();
    int readings = 0;
    for (int i = 0; i < images; ++i) {
        SCOPED_TRACE(i);
        Random random(static_cast<std::uint64_t>(i) * 3 + static_cast<std::uint64_t>(GetParam()));
        const MarkerView view = any_view(GetParam(), random);
        plant::Camera camera = view.camera;
        cv::Mat image = view.image();
        if (whole(random, 0, 9) != 0) crop(image, camera, view, random);
        if (whole(random, 0, 2) != 0) damage(image, random);
        for (const MarkerKind kind : kKinds) {
            const auto reading = read_marker(kind, image, camera);
            if (!reading) {
                EXPECT_FALSE(reading.error().reason.code.empty());
                continue;
            }
            ++readings;
            expect_finite(*reading);
            for (const auto& other : read_others(*reading, image, camera)) expect_finite(other);
        }
        ReaderOptions options;
        options.expected =
            ExpectedMarker{view.camera_from_code * geometry::Pose2{any(random, -0.01, 0.01),
                                                                   any(random, -0.01, 0.01),
                                                                   any(random, -0.02, 0.02)}};
        if (const auto reading = read_marker(view.kind, image, camera, options))
            expect_finite(*reading);
    }
    EXPECT_GT(readings, images / 10);  // or nothing was tested but refusals
}

/// Lenses, heights and sizes that no camera and no print has, but a file can name.
TEST_P(AnyImage, IsReadOrRefusedThroughAnyLens) {
    for (int i = 0; i < std::max(10, images_a_kind() / 10); ++i) {
        SCOPED_TRACE(i);
        Random random(static_cast<std::uint64_t>(i));
        const MarkerView view = any_view(GetParam(), random);
        const cv::Mat image = view.image();
        plant::Camera camera = view.camera;
        camera.f_px *= std::pow(10, any(random, -2.5, 2.5));
        camera.height_m = std::pow(10, any(random, -2, 2));
        camera.k1 = any(random, -10, 10);
        camera.cu_px += any(random, -300, 300);
        camera.tilt_u_rad = any(random, -0.5, 0.5);
        ReaderOptions options;
        if (i % 2 == 0) options.size_m = std::pow(10, any(random, -6, 3));
        if (i % 3 == 0) {
            options.expected = ExpectedMarker{
                {std::pow(10, any(random, -3, 300)), any(random, -1, 1), any(random, -100, 100)}};
        }
        if (const auto reading = read_marker(view.kind, image, camera, options))
            expect_finite(*reading);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, AnyImage, testing::ValuesIn(kKinds),
                         [](const auto& param) { return plant::to_string(param.param); });

}  // namespace
}  // namespace pulseline::vision
