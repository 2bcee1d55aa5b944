#include "core/planning/room/disc_distances.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>

namespace pulseline::planning {
namespace {

using geometry::Point2;

constexpr double kNeverReached_m = std::numeric_limits<double>::infinity();
constexpr double kLeastCell_m = 0.35;
constexpr double kLargestCell_m = 0.6;
// A cell where the disc may or may not pass counts as so much longer: a guide that leads into gaps
// a little too narrow costs the search more than a detour.
constexpr double kUnsure = 8;
constexpr double kMostCells = 250'000;

}  // namespace

DiscDistances::DiscDistances(const FloorField& field, double disc_radius_m, Point2 goal) {
    const geometry::Box box = field.box();
    const double width = box.max.x_m - box.min.x_m;
    const double height = box.max.y_m - box.min.y_m;
    cell_m_ = std::max(std::clamp(disc_radius_m / 3, kLeastCell_m, kLargestCell_m),
                       std::sqrt(width * height / kMostCells));
    origin_ = box.min;
    width_ = static_cast<int>(std::ceil(width / cell_m_));
    height_ = static_cast<int>(std::ceil(height / cell_m_));
    length_m_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                     kNeverReached_m);
    const int goal_cell = cell(goal);
    if (goal_cell < 0) return;
    const double diagonal = std::numbers::sqrt2;
    const double room_m = disc_radius_m - cell_m_ * diagonal / 2;
    const auto factor = [&](int index) {  // of the length through a cell; infinite: blocked
        const Point2 middle =
            origin_ + cell_m_ * Point2{index % width_ + 0.5, index / width_ + 0.5};
        const double free_m = field.distance_m(middle);
        if (free_m >= disc_radius_m) return 1.0;
        return free_m >= room_m || index == goal_cell ? kUnsure : kNeverReached_m;
    };

    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    length_m_[static_cast<std::size_t>(goal_cell)] = 0;
    open.emplace(0, goal_cell);
    while (!open.empty()) {
        const auto [length, index] = open.top();
        open.pop();
        if (length > length_m_[static_cast<std::size_t>(index)]) continue;
        const int x = index % width_;
        const int y = index / width_;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                if (x + dx < 0 || x + dx >= width_ || y + dy < 0 || y + dy >= height_) continue;
                const int next = index + dy * width_ + dx;
                const double step = cell_m_ * (dx != 0 && dy != 0 ? diagonal : 1);
                if (length + step >= length_m_[static_cast<std::size_t>(next)]) continue;
                const double longer = length + step * factor(next);
                if (longer >= length_m_[static_cast<std::size_t>(next)]) continue;
                length_m_[static_cast<std::size_t>(next)] = longer;
                open.emplace(longer, next);
            }
        }
    }
}

int DiscDistances::cell(Point2 at) const {
    const double x = std::floor((at.x_m - origin_.x_m) / cell_m_);
    const double y = std::floor((at.y_m - origin_.y_m) / cell_m_);
    if (!(x >= 0 && y >= 0 && x < width_ && y < height_)) return -1;
    return static_cast<int>(y) * width_ + static_cast<int>(x);
}

double DiscDistances::from(Point2 at) const {
    const int index = cell(at);
    return index < 0 ? kNeverReached_m : length_m_[static_cast<std::size_t>(index)];
}

}  // namespace pulseline::planning
