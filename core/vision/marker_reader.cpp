#include "core/vision/marker_reader.hpp"

#include "core/vision/apriltag_reader.hpp"
#include "core/vision/landmark_reader.hpp"
#include "core/vision/qr_reader.hpp"

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
    return refuse("no_code");
}

}  // namespace pulseline::vision
