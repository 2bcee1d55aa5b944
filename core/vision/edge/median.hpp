#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>

namespace pulseline::vision {

/// The middle one of any number of values, the upper of two; nothing of none. At the border of an
/// image there are fewer samples than a pattern has places. Changes the order of the values.
template <class Values>
std::optional<typename Values::value_type> median(Values& values) {
    if (std::empty(values)) return std::nullopt;
    const auto middle = std::begin(values) + static_cast<std::ptrdiff_t>(std::size(values) / 2);
    std::nth_element(std::begin(values), middle, std::end(values));
    return *middle;
}

}  // namespace pulseline::vision
