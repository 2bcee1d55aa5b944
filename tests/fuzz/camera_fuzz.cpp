// Any text as a camera file.
#include <string_view>

#include "api/localization/camera_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    (void)pulseline::api::localization::decode_camera({reinterpret_cast<const char*>(data), size});
    return 0;
}
