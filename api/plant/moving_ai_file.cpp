#include "api/plant/moving_ai_file.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace pulseline::api::plant_file {

using namespace plant;

namespace {

// Larger maps would not fit the 16-bit coordinates of the searches, nor memory.
constexpr int kMostCells = 16'384;
constexpr std::size_t kColumns = 8;  // of a problem, up to the goal's row

class Lines {
public:
    explicit Lines(std::string_view text) : rest_(text) {}

    std::optional<std::string_view> next() {
        if (rest_.empty()) return std::nullopt;
        const std::size_t end = rest_.find('\n');
        std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        ++number_;
        return line;
    }
    std::int64_t number() const { return number_; }

private:
    std::string_view rest_;
    std::int64_t number_ = 0;
};

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    while (true) {
        const std::size_t begin = line.find_first_not_of(" \t");
        if (begin == std::string_view::npos) return words;
        line.remove_prefix(begin);
        const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
        words.push_back(line.substr(0, end));
        line.remove_prefix(end);
    }
}

std::optional<int> number_in(std::string_view word) {
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
}

tl::unexpected<Error> invalid(const char* code, const char* what, std::int64_t line) {
    return fail(Errc::kInvalid, code, std::string(what) + " (line " + std::to_string(line) + ").",
                {}, {{"line", line}});
}

}  // namespace

Result<OccupancyGrid> parse_moving_ai_map(std::string_view text) {
    Lines lines(text);
    OccupancyGrid grid;
    grid.resolution_m = 1;
    while (const auto line = lines.next()) {
        const auto words = words_of(*line);
        if (words.size() == 1 && words[0] == "map") break;
        if (words.size() != 2) continue;
        const auto value = number_in(words[1]);
        const bool is_size = words[0] == "width" || words[0] == "height";
        if (is_size && (!value || *value < 1 || *value > kMostCells)) {
            return invalid("map_invalid", "The map's size must be from 1 to 16384", lines.number());
        }
        if (words[0] == "width") grid.width = *value;
        if (words[0] == "height") grid.height = *value;
    }
    if (grid.width == 0 || grid.height == 0) {
        return invalid("map_invalid", "The map has no width and height", lines.number());
    }
    grid.occupied.reserve(static_cast<std::size_t>(grid.width) *
                          static_cast<std::size_t>(grid.height));
    for (int row = 0; row < grid.height; ++row) {
        const auto line = lines.next();
        if (!line || line->size() < static_cast<std::size_t>(grid.width)) {
            return invalid("map_invalid", "The map has too few cells", lines.number());
        }
        for (const char c : line->substr(0, static_cast<std::size_t>(grid.width))) {
            grid.occupied.push_back(c == '.' || c == 'G' || c == 'S' ? 0 : 1);
        }
    }
    return grid;
}

Result<std::vector<MovingAiProblem>> parse_moving_ai_scenario(std::string_view text) {
    Lines lines(text);
    std::vector<MovingAiProblem> problems;
    while (const auto line = lines.next()) {
        const auto words = words_of(*line);
        if (words.empty() || words[0] == "version") continue;
        // bucket, map, width, height, start x and y, goal x and y, optimal length. Map names may
        // hold spaces, so the numbers are counted from the end.
        std::optional<int> at[4];
        if (words.size() > kColumns) {
            for (std::size_t i = 0; i < 4; ++i) at[i] = number_in(words[words.size() - 5 + i]);
        }
        if (!at[0] || !at[1] || !at[2] || !at[3]) {
            return invalid("scenario_invalid", "The problem has no start and goal", lines.number());
        }
        double length = 0;
        const std::string_view last = words.back();
        std::from_chars(last.data(), last.data() + last.size(), length);
        problems.push_back({{*at[0], *at[1]}, {*at[2], *at[3]}, length});
    }
    return problems;
}

}  // namespace pulseline::api::plant_file
