#include "core/planning/grid/grid_map.hpp"

#include <algorithm>

#include "core/planning/grid/search_choice.hpp"

namespace pulseline::planning {
GridMap::GridMap(GridLayers layers)
    : layers_(std::move(layers)),
      stride_(static_cast<std::size_t>(layers_.width) + 2),
      nowhere_(find_nowhere()),
      landmarks_(nowhere_) {
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
    build_planes();
    judge_jumps();
}

bool GridMap::blocked_for_all(Cell cell) const {
    return std::ranges::all_of(layers_.blocked,
                               [&](const BitGrid& layer) { return layer.test(cell); });
}

BitGrid GridMap::find_nowhere() const {
    BitGrid all(width(), height());
    for (int row = 0; row < height(); ++row) {
        for (int col = 0; col < width(); ++col) {
            all.set({col, row}, blocked_for_all({col, row}));
        }
    }
    return all;
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

void GridMap::build_planes() {
    if (weighted()) return planes_.reset();
    BitGrid barred(width(), height());
    for (int row = 0; row < height(); ++row) {
        for (int col = 0; col < width(); ++col) barred.set({col, row}, !is_plain({col, row}));
    }
    planes_.emplace(barred);
}

void GridMap::judge_jumps() {
    if (uniform() && !jumps_pay_) jumps_pay_ = planning::jumps_pay(*this);
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
    const auto for_changed = [&](auto visit) {
        for (int row = changed.first.row; row <= changed.last.row; ++row) {
            for (int col = changed.first.col; col <= changed.last.col; ++col) visit(Cell{col, row});
        }
    };
    for_changed([&](Cell cell) { irregular_ -= irregular(cell) ? 1 : 0; });
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
    std::vector<Cell> all;
    for_changed([&](Cell cell) { all.push_back(cell); });
    if (had_weights && !weighted()) build_planes();
    follow(all);
}

void GridMap::set_blocked(Cell cell, bool blocked) {
    if (layers_.blocked[0].test(cell) == blocked && !irregular(cell)) return;
    irregular_ -= irregular(cell) ? 1 : 0;
    for (BitGrid& layer : layers_.blocked) layer.set(cell, blocked);
    irregular_ += irregular(cell) ? 1 : 0;
    refresh({cell, cell});
    follow({cell});
}

void GridMap::follow(const std::vector<Cell>& changed) {
    std::vector<Cell> freed;
    for (const Cell cell : changed) {
        const bool was = nowhere_.test(cell);
        const bool is = blocked_for_all(cell);
        nowhere_.set(cell, is);
        if (was && !is) freed.push_back(cell);
        const bool barred = !is_plain(cell);
        if (planes_ && planes_->is_blocked(cell) != barred) planes_->set_blocked(cell, barred);
    }
    for (const Cell cell : freed) landmarks_.freed(nowhere_, cell);
    if (weighted()) planes_.reset();
    judge_jumps();
}

std::size_t GridMap::bytes() const {
    std::size_t sum = layers_.bytes() + moves_.size() + nowhere_.bytes() + landmarks_.bytes();
    if (planes_) sum += planes_->bytes();
    return sum;
}

}  // namespace pulseline::planning
