#include "tests/bench/vision_methods.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zbar.h>
#define ZX_USE_UTF8 1
#include <ZXing/ReadBarcode.h>

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <opencv2/imgproc.hpp>
#ifdef PULSELINE_HAS_ARUCO
#include <opencv2/aruco.hpp>
#endif

#include "core/plant/marker_geometry.hpp"
#include "core/vision/marker_reader.hpp"
#include "core/vision/papers/li_landmark.hpp"
#include "core/vision/papers/tang_corners.hpp"

namespace pulseline::bench {
namespace {

using plant::Camera;
using plant::MarkerKind;
using vision::Pixel;

template <MarkerKind kind>
Outcome pulseline_reader(const cv::Mat& grey, const Camera& camera) {
    return read_ours(kind, grey, camera, {});
}

/// Corners in the order top left, top right, bottom right, bottom left.
Found from_corners(std::string payload, const std::array<Pixel, 4>& c) {
    const Pixel right = (c[1] - c[0]) + (c[2] - c[3]);
    return {std::move(payload), 0.25 * (c[0] + c[1] + c[2] + c[3]), std::atan2(right.v, right.u),
            false, 0};
}

/// zxing 1.4 aborts the process on some camera images, so it gets one of its own.
Outcome zxing_corners(const cv::Mat& grey, const Camera&) {
    struct Answer {
        bool valid = false;
        std::array<double, 8> corners{};
        std::array<char, 64> payload{};
    } answer;
    int ends[2];
    if (pipe(ends) != 0) return {std::nullopt, "pipe"};
    const pid_t child = fork();
    if (child == 0) {
        if (freopen("/dev/null", "w", stderr) == nullptr) _exit(1);
        const ZXing::ImageView view(grey.data, grey.cols, grey.rows, ZXing::ImageFormat::Lum,
                                    static_cast<int>(grey.step));
        const auto r =
            ZXing::ReadBarcode(view, ZXing::DecodeHints().setFormats(ZXing::BarcodeFormat::QRCode));
        if (r.isValid()) {
            answer.valid = true;
            for (std::size_t i = 0; i < 4; ++i) {
                answer.corners[2 * i] = r.position()[static_cast<int>(i)].x;
                answer.corners[2 * i + 1] = r.position()[static_cast<int>(i)].y;
            }
            std::strncpy(answer.payload.data(), r.text().c_str(), answer.payload.size() - 1);
        }
        const auto sent = write(ends[1], &answer, sizeof answer);
        _exit(sent == sizeof answer ? 0 : 1);
    }
    close(ends[1]);
    const auto got = read(ends[0], &answer, sizeof answer);
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    if (got != sizeof answer) return {std::nullopt, "aborted"};
    if (!answer.valid) return {std::nullopt, "no_code"};
    std::array<Pixel, 4> c;
    for (std::size_t i = 0; i < 4; ++i) c[i] = {answer.corners[2 * i], answer.corners[2 * i + 1]};
    return {from_corners(answer.payload.data(), c), ""};
}

Outcome zbar_corners(const cv::Mat& grey, const Camera&) {
    static zbar::ImageScanner scanner = [] {
        zbar::ImageScanner s;
        s.set_config(zbar::ZBAR_NONE, zbar::ZBAR_CFG_ENABLE, 0);
        s.set_config(zbar::ZBAR_QRCODE, zbar::ZBAR_CFG_ENABLE, 1);
        return s;
    }();
    zbar::Image image(static_cast<unsigned>(grey.cols), static_cast<unsigned>(grey.rows), "Y800",
                      grey.data, grey.total());
    scanner.scan(image);
    for (auto s = image.symbol_begin(); s != image.symbol_end(); ++s) {
        if (s->get_location_size() != 4) continue;
        std::array<Pixel, 4> c;  // top left, bottom left, bottom right, top right
        for (std::size_t i = 0; i < 4; ++i)
            c[i] = {static_cast<double>(s->get_location_x(static_cast<unsigned>(i))),
                    static_cast<double>(s->get_location_y(static_cast<unsigned>(i)))};
        return {from_corners(s->get_data(), {c[0], c[3], c[2], c[1]}), ""};
    }
    return {std::nullopt, "no_code"};
}

Outcome libapriltag(const cv::Mat& grey, const Camera&) {
    static apriltag_detector_t* detector = [] {
        auto* d = apriltag_detector_create();
        apriltag_detector_add_family(d, tag36h11_create());
        d->quad_decimate = 4;
        d->nthreads = 1;
        return d;
    }();
    image_u8_t image{grey.cols, grey.rows, static_cast<int>(grey.step), grey.data};
    zarray_t* found = apriltag_detector_detect(detector, &image);
    Outcome out{std::nullopt, "no_code"};
    if (zarray_size(found) > 0) {
        apriltag_detection_t* d = nullptr;
        zarray_get(found, 0, &d);
        std::array<Pixel, 4> c;  // counter-clockwise from bottom left; centres at +0.5
        for (std::size_t i = 0; i < 4; ++i) c[i] = {d->p[i][0] - 0.5, d->p[i][1] - 0.5};
        out = {from_corners(std::to_string(d->id), {c[3], c[2], c[1], c[0]}), ""};
        out.found->centre = {d->c[0] - 0.5, d->c[1] - 0.5};
    }
    apriltag_detections_destroy(found);
    return out;
}

#ifdef PULSELINE_HAS_ARUCO
Outcome aruco(const cv::Mat& grey, const Camera&) {
    static const auto dictionary =
        cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
    static const auto parameters = [] {
        auto p = cv::aruco::DetectorParameters::create();
        p->minMarkerDistanceRate = 0.005;  // else the sheet's edge wins
        p->cornerRefinementMethod = cv::aruco::CORNER_REFINE_CONTOUR;
        return p;
    }();
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> ids;
    cv::aruco::detectMarkers(grey, dictionary, corners, ids, parameters);
    if (ids.empty()) return {std::nullopt, "no_code"};
    std::array<Pixel, 4> c;
    for (std::size_t i = 0; i < 4; ++i)
        c[i] = {static_cast<double>(corners[0][i].x), static_cast<double>(corners[0][i].y)};
    // OpenCV 4 has these tags turned by 180 degrees against their authors' pictures.
    return {from_corners(std::to_string(ids[0]), {c[2], c[3], c[0], c[1]}), ""};
}
#endif

template <MarkerKind kind>
Outcome tang(const cv::Mat& grey, const Camera& camera) {
    const auto place = vision::tang_corners(grey, camera, plant::usual_size_m(kind));
    if (!place) return {std::nullopt, "no_code"};
    return {Found{"", place->centre, place->angle_rad, true, 0}, ""};
}

Outcome li(const cv::Mat& grey, const Camera& camera) {
    const auto r = vision::li_landmark(grey, camera, plant::usual_size_m(MarkerKind::kLandmark));
    if (!r) return {std::nullopt, "no_code"};
    return {Found{std::to_string(r->code), r->centre, r->angle_rad, false, 0}, ""};
}

/// Li's pipeline with his 6-DoF pose; the place under the camera comes back as the image centre it
/// claims, so its error counts in the same pixels.
Outcome li_p4p(const cv::Mat& grey, const Camera& camera) {
    const auto r = vision::li_landmark(grey, camera, plant::usual_size_m(MarkerKind::kLandmark));
    if (!r) return {std::nullopt, "no_code"};
    const Eigen::Vector3d at = vision::li_p4p(*r, camera).camera_in_marker();
    const double c = std::cos(r->angle_rad), s = std::sin(r->angle_rad);
    const Pixel foot{c * at.x() - s * at.y(), s * at.x() + c * at.y()};  // marker to foot
    const Pixel centre = vision::distorted(camera, -vision::pixels_per_metre(camera) * foot);
    return {Found{std::to_string(r->code), centre, r->angle_rad, false, 0}, ""};
}

}  // namespace

Outcome read_ours(MarkerKind kind, const cv::Mat& grey, const Camera& camera,
                  const vision::ReaderOptions& options) {
    const auto r = vision::read_marker(kind, grey, camera, options);
    if (!r) return {std::nullopt, r.error().reason.code};
    return {Found{r->payload, r->centre, r->angle_rad, false, r->sigma_px}, ""};
}

std::vector<Method> methods(MarkerKind kind) {
    switch (kind) {
        case MarkerKind::kQr:
            return {{"pulseline", pulseline_reader<MarkerKind::kQr>},
                    {"zxing corners", zxing_corners},
                    {"zbar", zbar_corners},
                    {"Tang Canny corners", tang<MarkerKind::kQr>}};
        case MarkerKind::kAprilTag: {
            std::vector<Method> all{{"pulseline", pulseline_reader<MarkerKind::kAprilTag>},
                                    {"libapriltag decimate 4", libapriltag},
                                    {"Tang Canny corners", tang<MarkerKind::kAprilTag>}};
#ifdef PULSELINE_HAS_ARUCO
            all.push_back({"OpenCV ArUco contour", aruco});
#endif
            return all;
        }
        case MarkerKind::kLandmark:
            return {{"pulseline", pulseline_reader<MarkerKind::kLandmark>},
                    {"Li 2020 planar", li},
                    {"Li 2020 P4P", li_p4p}};
    }
    return {};
}

}  // namespace pulseline::bench
