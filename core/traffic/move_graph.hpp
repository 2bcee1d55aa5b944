#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/traffic/record.hpp"
#include "core/traffic/tiles.hpp"

/// What vehicles of one class can do on the floor: places to stand and moves between them.
namespace pulseline::traffic {

using TileIndex = std::uint32_t;             // dense handle of a tile, from TileTable
using TileIndexes = std::vector<TileIndex>;  // sorted, unique

/// A place of the caller's graph: tiles under a vehicle of the class that stands there, position
/// error included.
struct Place {
    TileSet stand;
    bool resting = false;  // vehicles may end their plans there
};

/// A way from one place to the next that is driven without a need to stop in between.
struct Move {
    PlaceIndex from = kNoPlace;
    PlaceIndex to = kNoPlace;
    TileSet swept;  // tail included; the stands of both ends are added by the library
    double duration_s = 0;
};

/// The caller's move graph of a vehicle class. Plain data; `Traffic::add_graph` takes it over.
struct MoveGraph {
    std::vector<Place> places;
    std::vector<Move> moves;
};

/// Tiles by dense handles, so that the hot path indexes vectors.
class TileTable {
public:
    TileIndex index_of(TileId tile);  // makes a handle for a tile not seen before
    TileIndexes indexes_of(const TileSet& tiles);
    std::optional<TileIndex> find(TileId tile) const;
    TileId id_of(TileIndex index) const { return ids_[index]; }
    TileSet ids_of(const TileIndexes& tiles) const;
    std::size_t size() const { return ids_.size(); }
    const std::vector<TileId>& ids() const { return ids_; }

    /// Shows a visitor all that counts, for snapshots; one that reads may change it.
    template <class V, class Self>
    static void members(V& visit, Self& self) {
        auto& [indexes, ids] = self;
        visit(ids);
        if constexpr (!std::is_const_v<Self>) {
            indexes.clear();
            for (std::size_t i = 0; i < ids.size(); ++i) {
                indexes.emplace(ids[i], static_cast<TileIndex>(i));
            }
        }
    }

private:
    std::unordered_map<TileId, TileIndex> indexes_;
    std::vector<TileId> ids_;
};

/// Floor that a move needs; shared by all plans that contain the move.
struct Shape {
    TileIndexes swept;  // from its grant until the tail has left; holds the stands of both ends
    TileIndexes stand;  // what the vehicle keeps after it
};
using ShapePtr = std::shared_ptr<const Shape>;

ShapePtr make_shape(TileIndexes swept, const TileIndexes& stand_before, TileIndexes stand_after);
TileIndexes merge(const TileIndexes& a, const TileIndexes& b);
TileIndexes without(const TileIndexes& a, const TileIndexes& b);
bool meet(const TileIndexes& a, const TileIndexes& b);

/// A move graph with dense tiles, sorted by the place where moves start.
struct CompiledGraph {
    struct Arc {
        PlaceIndex to = kNoPlace;
        float duration_s = 0;
        std::uint32_t floor = 0;  // the same number for moves that sweep the same tiles
        ShapePtr shape;
    };
    struct Node {
        TileIndexes stand;
        bool resting = false;
    };
    std::vector<Node> places;
    std::vector<PlaceIndex> resting;
    std::vector<std::uint32_t> first_arc;  // per place, and one past the last
    std::vector<Arc> arcs;
    std::uint32_t floors = 0;
    std::vector<std::uint32_t> first_back;  // arcs by the place where they end
    std::vector<std::pair<PlaceIndex, float>> back;
};

/// REQUIRES: from and to of every move are places of the graph, durations are positive.
CompiledGraph compile(const MoveGraph& graph, TileTable& tiles);

/// Least time in seconds from every place to the nearest of `goals` on an empty floor; infinity
/// where no way leads there. Dijkstra on the reversed graph.
std::vector<float> times_to(const CompiledGraph& graph, const std::vector<PlaceIndex>& goals);

}  // namespace pulseline::traffic
