#pragma once

#include <cmath>
#include <cstddef>

#include "core/geometry/polygon.hpp"
#include "core/mapping/occupancy_map.hpp"
#include "core/plant/plant.hpp"
#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::mapping::testing {

/// 60 m x 50 m around the origin and nothing but columns along two of its walls, with a margin for
/// its map.
inline plant::Plant wide_hall() {
    plant::Plant plant;
    plant::Hall hall;
    hall.id = plant::HallId("hall");
    hall.outline = {{-30, -25}, {30, -25}, {30, 25}, {-30, 25}};
    hall.grid.origin = hall.outline.front();
    hall.grid.resolution_m = 0.1;
    hall.grid.width = 600;
    hall.grid.height = 500;
    hall.grid.occupied.assign(600 * 500, 0);
    for (int row = 0; row < 500; ++row) {
        if (row >= 6 && row < 494) continue;
        for (int column = 0; column < 600; ++column) {
            hall.grid.occupied[static_cast<std::size_t>(row) * 600 + column] = column % 100 < 7;
        }
    }
    plant.halls = {hall};
    return plant;
}

/// Its walls and columns where the drawing has them.
inline OccupancyMap drawn(const plant::Hall& hall) {
    OccupancyMap map;
    map.corner = hall.grid.origin - geometry::Point2{1, 1};
    map.columns = 62 * 20;
    map.rows = 52 * 20;
    const auto stands = [&](geometry::Point2 place) {
        const geometry::Point2 in = place - hall.grid.origin;
        const auto column = static_cast<int>(std::floor(in.x_m * 10));
        const auto row = static_cast<int>(std::floor(in.y_m * 10));
        return !geometry::contains(hall.outline, place) || hall.grid.is_occupied(column, row);
    };
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            const geometry::Point2 middle = map.middle_of(column, row);
            const double cell_m = map.cell_m;
            const bool inside = stands({middle.x_m + cell_m, middle.y_m}) &&
                                stands({middle.x_m - cell_m, middle.y_m}) &&
                                stands({middle.x_m, middle.y_m + cell_m}) &&
                                stands({middle.x_m, middle.y_m - cell_m});
            map.free.push_back(!stands(middle) ? 255 : inside ? kNeverSeen : 0);
        }
    }
    return map;
}

/// A vehicle that sees the walls from the middle of it.
inline plant::VehicleType sees_far() {
    auto type = pulseline::testing::mecanum();
    for (auto& scanner : type.scanners) scanner.range_m = 30;
    return type;
}

}  // namespace pulseline::mapping::testing
