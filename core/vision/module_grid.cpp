#include <algorithm>
#include <cmath>

#include "core/vision/edge_fit.hpp"
#include "core/vision/sample.hpp"

namespace pulseline::vision {

std::optional<bool> fixed_module(int row, int column) {
    const auto finder = [&](int top, int left) {
        const int r = std::max(std::abs(row - top - 3), std::abs(column - left - 3));
        return r > 4 ? -1 : (r == 4 || r == 2 ? 0 : 1);
    };
    for (const auto& [top, left] : {std::pair{0, 0}, {0, kModules - 7}, {kModules - 7, 0}})
        if (const int m = finder(top, left); m >= 0) return m == 1;
    if (row == 6 || column == 6) return (row + column) % 2 == 0;
    return std::nullopt;
}

ModuleGrid::ModuleGrid(const cv::Mat& grey, const plant::Camera& camera,
                       const CodePlacement& placement) {
    constexpr double kSpread = 0.15;  // 3 x 3 samples over the inner third of the module
    const double half = (kModules - 1) / 2.0;
    for (int row = -1; row <= kModules; ++row) {
        for (int column = -1; column <= kModules; ++column) {
            float sum = 0;
            bool inside = true;
            for (int i = 0; i < 9 && inside; ++i) {
                const Pixel p =
                    distorted(camera, placement.at(column - half + kSpread * (i % 3 - 1),
                                                   row - half + kSpread * (i / 3 - 1)));
                inside = sampleable(grey, p);
                if (inside) sum += sample(grey, p);
            }
            levels_[index(row, column)] = inside ? sum / 9 : -1;
        }
    }
    // Threshold midway between the darkest and lightest of a 7 x 7 neighbourhood: follows the
    // light.
    for (int row = -1; row <= kModules; ++row) {
        for (int column = -1; column <= kModules; ++column) {
            float low = 256;
            float high = 0;
            for (int r = std::max(-1, row - 3); r <= std::min(kModules, row + 3); ++r) {
                for (int c = std::max(-1, column - 3); c <= std::min(kModules, column + 3); ++c) {
                    if (!valid(r, c)) continue;
                    low = std::min(low, level(r, c));
                    high = std::max(high, level(r, c));
                }
            }
            dark_[index(row, column)] = valid(row, column) && level(row, column) < (low + high) / 2;
            contrast_ = std::max(contrast_, high - low);
        }
    }
}

double ModuleGrid::fixed_pattern_share() const {
    int known = 0;
    int right = 0;
    for (int row = 0; row < kModules; ++row) {
        for (int column = 0; column < kModules; ++column) {
            const auto expected = fixed_module(row, column);
            if (!expected || !valid(row, column)) continue;
            ++known;
            right += dark(row, column) == *expected;
        }
    }
    return known == 0 ? 0 : static_cast<double>(right) / known;
}

}  // namespace pulseline::vision
