#include "server/base/config_file.hpp"

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

TEST_F(ConfigFile, RefusesAControlCharacterWithItsLine) {
    for (const char character : {'\0', '\x01', '\x1b', '\x7f'}) {
        const auto refused = read("db = 'x'\nlisten = " + std::string(1, character) + "\n");

        ASSERT_FALSE(refused) << int(character);
        EXPECT_NE(refused.error().what.find(".toml:2: there is a control character; remove it"),
                  std::string::npos)
            << refused.error().what;
    }
}

TEST_F(ConfigFile, RefusesCharactersBeyondAsciiWithALineAndAWayToWriteThem) {
    const auto refused = read("# Halle\ndb = x\u00fc\n");

    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().what.find(".toml:2: there is a character beyond ASCII"),
              std::string::npos)
        << refused.error().what;
    EXPECT_NE(refused.error().what.find("\\u00e4"), std::string::npos);
    ASSERT_TRUE(read("db = \"/srv/M\\u00fcller.db\"\n"));
    EXPECT_EQ(options_.database, "/srv/M\u00fcller.db");
}

TEST_F(ConfigFile, TakesCommentLinesInAnyLanguageAndTheMarkOfAnEditor) {
    ASSERT_TRUE(
        read("\xEF\xBB\xBF# Gr\u00f6\u00dfe der Halle\r\n\t# und mehr \x01\r\n"
             "db = 'x'\r\n"));
    const auto refused = read("# \u00e4\n\nlisen = 'x'\n");

    EXPECT_EQ(options_.database, "x");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().what.find(":3: unknown key"), std::string::npos);
}

TEST_F(ConfigFile, RefusesWhatTheParserDoesNotExpectItself) {
    // Each is an assertion that fails inside toml++ 3.3.
    EXPECT_FALSE(read("[|limits]\n"));
    EXPECT_FALSE(read("[limits]\nconnections = 3\n[=]\n"));
}

TEST_F(ConfigFile, RefusesAFileThatIsTooLongOrNotThere) {
    EXPECT_FALSE(read("db = 'x'\n" + std::string(17'000, '\n')));
    std::string nested = "a";
    for (int i = 0; i < 7'000; ++i) nested += ".a";
    EXPECT_FALSE(read(nested + " = 1\n"));
    EXPECT_FALSE(read_config_file("/nowhere/server.toml", {}, options_));
}

TEST_F(ConfigFile, GivesWayToTheCommandLine) {
    options_.listen = "127.0.0.1:1";

    ASSERT_TRUE(read("listen = '127.0.0.1:2'\n", {"listen"}));

    EXPECT_EQ(options_.listen, "127.0.0.1:1");
}

}  // namespace
}  // namespace pulseline::server
