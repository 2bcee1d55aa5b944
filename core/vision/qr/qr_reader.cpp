#include "core/vision/qr/qr_reader.hpp"

#include <cmath>
#include <optional>

#include "core/plant/marker_geometry.hpp"
#include "core/vision/qr/finder_search.hpp"
#include "core/vision/qr/qr_symbol.hpp"
#include "core/vision/search/cell_grid.hpp"
#include "core/vision/search/search_image.hpp"

namespace pulseline::vision {
namespace {

using plant::kQrModules;

// Finder and timing patterns must be there: 90 % leaves room for dirt, a wrong grid matches half.
// Where the code is expected two finders may be covered; its checksum says whether it was read.
constexpr double kFixedPatternShare = 0.9;
constexpr double kExpectedPatternShare = 0.65;
constexpr int kProfilesPerModule = 2;
constexpr double kQuietModules = 4;

struct Located {
    QrText text;
    Placement placement;
    CellGrid modules;
};

std::optional<Located> decode(const cv::Mat& grey, const plant::Camera& camera,
                              const Placement& placement, double least_share) {
    CellGrid modules(grey, camera, placement, kQrModules);
    if (fixed_pattern_share(modules) < least_share) return std::nullopt;
    auto text = decode_qr(modules);
    if (!text) return std::nullopt;
    return Located{std::move(*text), placement, std::move(modules)};
}

std::optional<Located> locate(const cv::Mat& grey, const plant::Camera& camera,
                              const ReaderOptions& options, double module_px) {
    const double reach_px = (kQrModules / 2.0 + kQuietModules) * std::sqrt(2.0) * module_px;
    const auto try_in = [&](const SearchImage& image, double scale) -> std::optional<Located> {
        const double least_share = image.window ? kExpectedPatternShare : kFixedPatternShare;
        for (const Placement& placement : search_finders(image, camera, scale * module_px))
            if (auto found = decode(grey, camera, placement, least_share)) return found;
        return std::nullopt;
    };
    return search(grey, camera, options, module_px, reach_px, try_in);
}

}  // namespace

ReadResult read_qr(const cv::Mat& grey, const plant::Camera& camera, const ReaderOptions& options) {
    if (!is_image_of(grey, camera)) return refuse("bad_image");
    const double units_per_m = kQrModules / size_m(plant::MarkerKind::kQr, options);
    const auto located = locate(grey, camera, options, pixels_per_metre(camera) / units_per_m);
    if (!located) return refuse(kNoCode);
    if (located->text.mirrored) return refuse("mirrored");
    const auto sites = cell_borders(kQrModules, kProfilesPerModule, [&](int row, int column) {
        return row >= 0 && column >= 0 && row < kQrModules && column < kQrModules &&
               fixed_module(row, column).value_or(located->modules.dark(row, column));
    });
    return accept(plant::MarkerKind::kQr, located->text.payload,
                  fit_edges(grey, camera, sites, 1, located->placement), camera, units_per_m,
                  options);
}

}  // namespace pulseline::vision
