// Any bytes as an image file, then through every reader: nothing but a reading or a refusal may
// come out.
#include <opencv2/core/utility.hpp>
#include <string_view>

#include "api/localization/image_bytes.hpp"
#include "core/vision/marker_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace pulseline;
    cv::setNumThreads(1);
    const auto image =
        api::localization::decode_grey({reinterpret_cast<const char*>(data), size}, "input");
    if (!image || image->total() > 400'000) return 0;
    plant::Camera camera;
    camera.width_px = image->cols;
    camera.height_px = image->rows;
    camera.cu_px = (image->cols - 1) / 2.0;
    camera.cv_px = (image->rows - 1) / 2.0;
    for (const auto kind :
         {plant::MarkerKind::kQr, plant::MarkerKind::kAprilTag, plant::MarkerKind::kLandmark})
        (void)vision::read_marker(kind, *image, camera);
    return 0;
}
