#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"

namespace pulseline::api::plant_file {

struct GreyImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;  // row-major, first row on top
};

/// PGM (P2, P5, up to 255) or PNG, told apart by their first bytes. Truncated or oversized images
/// are errors (reason image_unreadable), `file` is what the message calls them.
[[nodiscard]] Result<GreyImage> decode_image(std::string_view bytes, const std::string& file);
/// Binary PGM.
std::string encode_pgm(const GreyImage& image);

}  // namespace pulseline::api::plant_file
