#include "core/vision/marker_reader.hpp"

#include <opencv2/imgproc.hpp>

#include "core/vision/apriltag/apriltag_reader.hpp"
#include "core/vision/landmark/landmark_reader.hpp"
#include "core/vision/qr/qr_reader.hpp"

namespace pulseline::vision {

ReadResult read_marker(plant::MarkerKind kind, const cv::Mat& grey, const plant::Camera& camera,
                       const ReaderOptions& options) {
    switch (kind) {
        case plant::MarkerKind::kQr:
            return read_qr(grey, camera, options);
        case plant::MarkerKind::kAprilTag:
            return read_apriltag(grey, camera, options);
        case plant::MarkerKind::kLandmark:
            return read_landmark(grey, camera, options);
    }
    return refuse(kNoCode);
}

namespace {

/// Grey over a marker that has been read, so that the next search finds another one.
void cover(cv::Mat& image, const MarkerReading& reading) {
    constexpr double kBeyond = 1.15;  // of the half diagonal: the marker's white as well
    std::array<cv::Point, 4> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Pixel p = reading.centre + kBeyond * (reading.corners[i] - reading.centre);
        corners[i] = {static_cast<int>(p.u), static_cast<int>(p.v)};
    }
    cv::fillConvexPoly(image, corners.data(), static_cast<int>(corners.size()), cv::Scalar(128));
}

}  // namespace

std::vector<MarkerReading> read_others(const MarkerReading& first, const cv::Mat& grey,
                                       const plant::Camera& camera, const ReaderOptions& options) {
    constexpr std::size_t kMost = 7;  // more do not fit a view
    std::vector<MarkerReading> others;
    cv::Mat rest = grey.clone();
    cover(rest, first);
    while (others.size() < kMost) {
        auto reading = read_marker(first.kind, rest, camera, options);
        if (!reading) break;
        cover(rest, *reading);
        others.push_back(std::move(*reading));
    }
    return others;
}

}  // namespace pulseline::vision
