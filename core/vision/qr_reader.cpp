#include "core/vision/qr_reader.hpp"

#include <array>
#include <optional>

#include "core/plant/marker_geometry.hpp"
#include "core/vision/cell_grid.hpp"
#include "core/vision/finder_search.hpp"
#include "core/vision/qr_symbol.hpp"
#include "core/vision/round_search.hpp"

namespace pulseline::vision {
namespace {

using plant::kQrModules;

// Finder and timing patterns must be there: 90 % leaves room for dirt, a wrong grid matches half.
constexpr double kFixedPatternShare = 0.9;
constexpr int kProfilesPerModule = 2;

// The usual size first, then others, only to be able to say that the size is wrong.
constexpr std::array<double, 3> kScales{1, 0.84, 1.19};

struct Located {
    QrText text;
    Placement placement;
    CellGrid modules;
};

std::optional<Located> decode(const cv::Mat& grey, const plant::Camera& camera,
                              const Placement& placement) {
    CellGrid modules(grey, camera, placement, kQrModules);
    if (fixed_pattern_share(modules) < kFixedPatternShare) return std::nullopt;
    auto text = decode_qr(modules);
    if (!text) return std::nullopt;
    return Located{std::move(*text), placement, std::move(modules)};
}

std::optional<Located> locate(const cv::Mat& grey, const plant::Camera& camera,
                              double expected_module_px) {
    const int shrink = search_shrink(expected_module_px);
    const cv::Mat small = shrunk(grey, shrink);
    for (const double scale : kScales)
        for (const Placement& placement :
             search_finders(small, camera, scale * expected_module_px, shrink))
            if (auto found = decode(grey, camera, placement)) return found;
    return std::nullopt;
}

}  // namespace

ReadResult read_qr(const cv::Mat& grey, const plant::Camera& camera, const ReaderOptions& options) {
    if (!is_image_of(grey, camera)) return refuse("bad_image");
    const double units_per_m = kQrModules / size_m(plant::MarkerKind::kQr, options);
    const auto located = locate(grey, camera, pixels_per_metre(camera) / units_per_m);
    if (!located) return refuse("no_code");
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
