#include "server/cli/plant_commands.hpp"

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "api/plant/plant_file.hpp"
#include "core/plant/validate.hpp"
#include "db/plant/plant_store.hpp"
#include "server/cli/layout_warnings.hpp"

namespace pulseline::server::cli {
namespace {

using nlohmann::json;

void print_line(const json& line, std::ostream& out) {
    out << line.dump(-1, ' ', false, json::error_handler_t::replace) << "\n";
}

int unreadable(const std::string& what, bool as_json, std::ostream& out) {
    if (as_json) {
        print_line({{"error", what}}, out);
    } else {
        out << "pulseline: " << what << "\n";
    }
    return kPlantUnreadable;
}

void print_faults(const std::vector<plant::Fault>& faults, const std::string& severity,
                  bool as_json, std::ostream& out) {
    for (const plant::Fault& fault : faults) {
        if (as_json) {
            print_line({{"severity", severity},
                        {"element", fault.element},
                        {"code", fault.code},
                        {"what", fault.what},
                        {"remedy", fault.remedy}},
                       out);
        } else {
            out << (severity == "warning" ? "warning: " : "") << fault.element << ": " << fault.what
                << " " << fault.remedy << "\n";
        }
    }
}

/// The plant when it has no fault, with warnings about its layout; prints what is wrong otherwise.
int read_sound_plant(const std::string& file, bool as_json, std::ostream& out,
                     plant::Plant& plant) {
    auto read = api::plant_file::read_plant_file(file);
    if (!read) {
        for (const Error& error : read.error()) {
            if (as_json) {
                print_line(
                    {{"element", error.field}, {"code", error.reason.code}, {"what", error.what}},
                    out);
            } else {
                out << error.what << "\n";
            }
        }
        return kPlantUnreadable;
    }
    const auto faults = plant::validate(*read);
    print_faults(faults, "fault", as_json, out);
    if (faults.empty()) print_faults(layout_warnings(*read), "warning", as_json, out);
    plant = std::move(*read);
    return faults.empty() ? kPlantSound : kPlantFaults;
}

struct PlantInput {
    std::string database;
    std::string file;
    bool json = false;
};

}  // namespace

int plant_validate(const std::string& plant_file, bool json, std::ostream& out) {
    plant::Plant plant;
    const int outcome = read_sound_plant(plant_file, json, out, plant);
    if (outcome == kPlantSound && !json) {
        out << plant_file << ": no fault; " << plant.stations.size() << " stations, "
            << plant.vehicles.size() << " vehicles\n";
    }
    return outcome;
}

int plant_import(const std::string& database, const std::string& plant_file, bool json,
                 std::ostream& out) {
    plant::Plant plant;
    const int outcome = read_sound_plant(plant_file, json, out, plant);
    if (outcome != kPlantSound) return outcome;
    try {
        db::Database writer(database);
        const std::int64_t revision = db::PlantStore(writer).import(plant);
        if (json) {
            print_line({{"plant", plant.id}, {"revision", revision}}, out);
        } else {
            out << "plant " << plant.id << " imported, revision " << revision << "\n";
        }
        return kPlantSound;
    } catch (const db::Error& error) {
        return unreadable(error.what(), json, out);
    }
}

int plant_export(const std::string& database, const std::string& plant_file, std::ostream& out) {
    try {
        db::ReadOnly reader(database);
        const auto plant = db::load_plant(reader);
        if (!plant)
            return unreadable(database + ": it holds no plant; import one first.", false, out);
        const Status saved = api::plant_file::save_plant_file(*plant, plant_file);
        if (!saved) return unreadable(saved.error().what, false, out);
        out << "plant " << plant->id << " revision " << plant->revision << " written to "
            << plant_file << "\n";
        return kPlantSound;
    } catch (const db::Error& error) {
        return unreadable(error.what(), false, out);
    }
}

void add_plant_commands(CLI::App& app, int& exit_code) {
    const auto input = std::make_shared<PlantInput>();
    auto* plant = app.add_subcommand("plant", "Check, import and export plant files");
    plant->require_subcommand(1);

    auto* validate = plant->add_subcommand("validate", "Name every fault of a plant file");
    validate->add_option("FILE", input->file, "Plant file")->required();
    validate->add_flag("--json", input->json, "One JSON object a line");
    validate->callback(
        [input, &exit_code] { exit_code = plant_validate(input->file, input->json, std::cout); });

    auto* import =
        plant->add_subcommand("import", "Put a plant file in the place of the stored plant");
    import->add_option("--db", input->database, "Database file, made when missing")->required();
    import->add_option("FILE", input->file, "Plant file")->required();
    import->add_flag("--json", input->json, "One JSON object a line");
    import->callback([input, &exit_code] {
        exit_code = plant_import(input->database, input->file, input->json, std::cout);
});

auto* export_command = plant->add_subcommand("export", "Write the stored plant as a plant file");
export_command->add_option("--db", input->database, "Database file")->required();
export_command->add_option("FILE", input->file, "Plant file to write")->required();
export_command->callback([input, &exit_code] {
    exit_code = plant_export(input->database, input->file, std::cout);
});
}  // namespace pulseline::server::cli

}  // namespace pulseline::server::cli
