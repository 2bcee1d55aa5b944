#pragma once

#include <vector>

#include "core/plant/plant.hpp"
#include "core/traffic/tiles.hpp"

/// The storey above the floor: what hangs on a hoist or lies on stands is passed below by those
/// with empty brackets, and run into by those that carry something (Tang 2020, section 2: the
/// platform drives under the hoisted fuselage). Only where loads may stand does it have tiles.
namespace pulseline::fleet {

/// All that loads on the supports of the plant may take up of it.
traffic::TileSet overhead_of(const plant::Plant& plant);
/// What the load takes up of it on the station's support; nothing where there is none.
traffic::TileSet room_of_load(const plant::Plant& plant, const plant::Load& load,
                              const plant::Station& station);
/// What that is seen from above, convex pieces in the hall frame.
std::vector<geometry::Polygon> outline_of_load(const plant::Plant& plant, const plant::Load& load,
                                               const plant::Station& station);
/// Floor under pieces of a body (hall frame, convex), and with a load on it the room above that,
/// where other loads may stand.
traffic::TileSet tiles_of_body(const traffic::TileSet& overhead, std::size_t hall_index,
                               const std::vector<geometry::Polygon>& pieces, double margin_m,
                               bool loaded);

}  // namespace pulseline::fleet
