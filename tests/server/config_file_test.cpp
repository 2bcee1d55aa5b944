#include "server/config_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace pulseline::server {
namespace {

class ConfigFile : public ::testing::Test {
protected:
    ConfigFile()
        : path_((std::filesystem::temp_directory_path() /
                 ("pulseline-config-" + std::to_string(::getpid()) + ".toml"))
                    .string()) {}
    ~ConfigFile() override { std::filesystem::remove(path_); }
    Status read(const std::string& text, const std::set<std::string>& given = {}) {
        std::ofstream(path_) << text;
        return read_config_file(path_, given, options_);
    }
    std::string path_;
    Options options_;
};

TEST_F(ConfigFile, SetsWhatItNames) {
    ASSERT_TRUE(
        read("listen = '127.0.0.1:9000'\nallow_origins = ['https://a.example']\n"
             "[limits]\nconnections = 100\n"));

    EXPECT_EQ(options_.listen, "127.0.0.1:9000");
    EXPECT_EQ(options_.allow_origins, std::vector<std::string>{"https://a.example"});
    EXPECT_EQ(options_.limits.connections, 100U);
}

TEST_F(ConfigFile, RefusesAnUnknownKeyWithItsLine) {
    const auto read_keys = read("db = 'x'\nlisen = '127.0.0.1:9000'\n");

    ASSERT_FALSE(read_keys);
    EXPECT_EQ(read_keys.error().field, "lisen");
    EXPECT_NE(read_keys.error().what.find(":2: unknown key \"lisen\""), std::string::npos);
}

TEST_F(ConfigFile, RefusesAValueOfTheWrongKindAndTextThatIsNoToml) {
    EXPECT_FALSE(read("listen = 8080\n"));
    EXPECT_FALSE(read("[limits]\nconnections = 0\n"));
    EXPECT_FALSE(read("limits = 3\n"));
    EXPECT_FALSE(read("listen = \n"));
}

TEST_F(ConfigFile, GivesWayToTheCommandLine) {
    options_.listen = "127.0.0.1:1";

    ASSERT_TRUE(read("listen = '127.0.0.1:2'\n", {"listen"}));

    EXPECT_EQ(options_.listen, "127.0.0.1:1");
}

}  // namespace
}  // namespace pulseline::server
