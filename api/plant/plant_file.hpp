#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::api::plant_file {

/// Plant file -> plant with its grids. Every error found in the first step that fails (text,
/// fields, grids); `what` of each names the file. Says nothing about what validate() checks.
[[nodiscard]] tl::expected<plant::Plant, std::vector<Error>> read_plant_file(
    const std::filesystem::path& path);

/// The same with the first error only.
[[nodiscard]] Result<plant::Plant> load_plant_file(const std::filesystem::path& path);

/// Writes the plant and its grids, so that loading gives the same plant.
[[nodiscard]] Status save_plant_file(const plant::Plant& plant, const std::filesystem::path& path);

}  // namespace pulseline::api::plant_file
