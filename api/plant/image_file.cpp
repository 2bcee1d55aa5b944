#include "api/plant/image_file.hpp"

#include <algorithm>
#include <charconv>
#include <opencv2/imgcodecs.hpp>
#include <optional>

namespace pulseline::api::plant_file {

using namespace plant;

namespace {

constexpr std::size_t kMostPixels = 100'000'000;  // 1 km x 1 km at 0.1 m

tl::unexpected<Error> unreadable(const std::string& file, const std::string& why) {
    return fail(Errc::kInvalid, "image_unreadable", file + ": " + why, "image", {{"file", file}});
}

bool fits(std::size_t width, std::size_t height) {
    return width > 0 && height > 0 && width <= kMostPixels && height <= kMostPixels / width;
}

/// Reads the header of a PGM, and its numbers where they are text.
class PgmReader {
public:
    explicit PgmReader(std::string_view bytes) : rest_(bytes.substr(2)) {}

    std::optional<std::size_t> number() {
        while (!rest_.empty() && (is_space(rest_.front()) || rest_.front() == '#')) {
            if (rest_.front() == '#') {
                rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
            } else {
                rest_.remove_prefix(1);
            }
        }
        std::size_t value = 0;
        const auto parsed = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (parsed.ec != std::errc()) return std::nullopt;
        rest_.remove_prefix(static_cast<std::size_t>(parsed.ptr - rest_.data()));
        return value;
    }
    std::string_view after_one_space() const { return rest_.empty() ? rest_ : rest_.substr(1); }

private:
    static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    std::string_view rest_;
};

Result<GreyImage> decode_pgm(std::string_view bytes, const std::string& file) {
    PgmReader reader(bytes);
    const auto width = reader.number();
    const auto height = reader.number();
    const auto most = reader.number();
    if (!width || !height || !most) return unreadable(file, "the PGM header is damaged.");
    if (!fits(*width, *height)) return unreadable(file, "the image is empty or too large.");
    if (*most == 0 || *most > 255) {
        return unreadable(file, "only 8-bit PGM is read; save it with a maximum of 255.");
    }
    GreyImage image{static_cast<int>(*width), static_cast<int>(*height), {}};
    const std::size_t size = *width * *height;
    const auto scaled = [&](std::size_t v) {
        return static_cast<std::uint8_t>(v >= *most ? 255 : v * 255 / *most);
    };
    if (bytes[1] == '5') {
        const std::string_view data = reader.after_one_space();
        if (data.size() < size) return unreadable(file, "the PGM ends before its last row.");
        image.pixels.reserve(size);
        for (const char c : data.substr(0, size)) {
            image.pixels.push_back(scaled(static_cast<unsigned char>(c)));
        }
        return image;
    }
    if (bytes.size() < size) return unreadable(file, "the PGM ends before its last row.");
    image.pixels.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
        const auto value = reader.number();
        if (!value) return unreadable(file, "the PGM ends before its last row.");
        image.pixels.push_back(scaled(*value));
    }
    return image;
}

std::size_t big_endian(std::string_view bytes, std::size_t at) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

Result<GreyImage> decode_png(std::string_view bytes, const std::string& file) {
    constexpr std::string_view kEnd("IEND\xAE\x42\x60\x82", 8);
    if (bytes.size() < 45 || bytes.substr(bytes.size() - kEnd.size()) != kEnd) {
        return unreadable(file, "the PNG is cut off.");
    }
    if (!fits(big_endian(bytes, 16), big_endian(bytes, 20))) {
        return unreadable(file, "the image is empty or too large.");
    }
    cv::Mat grey;
    try {
        const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1,
                          const_cast<char*>(bytes.data()));  // OpenCV knows no const Mat
        grey = cv::imdecode(raw, cv::IMREAD_GRAYSCALE);
    } catch (const cv::Exception&) {
        grey.release();
    }
    if (grey.empty() || !grey.isContinuous()) return unreadable(file, "the PNG is damaged.");
    return GreyImage{grey.cols, grey.rows, {grey.datastart, grey.dataend}};
}

}  // namespace

Result<GreyImage> decode_image(std::string_view bytes, const std::string& file) {
    if (bytes.substr(0, 2) == "P5" || bytes.substr(0, 2) == "P2") return decode_pgm(bytes, file);
    if (bytes.substr(0, 8) == std::string_view("\x89PNG\r\n\x1a\n", 8))
        return decode_png(bytes, file);
    return unreadable(file, "this is neither a PGM nor a PNG image.");
}

std::string encode_pgm(const GreyImage& image) {
    std::string out =
        "P5\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n255\n";
    out.append(image.pixels.begin(), image.pixels.end());
    return out;
}

}  // namespace pulseline::api::plant_file
