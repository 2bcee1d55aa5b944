#include "api/plant/plant_codec.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "api/plant/occupancy_file.hpp"
#include "api/plant/plant_file.hpp"
#include "tests/api/plant/schema_check.hpp"

namespace pulseline::api::plant_file {

using namespace plant;

namespace {

using json::Json;

const std::string kPlants = PULSELINE_PLANTS;

Json document(const std::string& path) {
    return json::parse_json(read_file(path).value(), json::kPlantImport).value();
}

std::vector<std::string> faults_of(const Json& document) {
    json::FieldErrors errors;
    decode_plant(document, errors);
    std::vector<std::string> list;
    for (const Error& e : errors.all()) list.push_back(e.field + " " + e.reason.code);
    return list;
}

/// Where `file` says something that `written` does not; empty: nowhere. Fields a file leaves out
/// are written with their defaults.
std::string first_loss(const Json& file, const Json& written, const std::string& at = "") {
    if (file.is_object() && written.is_object()) {
        for (const auto& [key, value] : file.items()) {
            if (!written.contains(key)) return at + "/" + key;
            if (auto loss = first_loss(value, written[key], at + "/" + key); !loss.empty())
                return loss;
        }
        return {};
    }
    if (file.is_array() && written.is_array() && file.size() == written.size()) {
        for (std::size_t i = 0; i < file.size(); ++i) {
            if (auto loss = first_loss(file[i], written[i], at + "/" + std::to_string(i));
                !loss.empty())
                return loss;
        }
        return {};
    }
    return file == written ? std::string() : at + ": " + file.dump() + " or " + written.dump();
}

TEST(PlantNames, InOtherLanguagesAreReadAndWritten) {
    Json file = document(kPlants + "/pulse-line.json");
    file["stations"][0]["names"] = {{"zh", "机翼"}, {"pt-BR", "Asas"}};
    json::FieldErrors errors;
    const Plant plant = decode_plant(file, errors);
    ASSERT_TRUE(errors.empty());
    EXPECT_EQ(plant.stations[0].names, (Names{{"zh", "机翼"}, {"pt-BR", "Asas"}}));
    EXPECT_EQ(encode_plant(plant, PlantForm::kFile)["stations"][0]["names"],
              file["stations"][0]["names"]);
    EXPECT_FALSE(encode_plant(plant, PlantForm::kFile)["markers"][0].contains("names"));
}

TEST(PlantNames, OfNoLanguageAreRefusedWithTheirPlace) {
    for (const char* language : {"", "z", "Zh", "chinese", "zh-", "zh_CN", "z1"}) {
        Json file = document(kPlants + "/pulse-line.json");
        file["halls"][0]["names"] = {{language, "X"}};
        const auto faults = faults_of(file);
        ASSERT_EQ(faults.size(), 1u) << language;
        EXPECT_NE(faults[0].find("not_a_language"), std::string::npos) << faults[0];
    }
    Json file = document(kPlants + "/pulse-line.json");
    file["names"] = "Pulse line";
    file["areas"][0]["names"] = {{"zh", 7}};
    EXPECT_EQ(faults_of(file),
              (std::vector<std::string>{"/names wrong_type", "/areas/0/names/zh wrong_type"}));
}

class PlantText : public testing::TestWithParam<const char*> {
protected:
    Json file_ = document(kPlants + "/" + GetParam() + ".json");
};

TEST_P(PlantText, ReadsTheSameFromWhatWasWritten) {
    json::FieldErrors errors;
    const Plant plant = decode_plant(file_, errors);
    ASSERT_TRUE(errors.empty());
    const std::string text = plant_to_json(plant);
    const Plant again = decode_plant(json::parse_json(text, json::kPlantImport).value(), errors);

    EXPECT_TRUE(errors.empty());
    EXPECT_EQ(plant_to_json(again), text);
    EXPECT_EQ(again.stations.size(), plant.stations.size());
    for (std::size_t i = 0; i < plant.markers.size(); ++i) {
        EXPECT_EQ(again.markers[i].pose, plant.markers[i].pose);
    }
}

TEST_P(PlantText, WritesEveryValueOfTheFile) {
    json::FieldErrors errors;
    file_.erase("$schema");

    const Json written = encode_plant(decode_plant(file_, errors), PlantForm::kFile);

    EXPECT_EQ(first_loss(file_, written), "");
}

TEST_P(PlantText, FollowsTheSchema) {
    const Json schema = document(kPlants + "/../../api/plant.schema.json");

    EXPECT_EQ(json::SchemaCheck(schema).objection(file_), "");
}

INSTANTIATE_TEST_SUITE_P(Shipped, PlantText,
                         testing::Values("pulse-line", "measuring-hall", "landmark-lab",
                                         "igps-cell", "final-assembly"),
                         [](const auto& shipped) {
                             std::string name = shipped.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(PlantText, KeepsTheTiltOfACameraAndRefusesOneNobodyMounts) {
    Json file = document(kPlants + "/pulse-line.json");
    Json& camera = file["vehicle_types"][0]["cameras"][0];
    camera["tilt_u_rad"] = 0.003;
    camera["tilt_v_rad"] = -0.001;
    camera["frame_rate_hz"] = 90;
    camera["exposure_s"] = 1e-4;
    json::FieldErrors errors;
    const Json written = encode_plant(decode_plant(file, errors), PlantForm::kFile);
    EXPECT_EQ(written["vehicle_types"][0]["cameras"][0]["tilt_u_rad"], 0.003);
    EXPECT_EQ(written["vehicle_types"][0]["cameras"][0]["tilt_v_rad"], -0.001);
    EXPECT_EQ(written["vehicle_types"][0]["cameras"][1]["tilt_u_rad"], 0);
    EXPECT_EQ(written["vehicle_types"][0]["cameras"][0]["frame_rate_hz"], 90);
    EXPECT_EQ(written["vehicle_types"][0]["cameras"][0]["exposure_s"], 1e-4);
    EXPECT_EQ(written["vehicle_types"][0]["cameras"][1]["frame_rate_hz"], 60);
    EXPECT_EQ(written["vehicle_types"][0]["cameras"][1]["exposure_s"], 2e-4);

    camera["tilt_u_rad"] = 0.6;
    EXPECT_EQ(faults_of(file),
              std::vector<std::string>{"/vehicle_types/0/cameras/0/tilt_u_rad out_of_range"});
}

TEST(PlantText, KeepsTheMountingOfACameraUnderLoad) {
    Json file = document(kPlants + "/pulse-line.json");
    Json& camera = file["vehicle_types"][0]["cameras"][0];
    camera["loaded"] = {
        {"body_from_camera", {{"x_m", 5.34}, {"y_m", 0.001}, {"heading_rad", 0.01}}},
        {"height_m", 0.452},
        {"tilt_u_rad", 0.002}};
    json::FieldErrors errors;
    const Json written = encode_plant(decode_plant(file, errors), PlantForm::kFile);
    Json expected = camera["loaded"];
    expected["tilt_v_rad"] = 0;
    EXPECT_EQ(written["vehicle_types"][0]["cameras"][0]["loaded"], expected);
    EXPECT_FALSE(written["vehicle_types"][0]["cameras"][1].contains("loaded"));

    camera["loaded"]["weight"] = 3;
    EXPECT_EQ(faults_of(file).size(), 1U);
}

/// With every field that a file may leave out, each with a value of its own.
Json full_transmitter() {
    return {{"id", "tx"},
            {"hall", "cell"},
            {"position", {{"x_m", 1.5}, {"y_m", 2.5}}},
            {"z_m", 2.75},
            {"roll_rad", 0.01},
            {"pitch_rad", -0.02},
            {"heading_rad", 1.25},
            {"rate_hz", 42.5},
            {"first", {{"a", 1.7}, {"b", 0.1}, {"offset_m", 0.001}}},
            {"second", {{"a", -0.2}, {"b", 1.8}, {"offset_m", -0.002}}},
            {"range_m", 35},
            {"elevation_rad", 0.5},
            {"sigma_rad", 1.1e-5},
            {"sigma_place_m", 2.2e-5},
            {"sigma_turn_rad", 3.3e-6}};
}

TEST(PlantText, KeepsEveryFieldOfATransmitterAndAReceiver) {
    Json file = document(kPlants + "/igps-cell.json");
    file["transmitters"][1] = full_transmitter();
    const Json receiver = {
        {"name", "mast"}, {"position", {{"x_m", 0.1}, {"y_m", -0.2}}}, {"z_m", 1.5}};
    file["vehicle_types"][0]["receivers"][2] = receiver;
    json::FieldErrors errors;
    const Plant plant = decode_plant(file, errors);
    ASSERT_TRUE(errors.empty());

    for (const PlantForm form : {PlantForm::kFile, PlantForm::kApi}) {
        const Json written = encode_plant(plant, form);
        EXPECT_EQ(written["transmitters"].size(), 6u);
        EXPECT_EQ(written["transmitters"][1], full_transmitter());
        EXPECT_EQ(written["vehicle_types"][0]["receivers"].size(), 4u);
        EXPECT_EQ(written["vehicle_types"][0]["receivers"][2], receiver);
    }
}

TEST(PlantText, ATransmitterHasSheetsThatLeanBy30DegreesUnlessItSaysOthers) {
    const Plant plant = load_plant_file(kPlants + "/igps-cell.json").value();
    const Transmitter& t = plant.transmitters[0];

    EXPECT_EQ(t.first, Transmitter().first);
    EXPECT_EQ(t.second, Transmitter().second);
    EXPECT_EQ(t.range_m, 40);
    EXPECT_EQ(encode_plant(plant, PlantForm::kFile)["transmitters"][0]["second"],
              Json({{"a", 0}, {"b", std::sqrt(3)}, {"offset_m", 0}}));
}

const Json kReflector = {
    {"id", "r"}, {"hall", "hall"}, {"position", {{"x_m", 1.5}, {"y_m", 2.5}}}, {"sigma_m", 0.0013}};
const Json kScanner = {{"pose", {{"x_m", -0.7}, {"y_m", 0.1}, {"heading_rad", 0.2}}},
                       {"z_m", 1.9},
                       {"rate_hz", 9},
                       {"step_rad", 0.005},
                       {"range_m", 55},
                       {"reflector_radius_m", 0.03},
                       {"sigma_range_m", 0.007},
                       {"sigma_bearing_rad", 1.5e-4}};

const Json kLaserScanner = {
    {"name", "nose"},   {"pose", {{"x_m", 0.8}, {"y_m", -0.1}, {"heading_rad", 0.3}}},
    {"field_rad", 3.3}, {"step_rad", 0.006},
    {"range_m", 25},    {"least_range_m", 0.1},
    {"sigma_m", 0.02},  {"most_error_m", 0.05}};

TEST(PlantText, KeepsEveryFieldOfALaserScanner) {
    Json file = document(kPlants + "/measuring-hall.json");
    file["vehicle_types"][0]["scanners"] = Json::array({kLaserScanner});
    json::FieldErrors errors;
    const Plant plant = decode_plant(file, errors);
    ASSERT_TRUE(errors.empty());
    for (const PlantForm form : {PlantForm::kFile, PlantForm::kApi}) {
        EXPECT_EQ(encode_plant(plant, form)["vehicle_types"][0]["scanners"],
                  Json::array({kLaserScanner}));
    }
}

TEST(PlantText, WithoutAWordOfScannersAVehicleHasTheUsualOnes) {
    Json file = document(kPlants + "/measuring-hall.json");
    json::FieldErrors errors;
    file["vehicle_types"][0].erase("scanners");
    const auto usual = decode_plant(file, errors).vehicle_types[0].scanners;
    ASSERT_EQ(usual.size(), 2u);
    EXPECT_EQ(usual[1].body_from_scanner, (geometry::Pose2{-1.2, -0.7, -3 * kPi / 4}));
    file["vehicle_types"][0]["scanners"] = Json::array();
    EXPECT_TRUE(decode_plant(file, errors).vehicle_types[0].scanners.empty());
    EXPECT_TRUE(errors.empty());
}

TEST(PlantText, KeepsEveryFieldOfAReflectorAndAScanner) {
    Json file = document(kPlants + "/measuring-hall.json");
    file["reflectors"][1] = kReflector;
    file["vehicle_types"][0]["navigation_scanner"] = kScanner;
    json::FieldErrors errors;
    const Plant plant = decode_plant(file, errors);
    ASSERT_TRUE(errors.empty());
    for (const PlantForm form : {PlantForm::kFile, PlantForm::kApi}) {
        const Json written = encode_plant(plant, form);
        EXPECT_EQ(written["reflectors"].size(), 12u);
        EXPECT_EQ(written["reflectors"][1], kReflector);
        EXPECT_EQ(written["vehicle_types"][0]["navigation_scanner"], kScanner);
    }
}

TEST(PlantText, WithoutReflectorsSaysNothingOfThem) {
    const Plant plant = load_plant_file(kPlants + "/pulse-line.json").value();
    const Json written = encode_plant(plant, PlantForm::kApi);
    EXPECT_FALSE(written.contains("reflectors"));
    EXPECT_FALSE(written["vehicle_types"][0].contains("navigation_scanner"));
}

TEST(PlantText, WithoutIgpsSaysNothingOfIt) {
    const Plant plant = load_plant_file(kPlants + "/pulse-line.json").value();

    for (const PlantForm form : {PlantForm::kFile, PlantForm::kApi}) {
        const Json written = encode_plant(plant, form);
        EXPECT_FALSE(written.contains("transmitters"));
        EXPECT_FALSE(written["vehicle_types"][0].contains("receivers"));
    }
}

TEST(PlantText, NamesWhatIsWrongWithATransmitterOrAReceiver) {
    const std::tuple<const char*, Json, const char*> changes[] = {
        {"/transmitters", Json::object(), "/transmitters wrong_type"},
        {"/transmitters/0/id", "", "/transmitters/0/id wrong_length"},
        {"/transmitters/0/colour", "red", "/transmitters/0/colour unknown_field"},
        {"/transmitters/0/z_m", "2", "/transmitters/0/z_m wrong_type"},
        {"/transmitters/0/heading_rad", 7, "/transmitters/0/heading_rad out_of_range"},
        {"/transmitters/0/roll_rad", -7, "/transmitters/0/roll_rad out_of_range"},
        {"/transmitters/0/position", 1, "/transmitters/0/position wrong_type"},
        {"/transmitters/0/first", Json::object({{"a", 1}}),
         "/transmitters/0/first/b missing_field"},
        {"/transmitters/0/second", Json::object({{"a", 1}, {"b", 1}, {"c", 1}}),
         "/transmitters/0/second/c unknown_field"},
        {"/vehicle_types/0/receivers", Json::object(), "/vehicle_types/0/receivers wrong_type"},
        {"/vehicle_types/0/receivers/0/name", "", "/vehicle_types/0/receivers/0/name wrong_length"},
        {"/vehicle_types/0/receivers/0/x_m", 1, "/vehicle_types/0/receivers/0/x_m unknown_field"}};
    const Json schema = document(kPlants + "/../../api/plant.schema.json");
    const json::SchemaCheck check(schema);
    for (const auto& [pointer, value, expected] : changes) {
        Json file = document(kPlants + "/igps-cell.json");
        file[Json::json_pointer(pointer)] = value;
        EXPECT_EQ(faults_of(file), std::vector<std::string>{expected});
        EXPECT_NE(check.objection(file), "") << pointer;
    }
}

TEST(PlantSchema, RefusesWhatTheCodecRefuses) {
    const Json schema = document(kPlants + "/../../api/plant.schema.json");
    const json::SchemaCheck check(schema);
    const Json sound = document(kPlants + "/pulse-line.json");
    const std::pair<const char*, Json> changes[] = {{"/stations/2/pose/x_m", "10"},
                                                    {"/stations/2/pose/z_m", 1},
                                                    {"/stations/2/number", 1.5},
                                                    {"/markers/0/kind", "barcode"},
                                                    {"/vehicle_types/0/motion_modes/0", "sideways"},
                                                    {"/roadmap/nodes", Json::object()},
                                                    {"/colour", "red"},
                                                    {"/halls/0/occupancy_yaml", ""},
                                                    {"/stations/1/resting_place", 1},
                                                    {"/areas/0/outline/0", Json::array({1, 2})}};
    for (const auto& [pointer, value] : changes) {
        Json broken = sound;
        broken[Json::json_pointer(pointer)] = value;
        EXPECT_NE(check.objection(broken), "") << pointer;
        EXPECT_FALSE(faults_of(broken).empty()) << pointer;
    }
}

TEST(PlantSchema, EveryRequiredFieldIsRequiredByTheCodecToo) {
    Json sound = document(kPlants + "/igps-cell.json");
    sound["transmitters"][0] = full_transmitter();
    sound["reflectors"] = Json::array({kReflector});
    sound["vehicle_types"][0]["navigation_scanner"] = kScanner;
    sound["vehicle_types"][0]["scanners"] = Json::array({kLaserScanner});
    const Json others = document(kPlants + "/pulse-line.json");
    sound["markers"] = others["markers"];
    for (const char* parts : {"cameras", "brackets", "load_rules", "bracket_lift", "parking",
                              "casters", "control", "drive_temperatures"})
        sound["vehicle_types"][0][parts] = others["vehicle_types"][0][parts];
    const Json schema = document(kPlants + "/../../api/plant.schema.json");
    const std::pair<const char*, const char*> places[] = {
        {"", ""},
        {"/$defs/hall", "/halls/0"},
        {"/$defs/station", "/stations/0"},
        {"/$defs/marker", "/markers/0"},
        {"/$defs/transmitter", "/transmitters/0"},
        {"/$defs/light_plane", "/transmitters/0/first"},
        {"/$defs/reflector", "/reflectors/0"},
        {"/$defs/scanner", "/vehicle_types/0/scanners/0"},
        {"/$defs/navigation_scanner", "/vehicle_types/0/navigation_scanner"},
        {"/$defs/area", "/areas/0"},
        {"/$defs/vehicle_type", "/vehicle_types/0"},
        {"/$defs/wheel", "/vehicle_types/0/wheels/0"},
        {"/$defs/camera", "/vehicle_types/0/cameras/0"},
        {"/$defs/receiver", "/vehicle_types/0/receivers/0"},
        {"/$defs/bracket", "/vehicle_types/0/brackets/0"},
        {"/$defs/load_rules", "/vehicle_types/0/load_rules"},
        {"/$defs/bracket_lift", "/vehicle_types/0/bracket_lift"},
        {"/$defs/caster", "/vehicle_types/0/casters/0"},
        {"/$defs/control", "/vehicle_types/0/control"},
        {"/$defs/drive_temperatures", "/vehicle_types/0/drive_temperatures"},
        {"/$defs/parking", "/vehicle_types/0/parking"},
        {"/$defs/parking_foot", "/vehicle_types/0/parking/feet/0"},
        {"/$defs/vehicle", "/vehicles/0"},
        {"/$defs/node", "/roadmap/nodes/0"},
        {"/$defs/edge", "/roadmap/edges/0"},
        {"/$defs/tolerance", "/stations/0/tolerance"},
        {"/$defs/pose", "/stations/0/pose"}};
    for (const auto& [definition, place] : places) {
        const Json& rules = schema.at(Json::json_pointer(definition));
        for (const auto& [name, rule] : rules.at("properties").items()) {
            Json broken = sound;
            broken.at(Json::json_pointer(place)).erase(name);
            const auto faults = faults_of(broken);
            const std::string expected = std::string(place) + "/" + name + " missing_field";
            const Json required = rules.value("required", Json::array());
            if (std::find(required.begin(), required.end(), name) != required.end()) {
                EXPECT_EQ(faults, (std::vector<std::string>{expected}));
            } else {
                EXPECT_TRUE(faults.empty()) << expected;
            }
        }
    }
}

TEST(PlantCodec, ApiFormShowsTheGridInsteadOfTheFile) {
    const Plant plant = load_plant_file(kPlants + "/pulse-line.json").value();
    const Json hall = encode_plant(plant, PlantForm::kApi)["halls"][0];

    EXPECT_EQ(hall["grid"]["width"], 1102);
    EXPECT_EQ(hall["grid"]["resolution_m"], 0.1);
    EXPECT_FALSE(hall.contains("occupancy_yaml"));
}

TEST(PlantCodec, HeadingsAreWrapped) {
    Json file = document(kPlants + "/pulse-line.json");
    file["stations"][0]["pose"]["heading_rad"] = 1.5 * kPi;
    json::FieldErrors errors;

    EXPECT_NEAR(decode_plant(file, errors).stations[0].pose.heading_rad, -kPi / 2, 1e-12);
}

}  // namespace
}  // namespace pulseline::api::plant_file
