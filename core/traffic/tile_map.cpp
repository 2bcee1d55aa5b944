#include "core/traffic/tile_map.hpp"

#include <algorithm>
#include <iterator>

namespace pulseline::traffic {
std::optional<TileMap::Blocker> TileMap::try_hold(const plant::VehicleId& vehicle,
                                                  const TileSet& tiles) {
    for (const TileId tile : tiles) {
        const auto it = holder_.find(tile);
        if (it != holder_.end() && it->second != vehicle) return Blocker{it->second, tile};
    }
    for (const TileId tile : tiles) holder_.emplace(tile, vehicle);
    auto& held = held_[vehicle];
    held = merge(held, tiles);
    return std::nullopt;
}

void TileMap::keep_only(const plant::VehicleId& vehicle, const TileSet& tiles) {
    auto& held = held_[vehicle];
    TileSet kept;
    std::set_intersection(held.begin(), held.end(), tiles.begin(), tiles.end(),
                          std::back_inserter(kept));
    for (const TileId tile : held) {
        if (!std::binary_search(kept.begin(), kept.end(), tile)) holder_.erase(tile);
    }
    held = std::move(kept);
}

const TileSet& TileMap::held_by(const plant::VehicleId& vehicle) const {
    static const TileSet kNone;
    const auto it = held_.find(vehicle);
    return it == held_.end() ? kNone : it->second;
}

std::optional<plant::VehicleId> TileMap::holder(TileId tile) const {
    const auto it = holder_.find(tile);
    return it == holder_.end() ? std::nullopt : std::optional(it->second);
}

}  // namespace pulseline::traffic
