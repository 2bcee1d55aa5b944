#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

#include "core/base/result.hpp"

namespace pulseline::api::localization {

inline constexpr std::size_t kMostImageBytes = 64'000'000;
inline constexpr std::size_t kMostImagePixels = 50'000'000;

/// 8-bit grey image from PNG, JPEG, BMP or PGM/PPM bytes, told apart by their first bytes. The size
/// is read from the header before anything is allocated; an image cut off before its end is
/// refused, not filled up. Fails with image_unreadable {file}; `file` is what the message calls it.
[[nodiscard]] Result<cv::Mat> decode_grey(std::string_view bytes, const std::string& file);
/// Fails with file_unreadable and file_too_large as well.
[[nodiscard]] Result<cv::Mat> read_grey_file(const std::string& path);

/// Throws cv::Exception when there is no memory for it.
std::string encode_png(const cv::Mat& image);

}  // namespace pulseline::api::localization
