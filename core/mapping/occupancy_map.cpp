#include "core/mapping/occupancy_map.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <system_error>

namespace pulseline::mapping {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastCell_m = 0.01;
constexpr double kMostCell_m = 1;
constexpr double kFarthest_m = 1e5;
constexpr std::uintmax_t kMostBytes = 64'000'000;

tl::unexpected<Error> bad(const fs::path& file, const std::string& problem) {
    return fail(Errc::kInvalid, "map_file",
                fmt::format("The map {} cannot be used: {}. `pulseline-agent map` makes one.",
                            file.string(), problem),
                {}, {{"file", file.string()}, {"problem", problem}});
}

/// Of "key: value" lines; what else YAML knows is not in such files.
std::map<std::string, std::string> lines_of(std::istream& in) {
    std::map<std::string, std::string> values;
    for (std::string line; std::getline(in, line) && values.size() < 50;) {
        const auto colon = line.find(": ");
        if (colon == std::string::npos) continue;
        values[line.substr(0, colon)] = line.substr(colon + 2);
    }
    return values;
}

/// Numbers in front of commas and brackets; nothing when something else stands there.
std::optional<std::vector<double>> numbers_in(const std::string& text) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* end = at + text.size();
    while (at != end) {
        if (*at == '[' || *at == ']' || *at == ',' || *at == ' ' || *at == '\r') {
            ++at;
            continue;
        }
        double value = 0;
        const auto [rest, error] = std::from_chars(at, end, value);
        if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
        numbers.push_back(value);
        at = rest;
    }
    return numbers;
}

Status read_frame(std::istream& in, const fs::path& yaml, OccupancyMap& map, fs::path& picture) {
    auto values = lines_of(in);
    const auto cell = numbers_in(values["resolution"]);
    if (!cell || cell->size() != 1 || cell->front() < kLeastCell_m || cell->front() > kMostCell_m)
        return bad(yaml, fmt::format("`resolution` must be one number from {} to {} m",
                                     kLeastCell_m, kMostCell_m));
    map.cell_m = cell->front();
    const auto origin = numbers_in(values["origin"]);
    if (!origin || origin->size() != 3 || std::abs((*origin)[0]) > kFarthest_m ||
        std::abs((*origin)[1]) > kFarthest_m)
        return bad(yaml, "`origin` must be [x, y, 0] in metres");
    if ((*origin)[2] != 0) return bad(yaml, "its `origin` is turned; turn the picture instead");
    if (values["negate"] == "1") return bad(yaml, "`negate` must be 0");
    map.corner = {(*origin)[0], (*origin)[1]};
    const fs::path name = values["image"];
    if (name.empty() || name.has_parent_path())
        return bad(yaml, "`image` must name a picture beside it");
    picture = yaml.parent_path() / name;
    return {};
}

}  // namespace

Status write_map(const OccupancyMap& map, const fs::path& yaml) {
    cv::Mat cells(map.rows, map.columns, CV_8UC1, const_cast<std::uint8_t*>(map.free.data()));
    cv::Mat picture;
    cv::flip(cells, picture, 0);  // pictures begin at the top
    fs::path file = yaml;
    file.replace_extension(".png");
    try {
        if (!cv::imwrite(file.string(), picture)) return bad(file, "it could not be written");
    } catch (const cv::Exception&) {
        return bad(file, "it could not be written");
    }
    std::ofstream out(yaml);
    out << fmt::format(
        "image: {}\nresolution: {}\norigin: [{}, {}, 0]\nnegate: 0\n"
        "occupied_thresh: 0.75\nfree_thresh: 0.25\n",
        file.filename().string(), map.cell_m, map.corner.x_m, map.corner.y_m);
    out.close();
    if (!out) return bad(yaml, "it could not be written");
    return {};
}

Result<OccupancyMap> read_map(const fs::path& yaml) {
    std::ifstream in(yaml);
    if (!in) return bad(yaml, "there is none, or it may not be read");
    OccupancyMap map;
    fs::path file;
    if (auto status = read_frame(in, yaml, map, file); !status) return fail(status.error());
    std::error_code trouble;
    const auto bytes = fs::file_size(file, trouble);
    if (trouble || bytes > kMostBytes) return bad(file, "there is none, or it is too big");
    cv::Mat picture;
    try {
        picture = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
    } catch (const cv::Exception&) {  // of a size that no hall has
    }
    if (picture.empty()) return bad(file, "it is no picture");
    if (picture.total() > kMostCells)
        return bad(file, fmt::format("it has more than {} cells", kMostCells));
    cv::Mat cells;
    cv::flip(picture, cells, 0);
    map.columns = cells.cols;
    map.rows = cells.rows;
    map.free.assign(cells.begin<std::uint8_t>(), cells.end<std::uint8_t>());
    return map;
}

}  // namespace pulseline::mapping
