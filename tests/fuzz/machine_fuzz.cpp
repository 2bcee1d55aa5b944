#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "api/machine/frames.hpp"

// Whatever a controller sends: it is refused, or reads again as it is written.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace pulseline::machine;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const auto length = frame_size(bytes);
    if (!length || !*length || **length > size) return 0;
    const auto frame = decode(bytes.substr(0, **length));
    if (!frame) return 0;
    const auto again = decode(encode(*frame));
    if (!again || *again != *frame) std::abort();
    return 0;
}
