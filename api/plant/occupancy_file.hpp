#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.hpp"
#include "core/plant/occupancy_grid.hpp"

namespace pulseline::api::plant_file {

/// The six keys of a ROS map_server file.
struct MapYaml {
    std::string image;
    double resolution_m = 0;
    double origin_x_m = 0;
    double origin_y_m = 0;
    bool negate = false;
    double occupied_thresh = 0.65;
    double free_thresh = 0.196;
};

/// Reads the subset of YAML such files use: `key: value` lines, comments, quotes, one flow list.
/// Errors name file and key (reason map_yaml {file, key, line}).
[[nodiscard]] Result<MapYaml> parse_map_yaml(std::string_view text, const std::string& file);

/// Grid from the YAML file and the image beside it. What map_server calls unknown counts as
/// occupied: nobody has seen that it is free.
[[nodiscard]] Result<plant::OccupancyGrid> load_occupancy(const std::filesystem::path& yaml);

/// Writes NAME.yaml and NAME.pgm, so that loading gives the same grid.
[[nodiscard]] Status save_occupancy(const plant::OccupancyGrid& grid,
                                    const std::filesystem::path& yaml);

/// Whole file; reason file_unreadable {file}.
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path);
/// Written beside and renamed, so that nobody sees half a file; reason file_unwritable {file}.
[[nodiscard]] Status write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace pulseline::api::plant_file
