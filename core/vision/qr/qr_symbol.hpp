#pragma once

#include <optional>
#include <string>

#include "core/vision/search/cell_grid.hpp"

namespace pulseline::vision {

/// What the standard prints in a module of version 1 whatever the payload (true: dark); nothing
/// for data.
std::optional<bool> fixed_module(int row, int column);

/// Share of finder, separator and timing modules that are as the standard prints them.
double fixed_pattern_share(const CellGrid& modules);

struct QrText {
    std::string payload;
    bool mirrored = false;
};

/// Decodes sampled modules; nothing when they are no valid symbol.
std::optional<QrText> decode_qr(const CellGrid& modules);

}  // namespace pulseline::vision
