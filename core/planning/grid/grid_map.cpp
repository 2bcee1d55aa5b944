#include "core/planning/grid/grid_map.hpp"

#include <algorithm>

#include "core/planning/grid/search_choice.hpp"

namespace pulseline::planning {
GridMap::GridMap(GridLayers layers)
    : layers_(std::move(layers)), stride_(static_cast<std::size_t>(layers_.width) + 2) {
    moves_.assign(stride_ * (static_cast<std::size_t>(layers_.height) + 2), 0);
    for (const std::uint8_t weight : layers_.weight) {
        greatest_weight_ = std::max<int>(greatest_weight_, weight);
    }
    for (int row = 0; row < height(); ++row) {
        for (int col = 0; col < width(); ++col) {
            moves_[padded({col, row})] = moves_of({col, row});
            irregular_ += irregular({col, row}) ? 1 : 0;
        }
    }
    if (irregular_ == 0 && !weighted()) build_tables();
}

bool GridMap::nowhere(Cell cell) const {
    return std::all_of(layers_.blocked.begin(), layers_.blocked.end(),
                       [&](const BitGrid& layer) { return layer.test(cell); });
}

std::uint8_t GridMap::moves_of(Cell cell) const {
    unsigned moves = layers_.no_turn.test(cell) ? 0u : unsigned{kMayTurn};
    for (int d = 0; d < kDirections; ++d) {
        const auto heading = static_cast<Direction>(d);
        const BitGrid& no_exit = layers_.no_exit[static_cast<std::size_t>(d)];
        const Cell next = next_to(cell, d);
        if (layers_.is_blocked(heading, cell) || !inside(next) ||
            layers_.is_blocked(heading, next) || (!no_exit.empty() && no_exit.test(cell))) {
            continue;
        }
        moves |= 1u << d;
    }
    return static_cast<std::uint8_t>(moves);
}

bool GridMap::irregular(Cell cell) const {
    const bool blocked = layers_.blocked[0].test(cell);
    for (std::size_t d = 0; d < kDirections; ++d) {
        if (layers_.blocked[d].test(cell) != blocked) return true;
        const BitGrid& no_exit = layers_.no_exit[d];
        if (!blocked && !no_exit.empty() && no_exit.test(cell)) return true;
    }
    return !blocked && layers_.no_turn.test(cell);
}

void GridMap::build_tables() {
    tables_.emplace(Tables{TurnPlanes(layers_.blocked[0]), Landmarks(layers_.blocked[0])});
    tables_->jumps_pay = planning::jumps_pay(*this);
}

void GridMap::refresh(CellBox box) {
    const int first_row = std::max(box.first.row - 1, 0);
    const int last_row = std::min(box.last.row + 1, height() - 1);
    const int first_col = std::max(box.first.col - 1, 0);
    const int last_col = std::min(box.last.col + 1, width() - 1);
    for (int row = first_row; row <= last_row; ++row) {
        for (int col = first_col; col <= last_col; ++col) {
            moves_[padded({col, row})] = moves_of({col, row});
        }
    }
}

void GridMap::update(const GridLayers& layers, CellBox changed) {
    if (changed.empty()) return;
    // What of the floor itself changes matters to the tables.
    std::vector<Cell> toggled;
    const auto for_changed = [&](auto visit) {
        for (int row = changed.first.row; row <= changed.last.row; ++row) {
            for (int col = changed.first.col; col <= changed.last.col; ++col) visit(Cell{col, row});
        }
    };
    for_changed([&](Cell cell) {
        irregular_ -= irregular(cell) ? 1 : 0;
        if (layers.blocked[0].test(cell) != layers_.blocked[0].test(cell)) toggled.push_back(cell);
    });
    const bool had_weights = weighted();
    if (had_weights || !layers.weight.empty()) layers_.weight = layers.weight;
    for (std::size_t d = 0; d < kDirections; ++d) {
        if (layers_.no_exit[d].empty() && !layers.no_exit[d].empty()) {
            layers_.no_exit[d] = BitGrid(width(), height());
        }
    }
    for_changed([&](Cell cell) {
        for (std::size_t d = 0; d < kDirections; ++d) {
            layers_.blocked[d].set(cell, layers.blocked[d].test(cell));
            if (layers_.no_exit[d].empty()) continue;
            layers_.no_exit[d].set(cell,
                                   !layers.no_exit[d].empty() && layers.no_exit[d].test(cell));
        }
        layers_.no_turn.set(cell, layers.no_turn.test(cell));
        irregular_ += irregular(cell) ? 1 : 0;
        if (weighted()) greatest_weight_ = std::max(greatest_weight_, weight(cell));
    });
    refresh(changed);
    follow(toggled);
}

void GridMap::set_blocked(Cell cell, bool blocked) {
    if (layers_.blocked[0].test(cell) == blocked && !irregular(cell)) return;
    irregular_ -= irregular(cell) ? 1 : 0;
    for (BitGrid& layer : layers_.blocked) layer.set(cell, blocked);
    irregular_ += irregular(cell) ? 1 : 0;
    refresh({cell, cell});
    follow({cell});
}

void GridMap::follow(const std::vector<Cell>& toggled) {
    if (irregular_ != 0 || weighted()) return tables_.reset();
    if (!tables_) return build_tables();
    for (const Cell cell : toggled) {
        const bool blocked = layers_.blocked[0].test(cell);
        tables_->planes.set_blocked(cell, blocked);
        if (!blocked) tables_->landmarks.freed(layers_.blocked[0], cell);
    }
}

std::size_t GridMap::bytes() const {
    std::size_t sum = layers_.bytes() + moves_.size();
    if (tables_) sum += tables_->planes.bytes() + tables_->landmarks.bytes();
    return sum;
}

}  // namespace pulseline::planning
