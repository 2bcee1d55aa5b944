#include "server/cli/markers_commands.hpp"

#include <cctype>
#include <filesystem>
#include <iostream>
#include <memory>

#include "core/printing/sheet_list.hpp"
#include "db/plant/plant_store.hpp"
#include "server/cli/exit_code.hpp"
#include "server/cli/output_file.hpp"

namespace pulseline::server::cli {
namespace {

namespace fs = std::filesystem;

std::string file_name(const plant::Marker& marker, const std::string& format) {
    std::string name = std::string(plant::to_string(marker.kind)) + "-" + marker.payload;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
    return name + "." + format;
}

}  // namespace

int write_marker_sheets(const plant::Plant& plant, const SheetInput& input, std::ostream& out) {
    const auto sheets = printing::sheets_of(plant, input.stations);
    if (sheets.empty()) {
        out << "pulseline: no marker belongs to the stations named\n";
        return kFailed;
    }
    const auto format =
        input.format == "svg" ? printing::SheetFormat::kSvg : printing::SheetFormat::kPdf;
    std::error_code error;
    fs::create_directories(input.folder, error);
    for (const printing::Sheet& sheet : sheets) {
        const auto bytes = printing::print_sheets({sheet}, format);
        if (!bytes) {
            out << sheet.marker.payload << ": " << bytes.error().what << "\n";
            return kFailed;
        }
        const fs::path path = fs::path(input.folder) / file_name(sheet.marker, input.format);
        if (!write_file(path, *bytes)) {
            out << "pulseline: cannot write " << path.string() << "\n";
            return kFailed;
        }
        out << path.string() << "\n";
    }
    const fs::path list = fs::path(input.folder) / "list.csv";
    if (!write_file(list, printing::sheet_list(sheets))) {
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
