#include "core/localisation/line_of_sight.hpp"

#include <algorithm>

#include "core/plant/grid_blocks.hpp"

namespace pulseline::localisation {

using geometry::Point2;

bool in_sight(const plant::Plant& plant, const plant::HallId& hall, Point2 from, Point2 to) {
    const auto* here = plant::find_hall(plant, hall);
    if (here == nullptr || geometry::crosses(here->outline, from, to)) return false;
    if (plant::crosses_grid(*here, from, to)) return false;
    return std::ranges::none_of(plant.areas, [&](const plant::Area& area) {
        return area.kind == plant::AreaKind::kObstacle && area.hall == hall &&
               (geometry::crosses(area.outline, from, to) || geometry::contains(area.outline, to));
    });
}

}  // namespace pulseline::localisation
