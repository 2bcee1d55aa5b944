#include "api/plant/occupancy_file.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "api/plant/image_file.hpp"

namespace pulseline::api::plant_file {

using namespace plant;

namespace {

constexpr std::uintmax_t kLargestFile = 256u << 20;

tl::unexpected<Error> bad_key(const std::string& file, const std::string& key, std::int64_t line,
                              const std::string& why) {
    return fail(
        Errc::kInvalid, "map_yaml",
        file + (line > 0 ? ", line " + std::to_string(line) : "") + ", key \"" + key + "\": " + why,
        key, {{"file", file}, {"key", key}, {"line", line}});
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t\r";
    const std::size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// Value without comment and quotes.
std::string_view plain_value(std::string_view text) {
    text = trimmed(text);
    if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'')) {
        const std::size_t close = text.find(text.front(), 1);
        if (close != std::string_view::npos) return text.substr(1, close - 1);
    }
    return trimmed(text.substr(0, text.find('#')));
}

bool parse_number(std::string_view text, double& value) {
    text = trimmed(text);
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    return parsed.ec == std::errc() && parsed.ptr == text.data() + text.size() &&
           std::isfinite(value);
}

bool parse_origin(std::string_view text, MapYaml& map, double& yaw_rad) {
    if (text.size() < 2 || text.front() != '[' || text.back() != ']') return false;
    text = text.substr(1, text.size() - 2);
    const std::size_t first = text.find(',');
    const std::size_t second = first == std::string_view::npos ? first : text.find(',', first + 1);
    if (second == std::string_view::npos) return false;
    return parse_number(text.substr(0, first), map.origin_x_m) &&
           parse_number(text.substr(first + 1, second - first - 1), map.origin_y_m) &&
           parse_number(text.substr(second + 1), yaw_rad);
}

/// What is wrong with the value, empty when nothing is.
std::string set_key(MapYaml& map, std::string_view key, std::string_view value) {
    if (key == "image") {
        map.image = std::string(value);
        const std::filesystem::path path(map.image);
        if (path.empty() || path.is_absolute() || *path.begin() == "..") {
            return "name an image file beside this one.";
        }
    } else if (key == "resolution") {
        if (!parse_number(value, map.resolution_m) || map.resolution_m < 0.001 ||
            map.resolution_m > 10) {
            return "write metres per pixel, 0.001 to 10.";
        }
    } else if (key == "origin") {
        double yaw_rad = 0;
        if (!parse_origin(value, map, yaw_rad)) return "write [x, y, 0] in metres.";
        if (yaw_rad != 0) return "a turned grid is not supported; turn the image and write yaw 0.";
    } else if (key == "negate") {
        if (value != "0" && value != "1") return "write 0 or 1.";
        map.negate = value == "1";
    } else if (key == "occupied_thresh" || key == "free_thresh") {
        double& to = key == "free_thresh" ? map.free_thresh : map.occupied_thresh;
        if (!parse_number(value, to) || to < 0 || to > 1) return "write a share, 0 to 1.";
    } else if (key == "mode") {
        if (value != "trinary") return "only trinary maps are read.";
    } else {
        return "there is no such key; remove it.";
    }
    return {};
}

}  // namespace

Result<MapYaml> parse_map_yaml(std::string_view text, const std::string& file) {
    MapYaml map;
    std::set<std::string> seen;
    std::int64_t line_number = 0;
    while (!text.empty()) {
        ++line_number;
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty() || line.front() == '#' || line == "---") continue;
        const std::size_t colon = line.find(':');
        const std::string key(trimmed(line.substr(0, colon)).substr(0, 40));
        if (colon == std::string_view::npos) {
            return bad_key(file, key, line_number, "write \"key: value\".");
        }
        if (!seen.insert(key).second) return bad_key(file, key, line_number, "it stands twice.");
        const std::string wrong = set_key(map, key, plain_value(line.substr(colon + 1)));
        if (!wrong.empty()) return bad_key(file, key, line_number, wrong);
    }
    for (const char* key :
         {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"}) {
        if (seen.count(key) == 0) return bad_key(file, key, 0, "it is missing; add it.");
    }
    if (map.free_thresh >= map.occupied_thresh) {
        return bad_key(file, "free_thresh", 0, "it must be smaller than occupied_thresh.");
    }
    return map;
}

