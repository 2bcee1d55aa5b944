#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace pulseline::fleet {

/// Costs of giving job `row` to agent `column`; infinity: not possible.
struct CostMatrix {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<double> costs;  // row by row
    double& at(std::size_t row, std::size_t column) { return costs[row * columns + column]; }
    double at(std::size_t row, std::size_t column) const { return costs[row * columns + column]; }
};

/// Assignment with the most rows served and, among those, the least sum of costs: each row gets a
/// column or none, each column at most one row. Hungarian method with potentials, O(n^2 m) for
/// n = min(rows, columns) (Kuhn 1955, Munkres 1957; shortest augmenting paths of Jonker and
/// Volgenant 1987). Deterministic. Finite costs must be below 1e9 in magnitude.
std::vector<std::optional<std::size_t>> assign(const CostMatrix& matrix);

}  // namespace pulseline::fleet
