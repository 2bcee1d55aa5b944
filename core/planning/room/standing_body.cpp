#include "core/planning/room/standing_body.hpp"

#include <algorithm>

namespace pulseline::planning {

using geometry::Polygon;

double distance_to(const StandingBody& body, const std::vector<Polygon>& pieces, double enough_m) {
    double least = enough_m;
    for (const Polygon& outline : body.outline) {
        const auto box = geometry::bounding_box(outline);
        for (const Polygon& piece : pieces) {
            const auto own = geometry::bounding_box(piece);
            const double dx = std::max(box.min.x_m - own.max.x_m, own.min.x_m - box.max.x_m);
            const double dy = std::max(box.min.y_m - own.max.y_m, own.min.y_m - box.max.y_m);
            if (std::max(dx, dy) >= least) continue;
            least = std::min(least, geometry::distance(piece, outline));
        }
    }
    return least;
}

}  // namespace pulseline::planning
