#include "core/fleet/tables/overhead.hpp"

#include <algorithm>

#include "core/fleet/tables/hall_index.hpp"
#include "core/geometry/convex.hpp"
#include "core/plant/carrying.hpp"

namespace pulseline::fleet {
namespace {

using geometry::Polygon;

/// Of what the type usually carries.
const Polygon& usual_outline(const plant::VehicleType& type) {
    return type.load_footprint.empty() ? type.footprint : type.load_footprint;
}

void add_at(const geometry::Pose2& pose, const Polygon& outline, std::vector<Polygon>& pieces) {
    for (const auto& piece : geometry::convex_pieces(outline)) {
        pieces.push_back(geometry::transformed(pose, piece));
    }
}

traffic::TileSet raised(traffic::TileSet tiles) {
    for (auto& tile : tiles) tile = traffic::above(tile);
    return tiles;
}

}  // namespace

traffic::TileSet overhead_of(const plant::Plant& plant) {
    traffic::TileSet overhead;
    for (const auto& station : plant.stations) {
        if (!station.support) continue;
        std::vector<Polygon> pieces;
        for (const auto& type : plant.vehicle_types) {
            if (!type.brackets.empty()) add_at(station.pose, usual_outline(type), pieces);
        }
        // What loads come to later stays within what their carriers are planned with.
        for (const auto& load : plant.loads) {
            if (!load.outline.empty()) add_at(station.pose, load.outline, pieces);
        }
        overhead = traffic::merge(
            overhead, raised(traffic::tiles_under(hall_index(plant, station.hall), pieces, 0)));
    }
    return overhead;
}

std::vector<Polygon> outline_of_load(const plant::Plant& plant, const plant::Load& load,
                                     const plant::Station& station) {
    std::vector<Polygon> pieces;
    if (!load.outline.empty()) {
        add_at(station.pose, load.outline, pieces);
        return pieces;
    }
    for (const auto& type : plant.vehicle_types) {
        if (!plant::cannot_carry(type, load)) add_at(station.pose, usual_outline(type), pieces);
    }
    return pieces;
}

traffic::TileSet room_of_load(const plant::Plant& plant, const plant::Load& load,
                              const plant::Station& station) {
    if (!station.support) return {};
    return raised(traffic::tiles_under(hall_index(plant, station.hall),
                                       outline_of_load(plant, load, station), 0));
}

traffic::TileSet tiles_of_body(const traffic::TileSet& overhead, std::size_t hall_index,
                               const std::vector<Polygon>& pieces, double margin_m, bool loaded) {
    auto tiles = traffic::tiles_under(hall_index, pieces, margin_m);
    if (!loaded || overhead.empty()) return tiles;
    const std::size_t floor = tiles.size();
    for (std::size_t i = 0; i < floor; ++i) {
        const auto room = traffic::above(tiles[i]);  // they sort behind all of the floor
        if (std::ranges::binary_search(overhead, room)) tiles.push_back(room);
    }
    return tiles;
}

}  // namespace pulseline::fleet
