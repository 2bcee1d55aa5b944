#include "core/printing/marker_cells.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <charconv>
#include <map>
#include <memory>
#include <mutex>
#include <opencv2/objdetect.hpp>
#include <optional>

#include "core/plant/marker_geometry.hpp"

namespace pulseline::printing {
namespace {

std::optional<MarkerCells> qr_cells(const std::string& payload) {
    cv::QRCodeEncoder::Params params;
    params.version = 1;
    params.correction_level = cv::QRCodeEncoder::CORRECT_LEVEL_Q;
    cv::Mat image;
    try {
        cv::QRCodeEncoder::create(params)->encode(payload, image);
    } catch (const cv::Exception&) {
        return std::nullopt;
    }
    const int border = (image.cols - plant::kQrModules) / 2;
    if (border < 0 || image.cols - 2 * border != plant::kQrModules) return std::nullopt;
    MarkerCells cells{plant::kQrModules, plant::kQrQuietZone, {}};
    for (int row = 0; row < cells.side; ++row)
        for (int column = 0; column < cells.side; ++column)
            cells.dark.push_back(image.at<std::uint8_t>(row + border, column + border) < 128);
    return cells;
}

std::optional<MarkerCells> tag_cells(const std::string& payload) {
    const std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)> family(tag36h11_create(),
                                                                                 tag36h11_destroy);
    unsigned id = 0;
    const char* end = payload.data() + payload.size();
    const auto parsed = std::from_chars(payload.data(), end, id);
    if (parsed.ec != std::errc() || parsed.ptr != end || id >= family->ncodes) return std::nullopt;
    const std::unique_ptr<image_u8_t, decltype(&image_u8_destroy)> image(
        apriltag_to_image(family.get(), static_cast<int>(id)), image_u8_destroy);
    MarkerCells cells{plant::kTagCells, plant::kTagMargin, {}};
    for (int row = 0; row < cells.side; ++row)
        for (int column = 0; column < cells.side; ++column)
            cells.dark.push_back(image->buf[(row + 1) * image->stride + column + 1] < 128);
    return cells;
}

}  // namespace

Result<MarkerCells> marker_cells(plant::MarkerKind kind, const std::string& payload) {
    static std::mutex guard;  // simulated vehicles print in several threads
    static std::map<std::pair<plant::MarkerKind, std::string>, MarkerCells> cache;
    const std::scoped_lock lock(guard);
    const auto key = std::pair{kind, payload};
    if (const auto known = cache.find(key); known != cache.end()) return known->second;
    const auto cells = kind == plant::MarkerKind::kQr ? qr_cells(payload) : tag_cells(payload);
    if (!cells)
        return kind == plant::MarkerKind::kQr
                   ? fail(Errc::kInvalid, "payload_too_long",
                          "\"" + payload + "\" does not fit a version 1 QR code; shorten it.")
                   : fail(Errc::kInvalid, "payload_unknown",
                          "\"" + payload + "\" is no AprilTag 36h11 number (0 to 586).");
    return cache.emplace(key, *cells).first->second;
}

}  // namespace pulseline::printing
