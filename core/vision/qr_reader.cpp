#include "core/vision/qr_reader.hpp"

#define ZX_USE_UTF8 1
#include <ZXing/ReadBarcode.h>

#include <cmath>
#include <complex>
#include <opencv2/imgproc.hpp>

#include "core/vision/edge_fit.hpp"

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
    std::array<Pixel, 4> corners;  // full-size image
};

/// The half-size image is three times as fast and finds more (vision.md section 3).
std::optional<Located> locate(const cv::Mat& grey) {
    cv::Mat half;
    cv::resize(grey, half, cv::Size(grey.cols / 2, grey.rows / 2), 0, 0, cv::INTER_AREA);
    ZXing::Result found = decode(half, false);
    double factor = 2;
    if (!found.isValid()) found = decode(half, true);
    if (!found.isValid()) {
        found = decode(grey, true);
        factor = 1;
    }
    if (!found.isValid()) return std::nullopt;
    Located located{found.text(), found.isMirrored(), {}};
    for (std::size_t i = 0; i < 4; ++i) {
        // zxing truncates; pixel (i, j) covers [i, i + 1) there and is centred at integers here.
        const auto p = found.position()[i];
        located.corners[i] = {factor * (p.x + 0.5) - 0.5, factor * (p.y + 0.5) - 0.5};
    }
    return located;
}

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
    const auto located = locate(grey);
    if (!located)
        return refuse("no_code",
                      "No code can be read. Clean the code and the lens, check the light.");
    if (located->mirrored)
        return refuse("mirrored",
                      "The code is mirrored. Print it again; do not copy it through film.");

    const CodePlacement start = placement_from(camera, located->corners);
    const double expected_px = options.size_m * pixels_per_metre(camera) / kModules;
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
