#include "api/localization/image_bytes.hpp"

#include <charconv>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <vector>

#include "api/localization/file_bytes.hpp"

namespace pulseline::api::localization {

namespace {

struct Size {
    std::size_t width = 0;
    std::size_t height = 0;
};

std::size_t byte(std::string_view bytes, std::size_t at) {
    return static_cast<unsigned char>(bytes[at]);
}
std::size_t big_endian(std::string_view bytes, std::size_t at, std::size_t count) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8 | byte(bytes, at + i);
    return value;
}
std::size_t little_endian(std::string_view bytes, std::size_t at, std::size_t count) {
    std::size_t value = 0;
    for (std::size_t i = count; i-- > 0;) value = value << 8 | byte(bytes, at + i);
    return value;
}

/// Size of a PNG that has its end; OpenCV would return what there is of a cut one.
std::optional<Size> png_size(std::string_view bytes) {
    constexpr std::string_view kEnd("IEND\xAE\x42\x60\x82", 8);
    if (bytes.size() < 45 || bytes.rfind(kEnd) == std::string_view::npos) return std::nullopt;
    return Size{big_endian(bytes, 16, 4), big_endian(bytes, 20, 4)};
}

/// Walks the segments to the frame header; demands the end marker.
std::optional<Size> jpeg_size(std::string_view bytes) {
    if (bytes.rfind(std::string_view("\xFF\xD9", 2)) == std::string_view::npos) return std::nullopt;
    std::size_t at = 2;
    while (at + 9 < bytes.size()) {
        if (byte(bytes, at) != 0xFF) return std::nullopt;
        const std::size_t marker = byte(bytes, at + 1);
        if (marker == 0xFF) {  // fill byte
            ++at;
            continue;
        }
        const bool frame =
            marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        if (frame) return Size{big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2)};
        at += 2 + big_endian(bytes, at + 2, 2);
    }
    return std::nullopt;
}

std::optional<Size> bmp_size(std::string_view bytes) {
    if (bytes.size() < 54 || little_endian(bytes, 2, 4) > bytes.size()) return std::nullopt;
    const auto height = static_cast<std::int32_t>(little_endian(bytes, 22, 4));
    return Size{little_endian(bytes, 18, 4),
                static_cast<std::size_t>(height < 0 ? -static_cast<std::int64_t>(height) : height)};
}

/// PGM and PPM, binary and text.
std::optional<Size> pnm_size(std::string_view bytes) {
    std::size_t at = 2;
    const auto number = [&]() -> std::optional<std::size_t> {
        while (at < bytes.size() &&
               (bytes[at] == '#' || static_cast<unsigned char>(bytes[at]) <= ' '))
            at = bytes[at] == '#' ? std::min(bytes.find('\n', at), bytes.size()) : at + 1;
        std::size_t value = 0;
        const auto parsed = std::from_chars(bytes.data() + at, bytes.data() + bytes.size(), value);
        if (parsed.ec != std::errc()) return std::nullopt;
        at = static_cast<std::size_t>(parsed.ptr - bytes.data());
        return value;
    };
    const auto width = number();
    const auto height = number();
    const auto most = number();
    if (!width || !height || !most || *most == 0 || *most > 65535) return std::nullopt;
    if (*width > kMostImagePixels || *height > kMostImagePixels) return Size{*width, *height};
    const std::size_t channels = bytes[1] == '3' || bytes[1] == '6' ? 3 : 1;
    const std::size_t least = *width * *height * channels * (bytes[1] > '3' && *most > 255 ? 2 : 1);
    if (bytes.size() < at + 1 || bytes.size() - at - 1 < least) return std::nullopt;
    return Size{*width, *height};
}

std::optional<Size> header_size(std::string_view bytes) {
    if (bytes.starts_with(std::string_view("\x89PNG\r\n\x1a\n", 8))) return png_size(bytes);
    if (bytes.starts_with("\xFF\xD8\xFF")) return jpeg_size(bytes);
    if (bytes.starts_with("BM")) return bmp_size(bytes);
    // OpenCV knows such an image by the white space behind its number, too. Without it the bytes
    // would go to whichever of its many other readers wants them, and not all of those survive any
    // bytes.
    constexpr std::string_view kSpace = " \t\n\v\f\r";
    if (bytes.size() < 3 || kSpace.find(bytes[2]) == std::string_view::npos) return std::nullopt;
    for (const char* magic : {"P2", "P3", "P5", "P6"})
        if (bytes.starts_with(magic)) return pnm_size(bytes);
    return std::nullopt;
}

}  // namespace

Result<cv::Mat> decode_grey(std::string_view bytes, const std::string& file) {
    const auto unreadable = [&](const std::string& why) {
        return fail(Errc::kInvalid, "image_unreadable", file + ": " + why, "image",
                    {{"file", file}});
    };
    if (bytes.empty()) return unreadable("the file is empty.");
    const auto size = header_size(bytes);
    if (!size) return unreadable("this is no whole PNG, JPEG, BMP or PGM image.");
    if (size->width == 0 || size->height == 0) return unreadable("the image has no pixels.");
    if (size->width > kMostImagePixels || size->height > kMostImagePixels / size->width)
        return unreadable("the image is too large.");
    cv::Mat grey;
    try {
        const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1,
                          const_cast<char*>(bytes.data()));  // OpenCV knows no const Mat
        grey = cv::imdecode(raw, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
    } catch (const std::exception&) {  // cv::Exception, bad_alloc of a lying header
        grey.release();
    }
    if (grey.empty() || grey.type() != CV_8UC1) return unreadable("the image is damaged.");
    return grey;
}

Result<cv::Mat> read_grey_file(const std::string& path) {
    const auto bytes = read_bytes(path, kMostImageBytes);
    if (!bytes) return fail(bytes.error());
    return decode_grey(*bytes, path);
}

std::string encode_png(const cv::Mat& image) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(".png", image, bytes);
    return {bytes.begin(), bytes.end()};
}

}  // namespace pulseline::api::localization
