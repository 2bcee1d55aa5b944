#include "server/cli/plant_commands.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "api/plant/occupancy_file.hpp"
#include "api/plant/plant_codec.hpp"
#include "api/plant/plant_file.hpp"
#include "db/database.hpp"
#include "tests/db/temp_folder.hpp"

namespace pulseline::server::cli {
namespace {

const std::string kPulseLine = std::string(PULSELINE_PLANTS) + "/pulse-line.json";

class PlantCommands : public testing::Test {
protected:
    db::TempFolder folder_;
    std::ostringstream out_;

    std::string database() const { return folder_.file("fleet.db"); }
    /// A plant file with two faults.
    std::string broken() {
        plant::Plant plant = api::plant_file::load_plant_file(kPulseLine).value();
        plant.stations[1].number = plant.stations[0].number;
        plant.vehicle_types[0].max_speed_mps = 0;
        plant.halls[0].occupancy_yaml.clear();
        const std::string path = folder_.file("broken.json");
        EXPECT_TRUE(api::plant_file::save_plant_file(plant, path));
        return path;
    }
};

TEST_F(PlantCommands, ValidatePrintsEveryFaultOnItsLine) {
    EXPECT_EQ(plant_validate(broken(), false, out_), kPlantFaults);
    EXPECT_NE(out_.str().find("/vehicle_types/0/max_speed_mps: "), std::string::npos);
    EXPECT_NE(out_.str().find("/stations/1/number: "), std::string::npos);
}

TEST_F(PlantCommands, ValidateWritesJsonLines) {
    EXPECT_EQ(plant_validate(broken(), true, out_), kPlantFaults);
    std::istringstream lines(out_.str());
    std::vector<std::string> codes;
    for (std::string line; std::getline(lines, line);) {
        const auto json = nlohmann::json::parse(line);
        EXPECT_FALSE(json.at("element").get<std::string>().empty());
        EXPECT_FALSE(json.at("remedy").get<std::string>().empty());
        codes.push_back(json.at("code"));
    }

    EXPECT_EQ(codes, (std::vector<std::string>{"not_positive", "duplicate_number"}));
}

TEST_F(PlantCommands, WarnsOfStationsWhereRestingVehiclesAreInTheWay) {
    plant::Plant plant = api::plant_file::load_plant_file(kPulseLine).value();
    plant::Vehicle second = plant.vehicles[0];
    second.id = plant::VehicleId("TP-02");
    second.serial_number = "TP-02";
    second.home = plant.stations[3].id;
    plant.vehicles.push_back(second);
    const std::string file = folder_.file("two.json");
    ASSERT_TRUE(api::plant_file::save_plant_file(plant, file));

    EXPECT_EQ(plant_validate(file, false, out_), kPlantSound) << out_.str();
    EXPECT_NE(out_.str().find("warning: /stations/"), std::string::npos) << out_.str();
    EXPECT_NE(out_.str().find("rests at st0"), std::string::npos) << out_.str();
    EXPECT_NE(out_.str().find("no fault"), std::string::npos) << out_.str();
    out_.str("");
    EXPECT_EQ(plant_import(database(), file, true, out_), kPlantSound) << out_.str();
    const auto first = nlohmann::json::parse(out_.str().substr(0, out_.str().find('\n')));
    EXPECT_EQ(first.at("severity"), "warning");
    EXPECT_EQ(first.at("code"), "unreachable");
}

TEST_F(PlantCommands, WarnsOfATypeThatReadsNoCodeAtItsOwnSpeed) {
    plant::Plant plant = api::plant_file::load_plant_file(kPulseLine).value();
    plant.vehicle_types[0].max_speed_mps = 3;
    for (auto& camera : plant.vehicle_types[0].cameras) camera.frame_rate_hz = 30;
    const std::string file = folder_.file("fast.json");
    ASSERT_TRUE(api::plant_file::save_plant_file(plant, file));

    EXPECT_EQ(plant_validate(file, false, out_), kPlantSound) << out_.str();
    EXPECT_NE(out_.str().find("warning: /vehicle_types/0: "), std::string::npos) << out_.str();
    EXPECT_NE(out_.str().find("drive 3.00 m/s and surely read a code up to 2.09 m/s only"),
              std::string::npos)
        << out_.str();
}

TEST_F(PlantCommands, AVehicleAloneIsWarnedOfNothing) {
    EXPECT_EQ(plant_validate(kPulseLine, false, out_), kPlantSound);
    EXPECT_EQ(out_.str().find("warning"), std::string::npos) << out_.str();
}

TEST_F(PlantCommands, UnreadableFilesExitWithTwo) {
    std::ofstream(folder_.file("text.json")) << "{";

    EXPECT_EQ(plant_validate(folder_.file("none.json"), false, out_), kPlantUnreadable);
    EXPECT_EQ(plant_validate(folder_.file("text.json"), false, out_), kPlantUnreadable);
    EXPECT_EQ(plant_export(folder_.file("none.db"), folder_.file("x.json"), out_),
              kPlantUnreadable);
    EXPECT_NE(out_.str().find("none.db"), std::string::npos);
}

TEST_F(PlantCommands, ImportedPlantIsExportedByteForByteTheSame) {
    ASSERT_EQ(plant_validate(kPulseLine, false, out_), kPlantSound) << out_.str();
    ASSERT_EQ(plant_import(database(), kPulseLine, false, out_), kPlantSound) << out_.str();
    ASSERT_EQ(plant_export(database(), folder_.file("copy.json"), out_), kPlantSound) << out_.str();

    EXPECT_EQ(api::plant_file::read_file(folder_.file("copy.json")).value(),
              api::plant_file::plant_to_json(api::plant_file::load_plant_file(kPulseLine).value()));
    EXPECT_TRUE(
        api::plant_file::read_file(folder_.file("pulse-line.pgm")).value() ==
        api::plant_file::read_file(std::string(PULSELINE_PLANTS) + "/pulse-line.pgm").value());
    EXPECT_EQ(plant_validate(folder_.file("copy.json"), false, out_), kPlantSound) << out_.str();
}

TEST_F(PlantCommands, SecondImportRaisesTheRevision) {
    plant_import(database(), kPulseLine, true, out_);
    out_.str("");
    EXPECT_EQ(plant_import(database(), kPulseLine, true, out_), kPlantSound);

    EXPECT_EQ(nlohmann::json::parse(out_.str()).at("revision"), 2);
}

TEST_F(PlantCommands, FaultyPlantIsNotImported) {
    EXPECT_EQ(plant_import(database(), broken(), false, out_), kPlantFaults);
    EXPECT_FALSE(std::filesystem::exists(database()));
}

TEST_F(PlantCommands, BesideAServerImportIsRefusedAndExportWorks) {
    plant_import(database(), kPulseLine, false, out_);
    db::Database server(database());

    EXPECT_EQ(plant_import(database(), kPulseLine, false, out_), kPlantUnreadable);
    EXPECT_NE(out_.str().find("another process is using this database"), std::string::npos);
    EXPECT_EQ(plant_export(database(), folder_.file("copy.json"), out_), kPlantSound);
}

}  // namespace
}  // namespace pulseline::server::cli
