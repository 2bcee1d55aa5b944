#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/polygon.hpp"

/// Pieces of floor: what vehicles hold exclusively, and the sets of them that bodies and their
/// motions cover.
namespace pulseline::traffic {

using TileId = std::uint64_t;         // storey, hall index, and tile column and row
using TileSet = std::vector<TileId>;  // sorted, unique

constexpr double kTile_m = 0.5;  // fine enough that two parked platforms 3 m apart do not share one

/// Tiles that meet any of the convex pieces (hall frame) grown by margin_m.
TileSet tiles_under(std::size_t hall_index, const std::vector<geometry::Polygon>& pieces,
                    double margin_m);
geometry::Box tile_box(TileId tile);
/// The one over it in the storey above the floor, where loads hang and are carried (tile_box gives
/// the same for both). REQUIRES: a tile of the floor.
TileId above(TileId tile);
bool is_above_floor(TileId tile);
TileSet merge(const TileSet& a, const TileSet& b);
bool overlap(const TileSet& a, const TileSet& b);

}  // namespace pulseline::traffic
