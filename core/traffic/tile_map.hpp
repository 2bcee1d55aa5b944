#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/plant/plant.hpp"

/// Exclusive use of the floor. A leg is admitted only when all its tiles are free (one vehicle per
/// resource); from then on nobody else can get them until the vehicle has passed. Incremental plans
/// with the deadlock-free order of design.md section 6 take this file's place later.
namespace pulseline::traffic {

using TileId = std::uint64_t;         // hall index and tile column and row
using TileSet = std::vector<TileId>;  // sorted, unique

constexpr double kTile_m = 0.5;  // fine enough that two parked platforms 3 m apart do not share one

/// Tiles that meet any of the convex pieces (hall frame) grown by margin_m.
TileSet tiles_under(std::size_t hall_index, const std::vector<geometry::Polygon>& pieces,
                    double margin_m);
geometry::Box tile_box(TileId tile);
TileSet merge(const TileSet& a, const TileSet& b);

class TileMap {
public:
    struct Blocker {
        plant::VehicleId vehicle;
        TileId tile = 0;
    };

    /// Takes all tiles for the vehicle, or none and says who holds the first one in the way.
    std::optional<Blocker> try_hold(const plant::VehicleId& vehicle, const TileSet& tiles);
    /// Keeps only `tiles` of what the vehicle holds.
    void keep_only(const plant::VehicleId& vehicle, const TileSet& tiles);
    const TileSet& held_by(const plant::VehicleId& vehicle) const;
    std::optional<plant::VehicleId> holder(TileId tile) const;

private:
    std::unordered_map<TileId, plant::VehicleId> holder_;
    std::map<plant::VehicleId, TileSet> held_;
};

}  // namespace pulseline::traffic
