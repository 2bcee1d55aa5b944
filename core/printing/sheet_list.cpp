#include "core/printing/sheet_list.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>

namespace pulseline::printing {
namespace {

const char* const kHeader = "kind,payload,size_m,x_m,y_m,up_rad";

std::optional<plant::MarkerKind> kind_named(const std::string& name) {
    using plant::MarkerKind;
    for (const auto kind : {MarkerKind::kQr, MarkerKind::kAprilTag, MarkerKind::kLandmark})
        if (name == plant::to_string(kind)) return kind;
    return std::nullopt;
}

std::optional<plant::Marker> read_line(const std::string& line) {
    std::istringstream in(line);
    std::string kind;
    plant::Marker marker;
    std::getline(in, kind, ',');
    std::getline(in, marker.payload, ',');
    std::array<double, 4> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        char comma = ',';
        if (i > 0) in >> comma;
        if (!(in >> numbers[i]) || comma != ',') return std::nullopt;
    }
    const auto known = kind_named(kind);
    const bool ends = (in >> std::ws).eof();
    if (!known || !ends || marker.payload.empty() || !(numbers[0] > 0)) return std::nullopt;
    marker.kind = *known;
    marker.size_m = numbers[0];
    marker.pose = {numbers[1], numbers[2], numbers[3]};
    return marker;
}

tl::unexpected<Error> bad_list(int line, const char* what) {
    return fail(Errc::kInvalid, "bad_list",
                "Line " + std::to_string(line) + " of the list is not " + what + ".", {},
                {{"line", std::int64_t{line}}});
}

}  // namespace

std::string sheet_list(const std::vector<Sheet>& sheets) {
    std::string list = std::string(kHeader) + "\n";
    for (const Sheet& sheet : sheets) {
        const plant::Marker& m = sheet.marker;
        char numbers[160];
        std::snprintf(numbers, sizeof numbers, ",%.6f,%.6f,%.6f,%.8f\n", m.size_m, m.pose.x_m,
                      m.pose.y_m, m.pose.heading_rad);
        list += std::string(plant::to_string(m.kind)) + "," + m.payload + numbers;
    }
    return list;
}

Result<std::vector<plant::Marker>> read_sheet_list(const std::string& list) {
    std::vector<plant::Marker> markers;
    std::istringstream in(list);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        if (line.ends_with('\r')) line.pop_back();  // saved by a spreadsheet
        if (number == 1) {
            if (line != kHeader) return bad_list(1, kHeader);
        } else if (!line.empty()) {
            auto marker = read_line(line);
            if (!marker) return bad_list(number, "a marker's: kind,payload and four numbers");
            markers.push_back(std::move(*marker));
        }
    }
    return markers;
}

}  // namespace pulseline::printing
