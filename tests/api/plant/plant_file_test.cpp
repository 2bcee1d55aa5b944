#include "api/plant/plant_file.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "api/plant/image_file.hpp"
#include "api/plant/occupancy_file.hpp"
#include "api/plant/plant_codec.hpp"

namespace pulseline::api::plant_file {

using namespace plant;

namespace {

namespace fs = std::filesystem;

const char* const kYaml =
    "# made by hand\nimage: \"map.pgm\"  # beside\nresolution: 0.5\norigin: [-1.0, 2, 0.0]\n"
    "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
std::string pgm() {
    std::string text = "P5\n# comment\n3 2\n255\n";
    for (const int value : {0, 254, 205, 254, 254, 0}) text += static_cast<char>(value);
    return text;
}

class PlantFiles : public testing::Test {
protected:
    fs::path folder_;

    void SetUp() override {
        std::string name = testing::TempDir() + "pulseline-plant-XXXXXX";
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }
    void put(const std::string& name, const std::string& text) {
        ASSERT_TRUE(write_file(folder_ / name, text));
    }
    std::string error_of_map(const std::string& yaml, const std::string& image) {
        put("map.yaml", yaml);
        put("map.pgm", image);
        const auto grid = load_occupancy(folder_ / "map.yaml");
        return grid ? "" : grid.error().what;
    }
};

TEST_F(PlantFiles, GridHasItsSouthRowFirstAndUnknownCellsOccupied) {
    put("map.yaml", kYaml);
    put("map.pgm", pgm());
    const OccupancyGrid grid = load_occupancy(folder_ / "map.yaml").value();

    EXPECT_EQ(grid.width, 3);
    EXPECT_EQ(grid.height, 2);
    EXPECT_EQ(grid.resolution_m, 0.5);
    EXPECT_EQ(grid.origin, (geometry::Point2{-1, 2}));
    EXPECT_EQ(grid.occupied, (std::vector<std::uint8_t>{0, 0, 1, 1, 0, 1}));
}

TEST_F(PlantFiles, TextPgmNegationAndPngReadTheSame) {
    put("map.yaml", kYaml);
    put("map.pgm", "P2\n3 2\n255\n0 254 205\n254 254 0\n");
    const auto text = load_occupancy(folder_ / "map.yaml").value();
    cv::Mat image(2, 3, CV_8UC1);
    const std::uint8_t pixels[] = {255, 1, 50, 1, 1, 255};
    std::copy(std::begin(pixels), std::end(pixels), image.data);
    std::vector<unsigned char> png;
    cv::imencode(".png", image, png);
    std::string negated = kYaml;
    negated.replace(negated.find("negate: 0"), 9, "negate: 1");
    put("map.yaml", negated);
    put("map.pgm", std::string(png.begin(), png.end()));

    EXPECT_EQ(text.occupied, (std::vector<std::uint8_t>{0, 0, 1, 1, 0, 1}));
    EXPECT_EQ(load_occupancy(folder_ / "map.yaml")->occupied, text.occupied);
    put("map.pgm", std::string(png.begin(), png.end() - 20));
    EXPECT_FALSE(load_occupancy(folder_ / "map.yaml"));
}

TEST_F(PlantFiles, EveryKeyOfTheYamlIsCheckedByName) {
    const std::pair<const char*, const char*> changes[] = {
        {"resolution: 0.5", "resolution: zero"},
        {"resolution: 0.5", "resolution: 0"},
        {"resolution: 0.5", "resolution: nan"},
        {"origin: [-1.0, 2, 0.0]", "origin: [1, 2]"},
        {"origin: [-1.0, 2, 0.0]", "origin: [1, 2, 0.7]"},
        {"negate: 0", "negate: maybe"},
        {"occupied_thresh: 0.65", "occupied_thresh: 65"},
        {"free_thresh: 0.196", "free_thresh: 0.7"},
        {"image: \"map.pgm\"", "image: ../../etc/passwd"},
        {"image: \"map.pgm\"", "image: /etc/passwd"}};
    for (const auto& [from, to] : changes) {
        std::string yaml = kYaml;
        yaml.replace(yaml.find(from), std::string(from).size(), to);
        const std::string what = error_of_map(yaml, pgm());
        const std::string key = std::string(from).substr(0, std::string(from).find(':'));
        EXPECT_NE(what.find("map.yaml"), std::string::npos) << to;
        EXPECT_NE(what.find("\"" + key + "\""), std::string::npos) << to << ": " << what;
    }
    for (const char* key :
         {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"}) {
        std::string yaml = kYaml;
        const std::size_t at = yaml.find(std::string(key) + ":");
        yaml.erase(at, yaml.find('\n', at) - at);
        EXPECT_NE(error_of_map(yaml, pgm()).find(std::string("\"") + key + "\""),
                  std::string::npos);
    }
    EXPECT_NE(error_of_map(std::string(kYaml) + "negate: 1\n", pgm()).find("twice"),
              std::string::npos);
    EXPECT_NE(error_of_map(std::string(kYaml) + "colour: 1\n", pgm()).find("\"colour\""),
              std::string::npos);
}

TEST_F(PlantFiles, DamagedImagesAreNamed) {
    for (const std::string& image :
         {std::string(), std::string("P5"), std::string("P5\n3 2\n"),
          pgm().substr(0, pgm().size() - 1), std::string("P5\n0 2\n255\n"),
          std::string("P5\n3 2\n65535\n............"), std::string("P5\n99999999 99999999\n255\n"),
          std::string("P2\n3 2\n255\n1 2 3"), std::string("GIF89a"),
          std::string("\x89PNG\r\n\x1a\n garbage")}) {
        EXPECT_NE(error_of_map(kYaml, image).find("map.pgm"), std::string::npos) << image;
    }
    fs::remove(folder_ / "map.pgm");
    EXPECT_NE(load_occupancy(folder_ / "map.yaml").error().what.find("map.pgm"), std::string::npos);
}

TEST_F(PlantFiles, SavedPlantLoadsTheSame) {
    const Plant plant =
        load_plant_file(std::string(PULSELINE_PLANTS) + "/final-assembly.json").value();
    ASSERT_TRUE(save_plant_file(plant, folder_ / "copy.json"));
    const Plant copy = load_plant_file(folder_ / "copy.json").value();

    EXPECT_EQ(plant_to_json(copy), plant_to_json(plant));
    EXPECT_TRUE(copy.halls[0].grid.occupied == plant.halls[0].grid.occupied);
    EXPECT_EQ(copy.halls[0].grid.origin, plant.halls[0].grid.origin);
}

TEST_F(PlantFiles, EveryFieldAtFaultIsNamedWithTheFile) {
    put("plant.json", R"({"id":3,"name":"x","halls":[{"id":"h"}],"colour":"red"})");
    const auto plant = read_plant_file(folder_ / "plant.json");
    ASSERT_FALSE(plant);
    std::string all;
    for (const Error& error : plant.error()) {
        EXPECT_EQ(error.what.rfind("plant.json", 0), 0u) << error.what;
        all += error.field + "\n";
    }

    for (const char* field : {"/id\n", "/halls/0/name\n", "/halls/0/outline\n", "/stations\n",
                              "/roadmap\n", "/colour\n"}) {
        EXPECT_NE(all.find(field), std::string::npos) << field << "in\n" << all;
    }
}

TEST_F(PlantFiles, MissingFilesAndBadTextAreErrors) {
    put("plant.json", "{\"id\": ");
    put("deep.json", std::string(300'000, '['));

    EXPECT_EQ(load_plant_file(folder_ / "none.json").error().reason.code, "file_unreadable");
    EXPECT_EQ(load_plant_file(folder_).error().reason.code, "file_unreadable");
    EXPECT_EQ(load_plant_file(folder_ / "plant.json").error().reason.code, "json_syntax");
    EXPECT_EQ(load_plant_file(folder_ / "deep.json").error().reason.code, "json_too_deep");
    EXPECT_EQ(write_file(folder_ / "gone" / "x", "").error().reason.code, "file_unwritable");
}

TEST_F(PlantFiles, GridFilesOutsideTheFolderAreRefused) {
    Plant plant = load_plant_file(std::string(PULSELINE_PLANTS) + "/landmark-lab.json").value();
    for (const char* path : {"../map.yaml", "/etc/passwd", "a/../../map.yaml"}) {
        plant.halls[0].occupancy_yaml = path;
        put("plant.json", plant_to_json(plant));
        const auto loaded = load_plant_file(folder_ / "plant.json");
        ASSERT_FALSE(loaded) << path;
        EXPECT_EQ(loaded.error().field, "/halls/0/occupancy_yaml");
    }
}

}  // namespace
}  // namespace pulseline::api::plant_file
