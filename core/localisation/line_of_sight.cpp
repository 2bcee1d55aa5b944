#include "core/localisation/line_of_sight.hpp"

#include <algorithm>

namespace pulseline::localisation {
namespace {

using geometry::Point2;

/// Proper crossing: an end that only touches the other line is none.
bool cross(Point2 a, Point2 b, Point2 c, Point2 d) {
    const auto side = [](Point2 from, Point2 to, Point2 p) {
        return geometry::cross(to - from, p - from);
    };
    return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

bool crosses(const geometry::Polygon& ring, Point2 from, Point2 to) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        if (cross(from, to, ring[i], ring[(i + 1) % ring.size()])) return true;
    }
    return false;
}

}  // namespace

bool in_sight(const plant::Plant& plant, const plant::HallId& hall, Point2 from, Point2 to) {
    const auto* here = plant::find_hall(plant, hall);
    if (here == nullptr || crosses(here->outline, from, to)) return false;
    return std::ranges::none_of(plant.areas, [&](const plant::Area& area) {
        return area.kind == plant::AreaKind::kObstacle && area.hall == hall &&
               (crosses(area.outline, from, to) || geometry::contains(area.outline, to));
    });
}

}  // namespace pulseline::localisation
