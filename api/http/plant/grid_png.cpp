#include "api/http/plant/grid_png.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace pulseline::api {

std::string grid_png(const plant::OccupancyGrid& grid) {
    if (grid.empty()) return {};
    cv::Mat image(grid.height, grid.width, CV_8UC1);
    for (int row = 0; row < grid.height; ++row) {
        auto* pixels = image.ptr<unsigned char>(grid.height - 1 - row);  // row 0 is the south one
        for (int col = 0; col < grid.width; ++col) {
            pixels[col] = grid.is_occupied(col, row) ? 0 : 255;
        }
    }
    std::vector<unsigned char> png;
    cv::imencode(".png", image, png);
    return {png.begin(), png.end()};
}

}  // namespace pulseline::api
