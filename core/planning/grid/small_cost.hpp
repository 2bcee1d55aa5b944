#pragma once

#include <numeric>
#include <optional>

#include "core/planning/grid/grid_cost.hpp"
#include "core/planning/grid/grid_map.hpp"

namespace pulseline::planning {

/// Costs divided by their greatest common divisor, for 32-bit sums and bucket queues.
struct SmallCost {
    std::int32_t step = 1;
    std::int32_t turn = 1;
    std::int64_t unit = 1;  // thousandths of k that one stands for

    // Sums stay below this; a search that comes near it leaves the query to 64 bits.
    static constexpr std::uint32_t kMost = 1u << 30;
    static constexpr std::uint32_t kNoRoute = kMost;

    /// nullopt when one way straight through the map may already be too much.
    static std::optional<SmallCost> of(const GridCost& cost, const GridMap& map) {
        const std::int64_t unit = std::max(std::int64_t{1}, std::gcd(cost.step, cost.turn));
        const std::int64_t step = cost.step / unit;
        const std::int64_t turn = cost.turn / unit;
        const std::int64_t steps = std::int64_t{2} * map.greatest_weight() *
                                   (std::int64_t{map.width()} + map.height() + 4);
        constexpr std::int64_t kHalf = kMost / 2;
        if (step > kHalf / steps || turn > kHalf / 4) return std::nullopt;
        return SmallCost{static_cast<std::int32_t>(step), static_cast<std::int32_t>(turn), unit};
    }
};

}  // namespace pulseline::planning
