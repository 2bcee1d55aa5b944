#include "core/vision/apriltag/apriltag_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/plant/marker_geometry.hpp"
#include "core/vision/apriltag/tag_family.hpp"
#include "core/vision/apriltag/tag_search.hpp"
#include "core/vision/edge/median.hpp"
#include "core/vision/edge/sample.hpp"
#include "core/vision/optics/level_plane.hpp"
#include "core/vision/search/cell_grid.hpp"
#include "core/vision/search/search_image.hpp"

namespace pulseline::vision {
namespace {

using plant::kTagCells;

constexpr int kProfilesPerCell = 6;
// Border and margin cells as they must be; dirt takes some, another pattern half of them.
constexpr double kFrameShare = 0.8;

bool in_border(int row, int column) {
    return row >= 0 && column >= 0 && row < kTagCells && column < kTagCells;
}

/// The outline of the black square, which every tag has.
const std::vector<EdgeSite>& outline() {
    static const std::vector<EdgeSite> sites = cell_borders(kTagCells, kProfilesPerCell, in_border);
    return sites;
}

/// Median of 5 x 5 samples over the middle of a cell; negative outside the image.
double cell_level(const cv::Mat& grey, const plant::Camera& camera, const Placement& placement,
                  int row, int column) {
    constexpr double kStep = 0.14;
    constexpr double kHalf = (kTagCells - 1) / 2.0;
    std::array<float, 25> samples{};
    std::size_t count = 0;
    for (int i = -2; i <= 2; ++i) {
        for (int j = -2; j <= 2; ++j) {
            const Pixel p = distorted(
                camera, placement.at(column - kHalf + kStep * j, row - kHalf + kStep * i));
            if (!sampleable(grey, p)) return -1;
            samples[count++] = sample(grey, p);
        }
    }
    return static_cast<double>(*median(samples));
}

struct Sampled {
    TagBits bits{};
    double frame_share = 0;
};

std::optional<Sampled> sample_cells(const cv::Mat& grey, const plant::Camera& camera,
                                    const Placement& placement) {
    LevelPlane dark;
    LevelPlane light;
    std::array<std::array<double, kTagCells + 2>, kTagCells + 2> levels{};
    int margin = 0;
    for (int row = -1; row <= kTagCells; ++row) {
        for (int column = -1; column <= kTagCells; ++column) {
            double& level =
                levels[static_cast<std::size_t>(row + 1)][static_cast<std::size_t>(column + 1)];
            level = cell_level(grey, camera, placement, row, column);
            if (level < 0) continue;
            const int inside = std::min({row, column, kTagCells - 1 - row, kTagCells - 1 - column});
            if (inside == 0) dark.add(column, row, level);
            if (inside == -1) light.add(column, row, level), ++margin;
        }
    }
    if (margin < 2 * kTagCells) return std::nullopt;
    dark.fit();
    light.fit();
    Sampled out;
    int right = 0;
    int known = 0;
    for (int row = -1; row <= kTagCells; ++row) {
        for (int column = -1; column <= kTagCells; ++column) {
            const double level =
                levels[static_cast<std::size_t>(row + 1)][static_cast<std::size_t>(column + 1)];
            if (level < 0) continue;
            const double low = dark.at(column, row);
            const double high = light.at(column, row);
            if (high - low < 4) return std::nullopt;
            const double value = std::clamp((low + high - 2 * level) / (high - low), -1.0, 1.0);
            const int inside = std::min({row, column, kTagCells - 1 - row, kTagCells - 1 - column});
            if (inside <= 0) {
                ++known;
                right += (value > 0) == (inside == 0);
            } else {
                out.bits[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = value;
            }
        }
    }
    out.frame_share = static_cast<double>(right) / known;
    return out;
}

struct Located {
    TagCode code;
    Placement placement;  // of the upright tag
};

std::optional<Located> decode(const cv::Mat& grey, const plant::Camera& camera,
                              const Placement& start) {
    const auto fit = fit_edges(grey, camera, outline(), 1, start, FitEffort::kLocate);
    const auto try_at = [&](const Placement& placement) -> std::optional<Located> {
        const auto cells = sample_cells(grey, camera, placement);
        if (!cells || cells->frame_share < kFrameShare) return std::nullopt;
        const auto code = TagFamily::instance().decode(cells->bits);
        if (!code) return std::nullopt;
        Located found{*code, placement};
        found.placement.angle_rad += code->quarter_turns * kPi / 2;
        return found;
    };
    if (fit)
        if (auto found = try_at(fit->placement)) return found;
    return try_at(start);
}

std::optional<Located> locate(const cv::Mat& grey, const plant::Camera& camera,
                              const ReaderOptions& options, double cell_px) {
    const double reach_px = (kTagCells / 2.0 + 1) * std::sqrt(2.0) * cell_px;
    const auto try_in = [&](const SearchImage& image, double scale) -> std::optional<Located> {
        for (const Placement& placement : search_tags(image, camera, scale * cell_px))
            if (auto found = decode(grey, camera, placement)) return found;
        return std::nullopt;
    };
    return search(grey, camera, options, cell_px, reach_px, try_in);
}

}  // namespace

ReadResult read_apriltag(const cv::Mat& grey, const plant::Camera& camera,
                         const ReaderOptions& options) {
    if (!is_image_of(grey, camera)) return refuse("bad_image");
    const double units_per_m = kTagCells / size_m(plant::MarkerKind::kAprilTag, options);
    const auto located = locate(grey, camera, options, pixels_per_metre(camera) / units_per_m);
    if (!located) return refuse(kNoCode);
    if (located->code.mirrored) return refuse("mirrored");
    const auto sites = cell_borders(kTagCells, kProfilesPerCell, [&](int row, int column) {
        return TagFamily::instance().dark(located->code.id, row, column);
    });
    return accept(plant::MarkerKind::kAprilTag, std::to_string(located->code.id),
                  fit_edges(grey, camera, sites, 1, located->placement), camera, units_per_m,
                  options);
}

}  // namespace pulseline::vision
