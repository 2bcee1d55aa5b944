#include "core/fleet/dispatch/cost_matching.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace pulseline::fleet {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Total {
    std::size_t served = 0;
    double cost = 0;
};

/// Every way to give columns to rows, tried out.
Total best_by_trial(const CostMatrix& matrix) {
    const std::size_t size = std::max(matrix.rows, matrix.columns);
    std::vector<std::size_t> order(size);
    std::iota(order.begin(), order.end(), std::size_t{0});
    Total best{0, 0};
    do {
        Total total;
        for (std::size_t row = 0; row < matrix.rows; ++row) {
            if (order[row] >= matrix.columns) continue;
            const double cost = matrix.at(row, order[row]);
            if (cost == kNever) continue;
            ++total.served;
            total.cost += cost;
        }
        if (total.served > best.served || (total.served == best.served && total.cost < best.cost)) {
            best = total;
        }
    } while (std::next_permutation(order.begin(), order.end()));
    return best;
}

TEST(Assignment, IsAsGoodAsTryingEverything) {
    std::mt19937_64 random(7);
    std::uniform_int_distribution<int> size(1, 6);
    std::uniform_real_distribution<double> cost(-500, 500);
    for (int trial = 0; trial < 400; ++trial) {
        CostMatrix matrix{
            static_cast<std::size_t>(size(random)), static_cast<std::size_t>(size(random)), {}};
        for (std::size_t i = 0; i < matrix.rows * matrix.columns; ++i) {
            matrix.costs.push_back(size(random) == 1 ? kNever : cost(random));
        }

        const auto assigned = assign(matrix);

        Total total;
        std::vector<std::size_t> used;
        for (std::size_t row = 0; row < matrix.rows; ++row) {
            if (!assigned[row]) continue;
            EXPECT_EQ(std::count(used.begin(), used.end(), *assigned[row]), 0) << "one job each";
            used.push_back(*assigned[row]);
            ASSERT_NE(matrix.at(row, *assigned[row]), kNever);
            ++total.served;
            total.cost += matrix.at(row, *assigned[row]);
        }
        const Total best = best_by_trial(matrix);
        EXPECT_EQ(total.served, best.served) << trial;
        EXPECT_NEAR(total.cost, best.cost, 1e-3) << trial;
    }
}

TEST(Assignment, NothingToDoIsNoFault) {
    EXPECT_TRUE(assign({}).empty());
    EXPECT_EQ(assign({2, 0, {}}), (std::vector<std::optional<std::size_t>>(2)));
}

}  // namespace
}  // namespace pulseline::fleet
