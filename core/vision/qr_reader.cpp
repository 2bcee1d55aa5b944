#include "core/vision/qr_reader.hpp"

#define ZX_USE_UTF8 1
#include <ZXing/ReadBarcode.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/vision/edge_fit.hpp"
#include "core/vision/finder_search.hpp"

namespace pulseline::vision {
namespace {

// Finder and timing patterns must be there: 90 % leaves room for dirt, a wrong grid matches half.
constexpr double kFixedPatternShare = 0.9;
constexpr const char* kScaleOff =
    "The code has not the expected size. Check print and camera height.";

/// Search rounds: the usual one first; then a finer image; then other print sizes, only to be able
/// to say that the size is wrong.
struct Round {
    double scale;
    int shrink;
};
constexpr std::array<Round, 4> kRounds{{{1, 8}, {1, 4}, {0.84, 8}, {1.19, 8}}};

struct Located {
    std::string payload;
    bool mirrored = false;
    CodePlacement placement;
    ModuleGrid modules;
};

/// Decodes the sampled modules, drawn afresh without dirt, noise and turn. zxing's own search of
/// the camera image is not used: Debian builds it with assertions, and EstimateModuleSize aborts
/// the process on some dirty codes.
std::optional<Located> decode(const cv::Mat& grey, const plant::Camera& camera,
                              const CodePlacement& placement) {
    const ModuleGrid modules(grey, camera, placement);
    if (modules.fixed_pattern_share() < kFixedPatternShare) return std::nullopt;
    constexpr int kDraw = 3;   // pixels per module
    constexpr int kQuiet = 4;  // modules
    cv::Mat drawn((kModules + 2 * kQuiet) * kDraw, (kModules + 2 * kQuiet) * kDraw, CV_8U,
                  cv::Scalar(255));
    for (int row = 0; row < kModules; ++row)
        for (int column = 0; column < kModules; ++column)
            if (fixed_module(row, column).value_or(modules.dark(row, column)))
                drawn(cv::Rect((column + kQuiet) * kDraw, (row + kQuiet) * kDraw, kDraw, kDraw)) =
                    0;
    const ZXing::ImageView view(drawn.data, drawn.cols, drawn.rows, ZXing::ImageFormat::Lum,
                                static_cast<int>(drawn.step));
    const ZXing::Result found =
        ZXing::ReadBarcode(view, ZXing::DecodeHints()
                                     .setFormats(ZXing::BarcodeFormat::QRCode)
                                     .setBinarizer(ZXing::Binarizer::FixedThreshold)
                                     .setIsPure(true));
    if (!found.isValid()) return std::nullopt;
    return Located{found.text(), found.isMirrored(), placement, modules};
}

std::optional<Located> locate(const cv::Mat& grey, const plant::Camera& camera,
                              double expected_module_px) {
    for (const Round& round : kRounds)
        for (const CodePlacement& placement :
             search_finders(grey, camera, round.scale * expected_module_px, round.shrink))
            if (auto found = decode(grey, camera, placement)) return found;
    return std::nullopt;
}

auto refuse(const char* reason, const char* what, Params params = {}) {
    return fail(Errc::kNotFound, reason, what, {}, std::move(params));
}

ReadResult accept(const EdgeFit& fit, const std::string& payload, const plant::Camera& camera,
                  double expected_px, const QrReaderOptions& options) {
    const CodePlacement& place = fit.placement;
    const double ratio = place.module_px / expected_px;
    if (!(std::abs(ratio - 1) <= options.max_scale_error))
        return refuse("scale_off", kScaleOff, {{"ratio", ratio}});
    if (fit.inlier_share < options.min_inlier_share || !(fit.rms_px <= options.max_rms_px) ||
        !(fit.sigma_px <= options.max_sigma_px))
        return refuse("fit_poor",
                      "The edges of the code do not agree on one place. Clean the code.",
                      {{"inlier_share", fit.inlier_share},
                       {"rms_px", fit.rms_px},
                       {"sigma_px", fit.sigma_px}});
    QrReading reading;
    reading.payload = payload;
    reading.centre = distorted(camera, place.centre);
    reading.angle_rad = wrap(place.angle_rad);
    reading.x_m = place.centre.u / pixels_per_metre(camera);
    reading.y_m = place.centre.v / pixels_per_metre(camera);
    reading.sigma_px = fit.sigma_px;
    reading.sigma_angle_rad = fit.sigma_angle_rad;
    reading.rms_px = fit.rms_px;
    reading.inlier_share = fit.inlier_share;
    reading.profiles = fit.profiles;
    reading.scale_ratio = ratio;
    const double h = kModules / 2.0;
    reading.corners = {distorted(camera, place.at(-h, -h)), distorted(camera, place.at(h, -h)),
                       distorted(camera, place.at(h, h)), distorted(camera, place.at(-h, h))};
    return reading;
}

}  // namespace

ReadResult read_qr(const cv::Mat& grey, const plant::Camera& camera,
                   const QrReaderOptions& options) {
    if (grey.type() != CV_8UC1 || grey.cols != camera.width_px || grey.rows != camera.height_px)
        return fail(Errc::kInvalid, "bad_image",
                    "The image is not 8-bit grey of the camera's size. Check the camera file.");
    const double expected_px = options.size_m * pixels_per_metre(camera) / kModules;
    const auto located = locate(grey, camera, expected_px);
    if (!located)
        return refuse("no_code",
                      "No code can be read. Clean the code and the lens, check the light.");
    if (located->mirrored)
        return refuse("mirrored",
                      "The code is mirrored. Print it again; do not copy it through film.");

    const auto fit = fit_edges(grey, camera, located->modules, located->placement);
    if (!fit) return refuse("fit_poor", "Too few edges of the code are visible.");
    return accept(*fit, located->payload, camera, expected_px, options);
}

geometry::Pose2 body_from_code(const QrReading& reading, const plant::Camera& camera) {
    // Up is -v, that is +y of the camera's floor frame; image angles count clockwise.
    return camera.body_from_camera *
           geometry::Pose2{reading.x_m, -reading.y_m, kPi / 2 - reading.angle_rad};
}

}  // namespace pulseline::vision
