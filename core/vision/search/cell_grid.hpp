#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/plant/plant.hpp"
#include "core/vision/edge/edge_fit.hpp"

namespace pulseline::vision {

/// Grey level of each square cell of a code and of the ring of white cells around it. Marker units
/// are cells; nothing is assumed about the encoder.
class CellGrid {
public:
    CellGrid(const cv::Mat& grey, const plant::Camera& camera, const Placement& placement,
             int side);

    int side() const { return side_; }
    /// Rows and columns from -1 to side(); negative level: outside the image.
    bool valid(int row, int column) const { return level(row, column) >= 0; }
    float level(int row, int column) const { return levels_[index(row, column)]; }
    /// Darker than midway between the extremes of the surrounding cells: follows the light.
    bool dark(int row, int column) const { return dark_[index(row, column)]; }

private:
    std::size_t index(int row, int column) const {
        return static_cast<std::size_t>((row + 1) * (side_ + 2) + column + 1);
    }
    int side_;
    std::vector<float> levels_;
    std::vector<bool> dark_;
};

/// Sites on all borders between dark and light cells, `per_cell` on each; `dark(row, column)` is
/// asked for -1 to side as well.
std::vector<EdgeSite> cell_borders(int side, int per_cell,
                                   const std::function<bool(int, int)>& dark);

}  // namespace pulseline::vision
