#include "core/mapping/occupancy_map.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace pulseline::mapping {
namespace {

namespace fs = std::filesystem;

class MapFile : public ::testing::Test {
protected:
    MapFile() : folder(fs::path(::testing::TempDir()) / "pulseline-maps") {
        fs::remove_all(folder);
        fs::create_directories(folder);
        map.cell_m = 0.05;
        map.corner = {-1.5, 2.25};
        map.columns = 3;
        map.rows = 2;
        map.free = {0, 255, kNeverSeen, 255, 0, 200};
    }
    ~MapFile() override { fs::remove_all(folder); }

    /// What reading says after one line of the file was replaced.
    std::string problem_with(const std::string& key, const std::string& value) {
        const fs::path file = folder / "hall.yaml";
        EXPECT_TRUE(write_map(map, file));
        std::ifstream in(file);
        std::string text;
        for (std::string line; std::getline(in, line);) {
            const bool here = line.rfind(key + ":", 0) == 0;
            text += (here ? key + ": " + value : line) + "\n";
        }
        in.close();
        std::ofstream(file) << text;
        const auto read = read_map(file);
        return read ? "" : read.error().reason.code + ": " + read.error().what;
    }

    fs::path folder;
    OccupancyMap map;
};

TEST_F(MapFile, ReadsWhatItWrote) {
    ASSERT_TRUE(write_map(map, folder / "hall.yaml"));
    const auto read = read_map(folder / "hall.yaml");
    ASSERT_TRUE(read) << read.error().what;
    EXPECT_EQ(read->columns, 3);
    EXPECT_EQ(read->rows, 2);
    EXPECT_EQ(read->free, map.free);
    EXPECT_EQ(read->corner, map.corner);
    EXPECT_DOUBLE_EQ(read->cell_m, 0.05);
    EXPECT_TRUE(read->occupied(0, 0));
    EXPECT_FALSE(read->occupied(2, 0)) << "what was never seen is no thing";
    EXPECT_EQ(read->middle_of(1, 1), (geometry::Point2{-1.5 + 0.075, 2.25 + 0.075}));
}

TEST_F(MapFile, NamesWhatIsWrongWithIt) {
    EXPECT_NE(problem_with("resolution", "0").find("resolution"), std::string::npos);
    EXPECT_NE(problem_with("resolution", "-0.05").find("resolution"), std::string::npos);
    EXPECT_NE(problem_with("resolution", "nan").find("resolution"), std::string::npos);
    EXPECT_NE(problem_with("resolution", "five").find("resolution"), std::string::npos);
    EXPECT_NE(problem_with("origin", "[1, 2]").find("origin"), std::string::npos);
    EXPECT_NE(problem_with("origin", "[1e9, 2, 0]").find("origin"), std::string::npos);
    EXPECT_NE(problem_with("origin", "[0, 0, 0.5]").find("turned"), std::string::npos);
    EXPECT_NE(problem_with("negate", "1").find("negate"), std::string::npos);
    EXPECT_NE(problem_with("image", "../hall.png").find("image"), std::string::npos);
    EXPECT_NE(problem_with("image", "none.png").find("none.png"), std::string::npos);
    EXPECT_EQ(problem_with("free_thresh", "0.3"), "");
}

TEST_F(MapFile, RefusesWhatIsNoPicture) {
    ASSERT_TRUE(write_map(map, folder / "hall.yaml"));
    std::ofstream(folder / "hall.png") << "no picture";
    EXPECT_FALSE(read_map(folder / "hall.yaml"));
    EXPECT_FALSE(read_map(folder / "other.yaml"));
}

TEST_F(MapFile, SaysThatItCannotBeWritten) {
    EXPECT_FALSE(write_map(map, folder / "none" / "hall.yaml"));
}

}  // namespace
}  // namespace pulseline::mapping
