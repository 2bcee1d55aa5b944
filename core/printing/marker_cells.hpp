#pragma once

#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::printing {

/// The square cells of a QR code or an AprilTag as printed, without the white around them.
struct MarkerCells {
    int side = 0;   // cells
    int quiet = 0;  // white cells around that belong to the marker
    std::vector<bool> dark;

    bool at(int row, int column) const {
        return dark[static_cast<std::size_t>(row * side + column)];
    }
};

/// Cells of `payload`: QR version 1, level Q (11 bytes, or 16 capital letters, digits and dashes);
/// AprilTag 36h11 ("0" to "586"). Landmarks have none: plant/marker_geometry.hpp says all of them.
/// Fails with payload_too_long, payload_unknown. Thread safety: any thread.
Result<MarkerCells> marker_cells(plant::MarkerKind kind, const std::string& payload);

}  // namespace pulseline::printing
