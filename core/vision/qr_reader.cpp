#include "core/vision/qr_reader.hpp"

#define ZX_USE_UTF8 1
#include <ZXing/ReadBarcode.h>

#include <cmath>
#include <complex>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/vision/edge_fit.hpp"
#include "core/vision/finder_search.hpp"

namespace pulseline::vision {
namespace {

// Finder and timing patterns must be there: 90 % leaves room for dirt, a wrong grid matches half.
constexpr double kFixedPatternShare = 0.9;
// How far zxing's whole-pixel corners may be off in scale.
constexpr double kRoughScaleError = 0.05;
constexpr const char* kScaleOff =
    "The code has not the expected size. Check print and camera height.";

ZXing::Result decode(const cv::Mat& grey, bool thorough) {
    const ZXing::ImageView view(grey.data, grey.cols, grey.rows, ZXing::ImageFormat::Lum,
                                static_cast<int>(grey.step));
    return ZXing::ReadBarcode(view, ZXing::DecodeHints()
                                        .setFormats(ZXing::BarcodeFormat::QRCode)
                                        .setTryHarder(thorough)
                                        .setTryRotate(false)
                                        .setTryDownscale(false));
}

struct Located {
    std::string payload;
    bool mirrored = false;
    CodePlacement placement;
};

/// Similarity through the four corners of the printed outline (never a reflection).
CodePlacement placement_from(const plant::Camera& camera, const std::array<Pixel, 4>& corners) {
    const double h = kModules / 2.0;
    const std::array<std::complex<double>, 4> model{{{-h, -h}, {h, -h}, {h, h}, {-h, h}}};
    std::complex<double> centre;
    std::complex<double> turn;
    for (std::size_t i = 0; i < 4; ++i) {
        const Pixel p = undistorted(camera, corners[i]);
        centre += std::complex(p.u, p.v) / 4.0;
        turn += std::complex(p.u, p.v) * std::conj(model[i]) / (8 * h * h);
    }
    return {{centre.real(), centre.imag()}, std::arg(turn), std::abs(turn)};
}

/// `shrink`: how much smaller the image is that was decoded.
std::optional<Located> from_decoder(const ZXing::Result& found, const plant::Camera& camera,
                                    int shrink) {
    if (!found.isValid()) return std::nullopt;
    std::array<Pixel, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) {
        // zxing truncates; pixel (i, j) covers [i, i + 1) there and is centred at integers here.
        const auto p = found.position()[static_cast<int>(i)];
        corners[i] = {shrink * (p.x + 0.5) - 0.5, shrink * (p.y + 0.5) - 0.5};
    }
    return Located{found.text(), found.isMirrored(), placement_from(camera, corners)};
}

/// Decodes the modules themselves, drawn afresh without dirt, noise and turn.
std::optional<Located> from_modules(const cv::Mat& grey, const plant::Camera& camera,
                                    const CodePlacement& placement) {
    const ModuleGrid modules(grey, camera, placement);
    if (modules.fixed_pattern_share() < kFixedPatternShare) return std::nullopt;
    constexpr int kDraw = 4;   // pixels per module
    constexpr int kQuiet = 4;  // modules
    cv::Mat drawn((kModules + 2 * kQuiet) * kDraw, (kModules + 2 * kQuiet) * kDraw, CV_8U,
                  cv::Scalar(255));
    for (int row = 0; row < kModules; ++row)
        for (int column = 0; column < kModules; ++column)
            if (modules.dark(row, column))
                drawn(cv::Rect((column + kQuiet) * kDraw, (row + kQuiet) * kDraw, kDraw, kDraw)) =
                    0;
    const ZXing::Result found = decode(drawn, true);
    // Standing on another side means that the search took the wrong three corners.
    if (!found.isValid() || std::abs(found.orientation()) > 45) return std::nullopt;
    return Located{found.text(), found.isMirrored(), placement};
}

/// The half-size image is three times as fast and finds more (vision.md section 3); dirty finder
/// patterns need our own search; the full size is left for codes of another size.
std::optional<Located> locate(const cv::Mat& grey, const plant::Camera& camera,
                              double expected_module_px) {
    cv::Mat half;
    cv::resize(grey, half, cv::Size(grey.cols / 2, grey.rows / 2), 0, 0, cv::INTER_AREA);
    if (auto found = from_decoder(decode(half, false), camera, 2)) return found;
    for (const CodePlacement& placement : search_finders(grey, camera, expected_module_px))
        if (auto found = from_modules(grey, camera, placement)) return found;
    return from_decoder(decode(grey, true), camera, 1);
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

    const CodePlacement& start = located->placement;
    const double rough_ratio = start.module_px / expected_px;
    if (std::abs(rough_ratio - 1) > options.max_scale_error + kRoughScaleError)
        return refuse("scale_off", kScaleOff, {{"ratio", rough_ratio}});
    const ModuleGrid rough(grey, camera, start);
    if (rough.fixed_pattern_share() < kFixedPatternShare)
        return refuse("unsupported_symbol", "The modules are not those of a version 1 QR code.");
    const auto fit = fit_edges(grey, camera, rough, start);
    if (!fit) return refuse("fit_poor", "Too few edges of the code are visible.");
    return accept(*fit, located->payload, camera, expected_px, options);
}

geometry::Pose2 body_from_code(const QrReading& reading, const plant::Camera& camera) {
    // Up is -v, that is +y of the camera's floor frame; image angles count clockwise.
    return camera.body_from_camera *
           geometry::Pose2{reading.x_m, -reading.y_m, kPi / 2 - reading.angle_rad};
}

}  // namespace pulseline::vision
