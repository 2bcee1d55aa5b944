#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

// Reads every #include "..." of the sources and holds the direction of knowledge (style.md,
// layout).
namespace {

namespace fs = std::filesystem;

const std::map<std::string, int> kCoreRank = {
    {"base", 0},    {"access", 1},   {"geometry", 1},    {"plant", 2},     {"kinematics", 3},
    {"vision", 3},  {"printing", 3}, {"calibration", 4}, {"planning", 4},  {"localisation", 4},
    {"traffic", 4}, {"control", 5},  {"fleet", 5},       {"simulation", 6}};

struct Include {
    std::string from;  // "core/plant/plant.cpp"
    std::string to;    // "core/base/key.hpp"
};

std::vector<std::string> parts(const std::string& path) {
    std::vector<std::string> result;
    for (const fs::path& part : fs::path(path)) result.push_back(part.string());
    return result;
}

std::vector<Include> includes_under(const fs::path& root) {
    static const std::regex kInclude("^\\s*#\\s*include\\s*\"([^\"]+)\"");
    std::vector<Include> includes;
    for (const char* top : {"core", "api", "db", "server"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
            const std::string extension = entry.path().extension().string();
            if (!entry.is_regular_file() || (extension != ".cpp" && extension != ".hpp")) continue;
            std::ifstream in(entry.path());
            for (std::string line; std::getline(in, line);) {
                std::smatch match;
                if (std::regex_search(line, match, kInclude)) {
                    includes.push_back(
                        {fs::relative(entry.path(), root).generic_string(), match[1]});
                }
            }
        }
    }
    return includes;
}

/// What is wrong with the include; empty when nothing is.
std::string objection(const Include& include) {
    static const std::map<std::string, std::set<std::string>> kMay = {
        {"core", {"core"}},
        {"api", {"api", "core"}},
        {"db", {"db", "core"}},
        {"server", {"server", "api", "db", "core"}}};
    const auto from = parts(include.from);
    const auto to = parts(include.to);
    if (to.size() == 1) {
        // Only files made by the build have no folder in their name.
        static const std::set<std::string> kMade = {"migrations.hpp"};
        return kMade.count(to[0]) != 0 ? "" : "write the path from the top: \"core/base/key.hpp\"";
    }
    if (kMay.count(to[0]) == 0) return to[0] + " is none of core, api, db, server";
    if (kMay.at(from[0]).count(to[0]) == 0) return from[0] + " must not know " + to[0];
    if (from[0] != "core" || to[0] != "core" || from[1] == to[1]) return "";
    const auto from_rank = kCoreRank.find(from[1]);
    const auto to_rank = kCoreRank.find(to[1]);
    if (from_rank == kCoreRank.end() || to_rank == kCoreRank.end())
        return "give the folder a rank here";
    return to_rank->second < from_rank->second ? ""
                                               : "core/" + from[1] + " must not know core/" + to[1];
}

TEST(Architecture, ObjectsToWhatItShould) {
    EXPECT_NE(objection({"core/base/a.cpp", "core/plant/plant.hpp"}), "");
    EXPECT_NE(objection({"core/traffic/a.cpp", "core/planning/a.hpp"}), "");
    EXPECT_NE(objection({"core/fleet/a.cpp", "db/database.hpp"}), "");
    EXPECT_NE(objection({"api/http/a.cpp", "db/database.hpp"}), "");
    EXPECT_NE(objection({"api/http/a.cpp", "server/net.hpp"}), "");
    EXPECT_NE(objection({"db/a.cpp", "api/json/parse.hpp"}), "");
    EXPECT_NE(objection({"db/a.cpp", "error.hpp"}), "");
    EXPECT_EQ(objection({"server/a.cpp", "db/database.hpp"}), "");
    EXPECT_EQ(objection({"core/fleet/a.cpp", "core/planning/leg_planner.hpp"}), "");
    EXPECT_EQ(objection({"core/plant/a.cpp", "core/plant/plant.hpp"}), "");
}

TEST(Architecture, EveryIncludeFollowsTheDirection) {
    const auto includes = includes_under(PULSELINE_ROOT);

    EXPECT_GT(includes.size(), 200u) << "the sources were not found";
    for (const Include& include : includes) {
        const std::string wrong = objection(include);
        EXPECT_TRUE(wrong.empty()) << include.from << " includes " << include.to << ": " << wrong;
    }
}

TEST(Architecture, CoreHasNoSocketsJsonSqlThreadsOrExternalClocks) {
    static const std::regex kForbidden(
        "^\\s*#\\s*include\\s*<(nlohmann/|soci/|sqlite3|boost/asio|boost/beast|thread>|"
        "condition_variable>|future>|random_device|sys/socket)");
    static const std::regex kClock(
        "(system_clock|steady_clock|high_resolution_clock)::now|random_device");
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(PULSELINE_ROOT) / "core")) {
        if (!entry.is_regular_file()) continue;
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);) {
            EXPECT_FALSE(std::regex_search(line, kForbidden) || std::regex_search(line, kClock))
                << entry.path() << ": " << line;
        }
    }
}

}  // namespace
