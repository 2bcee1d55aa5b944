#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/planning/grid/grid_layers.hpp"
#include "core/planning/grid/landmarks.hpp"
#include "core/planning/grid/turn_planes.hpp"

namespace pulseline::planning {

/// Layers made ready for searches: one byte of moves a cell, lower bounds of all ways, and the
/// planes of the turn-jump search.
///
/// Thread safety: an unchanging map may be read by any number of searches at once. To edit a map
/// that is in use, copy it, update the copy and hand that to the searches that follow.
class GridMap {
public:
    explicit GridMap(GridLayers layers);

    int width() const { return layers_.width; }
    int height() const { return layers_.height; }
    const GridLayers& layers() const { return layers_; }
    bool inside(Cell cell) const { return layers_.inside(cell); }

    /// Cells are numbered with a border of one cell around the grid, so that every step stays
    /// inside the arrays.
    std::size_t padded(Cell cell) const {
        return (static_cast<std::size_t>(cell.row) + 1) * stride_ +
               static_cast<std::size_t>(cell.col) + 1;
    }
    std::size_t padded_cells() const { return moves_.size(); }
    std::size_t stride() const { return stride_; }

    static constexpr std::uint8_t kMayTurn = 1 << kDirections;
    /// Bit d: a step along direction d is open; kMayTurn: headings may change here.
    std::uint8_t moves(std::size_t padded) const { return moves_.data()[padded]; }
    int weight(Cell cell) const {
        return layers_.weight.empty() ? 1 : layers_.weight[layers_.index(cell)];
    }
    bool weighted() const { return !layers_.weight.empty(); }
    int greatest_weight() const { return greatest_weight_; }
    /// Blocked for every heading.
    bool nowhere(Cell cell) const { return nowhere_.test(cell); }
    /// Of the ways over cells that are free for some heading.
    const Landmarks& landmarks() const { return landmarks_; }

    /// Every free cell may be entered, left and turned in alike: what the turn-jump search needs.
    bool uniform() const { return irregular_ == 0 && !weighted(); }
    /// Where that holds of a cell; the planes know the others as blocked.
    bool is_plain(Cell cell) const { return !layers_.blocked[0].test(cell) && !irregular(cell); }
    /// Whether the turn-jump search takes less time than the bucket search here (see
    /// search_choice.hpp), which is about the kind of floor: edits keep the answer. True where it
    /// is not the one to answer: on a floor that is not uniform it finds a way to beat.
    bool jumps_pay() const { return planes_ && jumps_pay_.value_or(true); }
    // REQUIRES: not weighted().
    const TurnPlanes& planes() const { return *planes_; }

    /// Takes over `layers`, which differ from the present ones in `changed` only. Costs a little
    /// more than the changed cells; some searches when it becomes uniform by the edit.
    void update(const GridLayers& layers, CellBox changed);
    /// The same for the map of a vehicle of one cell. REQUIRES: inside(cell).
    void set_blocked(Cell cell, bool blocked);

    std::size_t bytes() const;

private:
    std::uint8_t moves_of(Cell cell) const;
    bool irregular(Cell cell) const;
    bool blocked_for_all(Cell cell) const;
    BitGrid find_nowhere() const;
    void refresh(CellBox box);
    void build_planes();
    void judge_jumps();
    void follow(const std::vector<Cell>& changed);

    GridLayers layers_;
    std::size_t stride_;
    int greatest_weight_ = 1;
    std::size_t irregular_ = 0;  // cells where headings differ, turns are barred, or of one way
    std::vector<std::uint8_t> moves_;
    BitGrid nowhere_;
    Landmarks landmarks_;
    std::optional<TurnPlanes> planes_;
    std::optional<bool> jumps_pay_;
};

}  // namespace pulseline::planning
