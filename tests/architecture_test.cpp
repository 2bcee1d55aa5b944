#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

// Reads every #include "..." of the sources and holds the direction of knowledge, as
// ARCHITECTURE.md and core/fleet/README.md state it.
namespace {

namespace fs = std::filesystem;

/// Folders of core in the order of the table in ARCHITECTURE.md: each knows those of earlier rows.
std::map<std::string, int> core_ranks() {
    static const std::regex kRow("^\\| (`core/[^|]*) \\|.*");
    static const std::regex kFolder("`core/([^`]+)`");
    std::ifstream in(fs::path(PULSELINE_ROOT) / "ARCHITECTURE.md");
    std::map<std::string, int> ranks;
    std::smatch row;
    int rank = 0;
    for (std::string line; std::getline(in, line);) {
        if (!std::regex_match(line, row, kRow)) continue;
        const std::string folders = row[1];
        for (std::sregex_iterator it(folders.begin(), folders.end(), kFolder), end; it != end; ++it)
            ranks[(*it)[1]] = rank;
        ++rank;
    }
    return ranks;
}

/// Folders with rooms of their own, each with a table of them in its README.
const std::vector<std::string> kWithRooms = {
    "core/fleet", "core/planning", "core/vision", "core/simulation", "api/http", "server", "db"};

/// Rooms of a folder in the order of the table in its README: each knows those of earlier rows.
const std::map<std::string, int>& room_ranks(const std::string& folder) {
    static std::map<std::string, std::map<std::string, int>> known;
    auto& ranks = known[folder];
    if (!ranks.empty()) return ranks;
    static const std::regex kRow("^\\| (`[^|]*) \\|.*");
    static const std::regex kRoom("`([^`]+)`");
    std::ifstream in(fs::path(PULSELINE_ROOT) / folder / "README.md");
    std::smatch row;
    int rank = 0;
    for (std::string line; std::getline(in, line);) {
        if (!std::regex_match(line, row, kRow)) continue;
        const std::string rooms = row[1];
        for (std::sregex_iterator it(rooms.begin(), rooms.end(), kRoom), end; it != end; ++it)
            ranks.emplace((*it)[1], rank);
        ++rank;
    }
    return ranks;
}

/// The folder with rooms that a file lies in; empty: in none.
std::string folder_with_rooms(const std::string& path) {
    for (const std::string& folder : kWithRooms) {
        if (path.rfind(folder + "/", 0) == 0) return folder;
    }
    return "";
}

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

/// The room of a file: its sub-folder, or for those at the door the file itself, with or without
/// its ending, as the table has it.
std::string room_of(const std::string& folder, const std::string& path) {
    const std::string inside = path.substr(folder.size() + 1);
    const auto slash = inside.find('/');
    if (slash != std::string::npos) return inside.substr(0, slash);
    return room_ranks(folder).count(inside) != 0 ? inside : inside.substr(0, inside.rfind('.'));
}

std::string room_objection(const std::string& folder, const std::string& from,
                           const std::string& to) {
    const auto from_room = room_of(folder, from);
    const auto to_room = room_of(folder, to);
    if (from_room == to_room) return "";
    const auto& ranks = room_ranks(folder);
    const auto from_rank = ranks.find(from_room);
    const auto to_rank = ranks.find(to_room);
    if (from_rank == ranks.end() || to_rank == ranks.end())
        return "give the room a row in the README of " + folder;
    return to_rank->second < from_rank->second
               ? ""
               : folder + "/" + from_room + " must not know " + folder + "/" + to_room;
}

/// Files by name without ending, and whom each knows.
using Knows = std::map<std::string, std::set<std::string>>;

/// A circle of files that know each other; empty: there is none.
std::vector<std::string> circle(const Knows& knows) {
    std::set<std::string> done;
    std::vector<std::string> way;
    const std::function<bool(const std::string&)> leads_back = [&](const std::string& file) {
        const auto seen = std::find(way.begin(), way.end(), file);
        if (seen != way.end()) {
            way.erase(way.begin(), seen);
            return true;
        }
        if (!done.insert(file).second) return false;
        way.push_back(file);
        const auto next = knows.find(file);
        if (next != knows.end()) {
            for (const auto& known : next->second) {
                if (leads_back(known)) return true;
            }
        }
        way.pop_back();
        return false;
    };
    for (const auto& [file, known] : knows) {
        if (leads_back(file)) return way;
    }
    return {};
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
    const std::string folder = folder_with_rooms(include.from);
    if (!folder.empty() && folder == folder_with_rooms(include.to))
        return room_objection(folder, include.from, include.to);
    if (from[0] != "core" || to[0] != "core") return "";
    if (from[1] == to[1]) return "";
    static const auto kRanks = core_ranks();
    const auto from_rank = kRanks.find(from[1]);
    const auto to_rank = kRanks.find(to[1]);
    if (from_rank == kRanks.end() || to_rank == kRanks.end())
        return "give the folder a row in ARCHITECTURE.md";
    return to_rank->second < from_rank->second ? ""
                                               : "core/" + from[1] + " must not know core/" + to[1];
}

TEST(Architecture, ObjectsToWhatItShould) {
    EXPECT_NE(objection({"core/base/a.cpp", "core/plant/plant.hpp"}), "");
    EXPECT_NE(objection({"core/traffic/a.cpp", "core/planning/a.hpp"}), "");
    EXPECT_NE(objection({"core/fleet/a.cpp", "db/database.hpp"}), "");
    EXPECT_NE(objection({"api/http/a.cpp", "db/database.hpp"}), "");
    EXPECT_NE(objection({"api/http/a.cpp", "server/base/net.hpp"}), "");
    EXPECT_NE(objection({"db/a.cpp", "api/json/parse.hpp"}), "");
    EXPECT_NE(objection({"db/a.cpp", "error.hpp"}), "");
    EXPECT_EQ(objection({"server/a.cpp", "db/database.hpp"}), "");
    EXPECT_EQ(objection({"core/fleet/a.cpp", "core/planning/legs/leg_planner.hpp"}), "");
    EXPECT_EQ(objection({"core/plant/a.cpp", "core/plant/plant.hpp"}), "");
    EXPECT_NE(objection({"core/fleet/floor/a.cpp", "core/fleet/legs/a.hpp"}), "");
    EXPECT_NE(objection({"core/fleet/dispatch/a.cpp", "core/fleet/fleet.hpp"}), "");
    EXPECT_NE(objection({"core/fleet/cellar/a.cpp", "core/fleet/legs/a.hpp"}), "");
    EXPECT_NE(objection({"core/fleet/a.cpp", "core/fleet/legs/a.hpp"}), "");
    EXPECT_EQ(objection({"core/fleet/legs/a.cpp", "core/fleet/floor/a.hpp"}), "");
    EXPECT_EQ(objection({"core/fleet/views/a.cpp", "core/fleet/fleet.hpp"}), "");
    EXPECT_NE(objection({"core/onboard/a.cpp", "core/simulation/world/world.hpp"}), "");
    EXPECT_NE(objection({"core/onboard/a.cpp", "core/fleet/fleet.hpp"}), "");
    EXPECT_NE(objection({"core/planning/grid/a.cpp", "core/planning/roads/a.hpp"}), "");
    EXPECT_NE(objection({"core/planning/cellar/a.cpp", "core/planning/roads/a.hpp"}), "");
    EXPECT_NE(objection({"core/vision/search/a.cpp", "core/vision/marker_reader.hpp"}), "");
    EXPECT_EQ(objection({"core/vision/search/a.cpp", "core/vision/marker_reading.hpp"}), "");
    EXPECT_NE(objection({"core/simulation/world/a.cpp", "core/simulation/machine/a.hpp"}), "");
    EXPECT_NE(objection({"api/http/wire/a.cpp", "api/http/orders/a.hpp"}), "");
    EXPECT_NE(objection({"server/base/a.cpp", "server/runtime/a.hpp"}), "");
    EXPECT_NE(objection({"server/agent/a.cpp", "server/cli/a.hpp"}), "");
    EXPECT_NE(objection({"db/plant/a.cpp", "db/fleet/a.hpp"}), "");
    EXPECT_EQ(objection({"db/fleet/a.cpp", "db/plant/a.hpp"}), "");
}

TEST(Architecture, OmplIsInOneFileMrptInOneFolderAndOpenCvWhereImagesAre) {
    static const std::regex kOmpl("^\\s*#\\s*include\\s*<ompl/");
    static const std::regex kMrpt("^\\s*#\\s*include\\s*<mrpt/");
    static const std::regex kOpenCv("^\\s*#\\s*include\\s*<opencv2/");
    static const std::vector<std::string> kImages = {"core/vision/",
                                                     "core/calibration/",
                                                     "core/printing/",
                                                     "core/mapping/",
                                                     "core/simulation/world/",
                                                     "api/localization/",
                                                     "api/http/",
                                                     "api/plant/",
                                                     "server/"};
    std::set<std::string> ompl;
    for (const char* top : {"core", "api", "db", "server"}) {
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(PULSELINE_ROOT) / top)) {
            if (!entry.is_regular_file()) continue;
            const auto file = fs::relative(entry.path(), PULSELINE_ROOT);
            std::ifstream in(entry.path());
            for (std::string line; std::getline(in, line);) {
                if (std::regex_search(line, kOmpl)) ompl.insert(file.generic_string());
                EXPECT_TRUE(!std::regex_search(line, kMrpt) ||
                            file.generic_string().rfind("core/mapping/", 0) == 0)
                    << file;
                if (!std::regex_search(line, kOpenCv)) continue;
                EXPECT_TRUE(std::any_of(kImages.begin(), kImages.end(), [&](const auto& folder) {
                    return file.generic_string().rfind(folder, 0) == 0;
                })) << file;
            }
        }
    }
    EXPECT_EQ(ompl, std::set<std::string>{"core/planning/manoeuvre/manoeuvre_sampling.cpp"});
}

TEST(Architecture, FindsACircle) {
    EXPECT_EQ(circle({{"a", {"b", "c"}}, {"b", {"c"}}}), std::vector<std::string>{});
    EXPECT_EQ(circle({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}}),
              (std::vector<std::string>{"b", "c"}));
}

TEST(Architecture, NoFilesOfTheFleetKnowEachOtherInACircle) {
    const auto stem = [](const std::string& file) { return file.substr(0, file.rfind('.')); };
    Knows knows;
    for (const Include& include : includes_under(PULSELINE_ROOT)) {
        // The face of the fleet is given to it by those above, which its own source knows.
        if (include.from == "core/fleet/fleet.cpp") continue;
        if (include.from.rfind("core/fleet/", 0) != 0 || stem(include.from) == stem(include.to))
            continue;
        knows[stem(include.from)].insert(stem(include.to));
    }
    EXPECT_EQ(circle(knows), std::vector<std::string>{});
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
