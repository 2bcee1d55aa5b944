#include "core/fleet/dispatch/cost_matching.hpp"

#include <cmath>
#include <limits>

namespace pulseline::fleet {
namespace {

// Dearer than any sum of possible costs, so that as few impossible pairs as can be are chosen.
constexpr double kImpossible = 1e13;

/// REQUIRES: rows <= columns. For each row its column.
std::vector<std::size_t> assign_all(const CostMatrix& matrix) {
    constexpr double kEver = std::numeric_limits<double>::infinity();
    const std::size_t n = matrix.rows;
    const std::size_t m = matrix.columns;
    const auto cost = [&](std::size_t row, std::size_t column) {
        const double c = matrix.at(row - 1, column - 1);
        return std::isfinite(c) ? c : kImpossible;
    };
    // Rows and columns count from 1; column 0 holds the row that is being placed.
    std::vector<double> row_potential(n + 1, 0);
    std::vector<double> column_potential(m + 1, 0);
    std::vector<std::size_t> row_of(m + 1, 0);
    std::vector<std::size_t> came_from(m + 1, 0);
    for (std::size_t row = 1; row <= n; ++row) {
        row_of[0] = row;
        std::size_t column = 0;
        std::vector<double> least(m + 1, kEver);
        std::vector<bool> used(m + 1, false);
        do {
            used[column] = true;
            const std::size_t here = row_of[column];
            double step = kEver;
            std::size_t next = 0;
            for (std::size_t j = 1; j <= m; ++j) {
                if (used[j]) continue;
                const double reduced = cost(here, j) - row_potential[here] - column_potential[j];
                if (reduced < least[j]) {
                    least[j] = reduced;
                    came_from[j] = column;
                }
                if (least[j] < step) {
                    step = least[j];
                    next = j;
                }
            }
            for (std::size_t j = 0; j <= m; ++j) {
                if (used[j]) {
                    row_potential[row_of[j]] += step;
                    column_potential[j] -= step;
                } else {
                    least[j] -= step;
                }
            }
            column = next;
        } while (row_of[column] != 0);
        while (column != 0) {
            row_of[column] = row_of[came_from[column]];
            column = came_from[column];
        }
    }
    std::vector<std::size_t> columns(n, 0);
    for (std::size_t j = 1; j <= m; ++j) {
        if (row_of[j] != 0) columns[row_of[j] - 1] = j - 1;
    }
    return columns;
}

}  // namespace

std::vector<std::optional<std::size_t>> assign(const CostMatrix& matrix) {
    std::vector<std::optional<std::size_t>> result(matrix.rows);
    if (matrix.rows == 0 || matrix.columns == 0) return result;
    const auto take = [&](std::size_t row, std::size_t column) {
        if (std::isfinite(matrix.at(row, column))) result[row] = column;
    };
    if (matrix.rows <= matrix.columns) {
        const auto columns = assign_all(matrix);
        for (std::size_t row = 0; row < matrix.rows; ++row) take(row, columns[row]);
        return result;
    }
    CostMatrix turned{matrix.columns, matrix.rows, std::vector<double>(matrix.costs.size())};
    for (std::size_t row = 0; row < matrix.rows; ++row) {
        for (std::size_t column = 0; column < matrix.columns; ++column) {
            turned.at(column, row) = matrix.at(row, column);
        }
    }
    const auto rows = assign_all(turned);
    for (std::size_t column = 0; column < matrix.columns; ++column) take(rows[column], column);
    return result;
}

}  // namespace pulseline::fleet
