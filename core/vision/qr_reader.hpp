#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <string>

#include "core/base/result.hpp"
#include "core/plant/plant.hpp"
#include "core/vision/optics.hpp"

namespace pulseline::vision {

/// A QR code (version 1) found in an image, placed by a fit to all its printed edges.
struct QrReading {
    std::string payload;
    Pixel centre;          // px in the image as given (distorted)
    double angle_rad = 0;  // from +u to +v; 0 when the code stands upright
    double x_m = 0;        // floor plane, from the foot of the optical axis, along +u
    double y_m = 0;        // and along +v
    double sigma_px = 0;   // of the centre, per axis, from the fit
    double sigma_angle_rad = 0;
    double rms_px = 0;        // residual of the edges the fit kept
    double inlier_share = 0;  // of the edge profiles tried
    int profiles = 0;
    double scale_ratio = 1;          // fitted size / expected size
    std::array<Pixel, 4> corners{};  // top left, top right, bottom right, bottom left, in the image
};

struct QrReaderOptions {
    double size_m = 0.060;
    double max_scale_error = 0.015;  // 3 mm of height are 0.7 %
    double min_inlier_share = 0.6;
    double max_rms_px = 0.5;
    double max_sigma_px = 0.05;
};

using ReadResult = Result<QrReading>;

/// Finds, decodes and places the code in an 8-bit grey image of `camera`. Refuses with
/// - bad_image: size or type does not fit the camera
/// - no_code: no version 1 code of about the expected size can be decoded
/// - mirrored: a code printed or seen mirrored
/// - scale_off {ratio}: wrong print size, camera height or tilt
/// - fit_poor {inlier_share, rms_px, sigma_px}: the edges do not agree on one place
/// Whether the payload is the expected one is the caller's business.
ReadResult read_qr(const cv::Mat& grey, const plant::Camera& camera,
                   const QrReaderOptions& options = {});

/// Centre and "up" direction of the code in the body frame.
geometry::Pose2 body_from_code(const QrReading& reading, const plant::Camera& camera);

}  // namespace pulseline::vision
