#include "api/plant/plant_file.hpp"

#include "api/plant/occupancy_file.hpp"
#include "api/plant/plant_codec.hpp"

namespace pulseline::api::plant_file {

using namespace plant;

namespace {

namespace fs = std::filesystem;

Error in_file(Error error, const fs::path& path) {
    error.what = path.filename().string() + (error.field.empty() ? "" : " " + error.field) + ": " +
                 error.what;
    return error;
}

bool leads_outside(const fs::path& name) {
    if (name.is_absolute()) return true;
    for (const fs::path& part : name) {
        if (part == "..") return true;
    }
    return false;
}

void load_grids(Plant& plant, const fs::path& folder, std::vector<Error>& errors) {
    for (std::size_t i = 0; i < plant.halls.size(); ++i) {
        Hall& hall = plant.halls[i];
        if (hall.occupancy_yaml.empty()) continue;
        const std::string field = "/halls/" + std::to_string(i) + "/occupancy_yaml";
        if (leads_outside(hall.occupancy_yaml)) {
            errors.push_back({Errc::kInvalid,
                              {"map_yaml", {{"file", hall.occupancy_yaml}}},
                              field + ": name a file beside the plant file.",
                              field});
            continue;
        }
        auto grid = load_occupancy(folder / hall.occupancy_yaml);
        if (grid) {
            hall.grid = std::move(*grid);
        } else {
            Error error = std::move(grid.error());
            error.field = field;
            errors.push_back(std::move(error));
        }
    }
}

}  // namespace

tl::expected<Plant, std::vector<Error>> read_plant_file(const fs::path& path) {
    const auto failed = [](std::vector<Error> errors) { return tl::unexpected(std::move(errors)); };
    const auto text = read_file(path);
    if (!text) return failed({text.error()});
    const auto parsed = json::parse_json(*text, json::kPlantImport);
    if (!parsed) return failed({in_file(parsed.error(), path)});
    json::FieldErrors field_errors;
    Plant plant = decode_plant(*parsed, field_errors);
    std::vector<Error> errors;
    for (const Error& error : field_errors.all()) errors.push_back(in_file(error, path));
    if (!errors.empty()) return failed(std::move(errors));
    load_grids(plant, path.parent_path(), errors);
    if (!errors.empty()) return failed(std::move(errors));
    return plant;
}

Result<Plant> load_plant_file(const fs::path& path) {
    auto plant = read_plant_file(path);
    if (!plant) return fail(std::move(plant.error().front()));
    return std::move(*plant);
}

Status save_plant_file(const Plant& plant, const fs::path& path) {
    for (const Hall& hall : plant.halls) {
        if (hall.occupancy_yaml.empty() || hall.grid.empty()) continue;
        if (leads_outside(hall.occupancy_yaml)) {
            return fail(Errc::kInvalid, "map_yaml",
                        hall.occupancy_yaml + ": name a file beside the plant file.");
        }
        const fs::path yaml = path.parent_path() / hall.occupancy_yaml;
        std::error_code problem;  // write_file reports what comes of it
        if (yaml.has_parent_path()) fs::create_directories(yaml.parent_path(), problem);
        if (const Status saved = save_occupancy(hall.grid, yaml); !saved) return saved;
    }
    return write_file(path, plant_to_json(plant));
}

}  // namespace pulseline::api::plant_file
