#include "core/vision/search/cell_grid.hpp"

#include <algorithm>

#include "core/vision/edge/sample.hpp"

namespace pulseline::vision {

CellGrid::CellGrid(const cv::Mat& grey, const plant::Camera& camera, const Placement& placement,
                   int side)
    : side_(side),
      levels_(static_cast<std::size_t>((side + 2) * (side + 2)), -1),
      dark_(levels_.size(), false) {
    constexpr double kSpread = 0.15;  // 3 x 3 samples over the inner third of the cell
    const double half = (side - 1) / 2.0;
    for (int row = -1; row <= side; ++row) {
        for (int column = -1; column <= side; ++column) {
            const Pixel middle = distorted(camera, placement.at(column - half, row - half));
            const Pixel right = kSpread * placement.turned(1, 0);
            const Pixel down = kSpread * placement.turned(0, 1);
            float sum = 0;
            bool inside = true;
            for (int i = 0; i < 9 && inside; ++i) {
                const Pixel p =
                    middle + static_cast<double>(i % 3 - 1) * right + (i / 3 - 1.0) * down;
                inside = sampleable(grey, p);
                if (inside) sum += sample(grey, p);
            }
            if (inside) levels_[index(row, column)] = sum / 9;
        }
    }
    // The threshold comes from a 7 x 7 neighbourhood.
    for (int row = -1; row <= side; ++row) {
        for (int column = -1; column <= side; ++column) {
            float low = 256;
            float high = 0;
            for (int r = std::max(-1, row - 3); r <= std::min(side, row + 3); ++r) {
                for (int c = std::max(-1, column - 3); c <= std::min(side, column + 3); ++c) {
                    if (!valid(r, c)) continue;
                    low = std::min(low, level(r, c));
                    high = std::max(high, level(r, c));
                }
            }
            dark_[index(row, column)] = valid(row, column) && level(row, column) < (low + high) / 2;
        }
    }
}

std::vector<EdgeSite> cell_borders(int side, int per_cell,
                                   const std::function<bool(int, int)>& dark) {
    const double half = (side - 1) / 2.0;
    std::vector<EdgeSite> sites;
    const auto add = [&](int row, int column, bool vertical) {
        const bool first = dark(row, column);
        if (first == dark(row + !vertical, column + vertical)) return;
        const double sign = first ? 1 : -1;
        for (int i = 0; i < per_cell; ++i) {
            // Evenly over the middle three quarters: the corners belong to other borders as well.
            const double along = 0.75 * ((i + 0.5) / per_cell - 0.5);
            if (vertical) {
                sites.push_back({column + 0.5 - half, row - half + along, sign, 0});
            } else {
                sites.push_back({column - half + along, row + 0.5 - half, 0, sign});
            }
        }
    };
    for (int row = -1; row <= side; ++row) {
        for (int column = -1; column <= side; ++column) {
            const bool inner_row = row >= 0 && row < side;
            const bool inner_column = column >= 0 && column < side;
            if (inner_row && column < side) add(row, column, true);
            if (inner_column && row < side) add(row, column, false);
        }
    }
    return sites;
}

}  // namespace pulseline::vision
