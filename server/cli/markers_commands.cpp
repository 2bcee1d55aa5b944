#include "server/cli/markers_commands.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include "core/printing/marker_sheet.hpp"
#include "db/plant_store.hpp"
#include "server/cli/serve_command.hpp"

namespace pulseline::server::cli {
namespace {

namespace fs = std::filesystem;

struct Sheet {
    plant::Marker marker;
    std::string caption;
};

/// Markers of the stations named, or of the whole plant, with the station in words.
std::vector<Sheet> wanted(const plant::Plant& plant, const std::vector<int>& stations) {
    std::vector<Sheet> sheets;
    for (const plant::Marker& marker : plant.markers) {
        const auto station = std::ranges::find_if(plant.stations, [&](const plant::Station& s) {
            return std::ranges::count(s.markers, marker.id) != 0;
        });
        const bool belongs = station != plant.stations.end();
        if (!stations.empty() && (!belongs || std::ranges::count(stations, station->number) == 0))
            continue;
        sheets.push_back(
            {marker,
             belongs ? "station " + std::to_string(station->number) + ", " + station->name : ""});
    }
    return sheets;
}

std::string file_name(const plant::Marker& marker, const std::string& format) {
    std::string name = std::string(plant::to_string(marker.kind)) + "-" + marker.payload;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
    return name + "." + format;
}

bool write(const fs::path& path, const std::string& bytes) {
    std::ofstream out(path, std::ios::binary);
    out << bytes;
    return static_cast<bool>(out.flush());
}

}  // namespace

int write_marker_sheets(const plant::Plant& plant, const SheetInput& input, std::ostream& out) {
    const auto sheets = wanted(plant, input.stations);
    if (sheets.empty()) {
        out << "pulseline: no marker belongs to the stations named\n";
        return kFailed;
    }
    const auto format =
        input.format == "svg" ? printing::SheetFormat::kSvg : printing::SheetFormat::kPdf;
    std::error_code error;
    fs::create_directories(input.folder, error);
    std::vector<plant::Marker> markers;
    for (const Sheet& sheet : sheets) {
        const auto bytes = printing::marker_sheet(sheet.marker, sheet.caption, format);
        if (!bytes) {
            out << sheet.marker.payload << ": " << bytes.error().what << "\n";
            return kFailed;
        }
        const fs::path path = fs::path(input.folder) / file_name(sheet.marker, input.format);
        if (!write(path, *bytes)) {
            out << "pulseline: cannot write " << path.string() << "\n";
            return kFailed;
        }
        out << path.string() << "\n";
        markers.push_back(sheet.marker);
    }
    const fs::path list = fs::path(input.folder) / "list.csv";
    if (!write(list, printing::sheet_list(markers))) {
        out << "pulseline: cannot write " << list.string() << "\n";
        return kFailed;
    }
    out << list.string() << "\n";
    return 0;
}

void add_markers_commands(CLI::App& app, int& exit_code) {
    const auto input = std::make_shared<SheetInput>();
    auto* markers = app.add_subcommand("markers", "Print floor markers");
    markers->require_subcommand(1);
    auto* sheet = markers->add_subcommand("sheet", "True-scale sheets, one file a marker");
    sheet->add_option("--db", input->database, "Database file")->required();
    sheet->add_option("--station", input->stations, "Station numbers; without it all markers");
    sheet->add_option("--format", input->format, "pdf or svg")
        ->check(CLI::IsMember({"pdf", "svg"}));
    sheet->add_option("--out", input->folder, "Folder for the files, made when missing")
        ->required();
    sheet->callback([input, &exit_code] {
        db::ReadOnly reader(input->database);
        const auto plant = db::load_plant(reader);
        if (!plant) {
            std::cout << "pulseline: " << input->database << " holds no plant; import one first.\n";
            exit_code = kFailed;
            return;
        }
        exit_code = write_marker_sheets(*plant, *input, std::cout);
    });
}

}  // namespace pulseline::server::cli
