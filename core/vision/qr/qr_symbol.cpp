#include "core/vision/qr/qr_symbol.hpp"

#define ZX_USE_UTF8 1
#include <ZXing/ReadBarcode.h>

#include <algorithm>
#include <cstdlib>

#include "core/plant/marker_geometry.hpp"

namespace pulseline::vision {

using plant::kQrModules;

std::optional<bool> fixed_module(int row, int column) {
    const auto finder = [&](int top, int left) {
        const int r = std::max(std::abs(row - top - 3), std::abs(column - left - 3));
        return r > 4 ? -1 : (r == 4 || r == 2 ? 0 : 1);
    };
    for (const auto& [top, left] : {std::pair{0, 0}, {0, kQrModules - 7}, {kQrModules - 7, 0}})
        if (const int m = finder(top, left); m >= 0) return m == 1;
    if (row == 6 || column == 6) return (row + column) % 2 == 0;
    return std::nullopt;
}

double fixed_pattern_share(const CellGrid& modules) {
    int known = 0;
    int right = 0;
    for (int row = 0; row < kQrModules; ++row) {
        for (int column = 0; column < kQrModules; ++column) {
            const auto expected = fixed_module(row, column);
            if (!expected || !modules.valid(row, column)) continue;
            ++known;
            right += modules.dark(row, column) == *expected;
        }
    }
    return known == 0 ? 0 : static_cast<double>(right) / known;
}

/// Drawn afresh without dirt, noise and turn. zxing's own search of the camera image is not used:
/// Debian builds it with assertions, and EstimateModuleSize aborts the process on some dirty codes.
std::optional<QrText> decode_qr(const CellGrid& modules) {
    constexpr int kDraw = 3;   // pixels per module
    constexpr int kQuiet = 4;  // modules
    constexpr int kSide = (kQrModules + 2 * kQuiet) * kDraw;
    cv::Mat drawn(kSide, kSide, CV_8U, cv::Scalar(255));
    for (int row = 0; row < kQrModules; ++row)
        for (int column = 0; column < kQrModules; ++column)
            if (fixed_module(row, column).value_or(modules.dark(row, column)))
                drawn(cv::Rect((column + kQuiet) * kDraw, (row + kQuiet) * kDraw, kDraw, kDraw)) =
                    0;
    const ZXing::ImageView view(drawn.data, drawn.cols, drawn.rows, ZXing::ImageFormat::Lum,
                                static_cast<int>(drawn.step));
    const ZXing::Result found =
        ZXing::ReadBarcode(view, ZXing::DecodeHints()
                                     .setFormats(ZXing::BarcodeFormat::QRCode)
                                     .setBinarizer(ZXing::Binarizer::FixedThreshold)
                                     .setIsPure(true));
    if (!found.isValid()) return std::nullopt;
    return QrText{found.text(), found.isMirrored()};
}

}  // namespace pulseline::vision