Result<OccupancyGrid> load_occupancy(const std::filesystem::path& yaml) {
    const auto text = read_file(yaml);
    if (!text) return fail(text.error());
    const auto map = parse_map_yaml(*text, yaml.filename().string());
    if (!map) return fail(map.error());
    const std::filesystem::path image_path = yaml.parent_path() / map->image;
    const auto bytes = read_file(image_path);
    if (!bytes) return fail(bytes.error());
    const auto image = decode_image(*bytes, image_path.filename().string());
    if (!image) return fail(image.error());

    OccupancyGrid grid;
    grid.width = image->width;
    grid.height = image->height;
    grid.resolution_m = map->resolution_m;
    grid.origin = {map->origin_x_m, map->origin_y_m};
    grid.occupied.resize(image->pixels.size());
    const auto width = static_cast<std::size_t>(grid.width);
    const auto height = static_cast<std::size_t>(grid.height);
    for (std::size_t row = 0; row < height; ++row) {
        for (std::size_t col = 0; col < width; ++col) {
            const std::uint8_t value = image->pixels[(height - 1 - row) * width + col];
            const double darkness = (map->negate ? value : 255 - value) / 255.0;
            grid.occupied[row * width + col] = darkness < map->free_thresh ? 0 : 1;
        }
    }
    return grid;
}

Status save_occupancy(const OccupancyGrid& grid, const std::filesystem::path& yaml) {
    GreyImage image{grid.width, grid.height, {}};
    image.pixels.reserve(grid.occupied.size());
    const auto width = static_cast<std::size_t>(grid.width);
    for (std::size_t row = static_cast<std::size_t>(grid.height); row-- > 0;) {
        for (std::size_t col = 0; col < width; ++col) {
            image.pixels.push_back(grid.occupied[row * width + col] != 0 ? 0 : 254);
        }
    }
    std::filesystem::path image_path = yaml;
    image_path.replace_extension(".pgm");
    const auto shown = [](double value) {
        char buffer[32];
        return std::string(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
    };
    const std::string text = "image: " + image_path.filename().string() +
                             "\nresolution: " + shown(grid.resolution_m) + "\norigin: [" +
                             shown(grid.origin.x_m) + ", " + shown(grid.origin.y_m) +
                             ", 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
    const Status saved = write_file(image_path, encode_pgm(image));
    return saved ? write_file(yaml, text) : saved;
}

Result<std::string> read_file(const std::filesystem::path& path) {
    const auto unreadable = [&](const std::string& why) {
        return fail(Errc::kNotFound, "file_unreadable", path.string() + ": " + why, {},
                    {{"file", path.string()}});
    };
    std::error_code problem;
    if (!std::filesystem::is_regular_file(path, problem)) {
        return unreadable("there is no such file; check the path.");
    }
    if (std::filesystem::file_size(path, problem) > kLargestFile || problem) {
        return unreadable("the file is larger than 256 MB.");
    }
    std::ifstream in(path, std::ios::binary);
    std::ostringstream content;
    content << in.rdbuf();
    if (!in) return unreadable("it cannot be read; check its permissions.");
    return std::move(content).str();
}

Status write_file(const std::filesystem::path& path, std::string_view text) {
    const auto unwritable = [&] {
        return fail(Errc::kUnavailable, "file_unwritable",
                    path.string() +
                        ": it cannot be written; check that the folder exists, its permissions and "
                        "the free space.",
                    {}, {{"file", path.string()}});
    };
    std::filesystem::path beside = path;
    beside += ".new";
    {
        std::ofstream out(beside, std::ios::binary | std::ios::trunc);
        out.write(text.data(), static_cast<std::streamsize>(text.size()));
        out.close();
        if (!out) return unwritable();
    }
    std::error_code problem;
    std::filesystem::rename(beside, path, problem);
    if (problem) return unwritable();
    return {};
}

}  // namespace pulseline::api::plant_file
