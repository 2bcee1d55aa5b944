// The bytes spoil a real picture of a marker: deeper into decoding and fit than any random image.
#include <algorithm>
#include <array>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "core/vision/marker_reader.hpp"
#include "tests/core/vision/marker_view.hpp"

namespace {

using namespace pulseline;
using plant::MarkerKind;

/// Half the usual size: a reading of a full one takes an instrumented program too long.
plant::Camera small_camera() {
    plant::Camera camera;
    camera.width_px /= 2;
    camera.height_px /= 2;
    camera.f_px /= 2;
    camera.cu_px = (camera.width_px - 1) / 2.0;
    camera.cv_px = (camera.height_px - 1) / 2.0;
    return camera;
}

const cv::Mat& picture(MarkerKind kind) {
    static const std::array<cv::Mat, 3> pictures = [] {
        std::array<cv::Mat, 3> all;
        for (const auto k : {MarkerKind::kQr, MarkerKind::kAprilTag, MarkerKind::kLandmark}) {
            vision::MarkerView view;
            view.kind = k;
            view.camera = small_camera();
            view.payload = k == MarkerKind::kQr ? "ST04-F" : "17";
            all[static_cast<std::size_t>(k)] = view.image();
        }
        return all;
    }();
    return pictures[static_cast<std::size_t>(kind)];
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    cv::setNumThreads(1);
    if (size < 1) return 0;
    const auto kind = static_cast<MarkerKind>(data[0] % 3);
    cv::Mat image = picture(kind).clone();
    // Five bytes a spot: place, size, grey level.
    for (std::size_t i = 1; i + 5 <= std::min<std::size_t>(size, 400); i += 5)
        cv::circle(image, {data[i] * image.cols / 256, data[i + 1] * image.rows / 256},
                   1 + data[i + 2] / (1 + data[i + 3] % 8), cv::Scalar(data[i + 4]), -1);
    (void)vision::read_marker(kind, image, small_camera());
    return 0;
}
