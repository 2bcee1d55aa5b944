// ./dev bench motion [--only SECTION]: how fast and how well single vehicles' motion is planned. A
// table on the terminal, JSON where --benchmark_out says. The sections are listed in kSections.
// --make-reference FILE [--queries N] [--seconds S] [--seed N] --date DATE computes the lengths
// that the section manoeuvres compares with (N x S seconds of processor time; goes on where it
// stopped).
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/bench/manoeuvre_bench.hpp"
#include "tests/bench/manoeuvre_reference.hpp"
#include "tests/bench/motion_bench_control.hpp"
#include "tests/bench/motion_bench_primitives.hpp"

namespace {

using namespace pulseline::bench;

struct Section {
    const char* name;
    nlohmann::json (*measure)(bool& passed);
};
constexpr std::array kSections{Section{"primitives", measure_primitives},
                               Section{"control", measure_control},
                               Section{"manoeuvres", measure_manoeuvres}};

/// "--name value" and "--name=value".
std::map<std::string, std::string> options_from(int argc, char** argv) {
    std::map<std::string, std::string> options;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (const auto at = argument.find('='); at != std::string::npos) {
            options[argument.substr(0, at)] = argument.substr(at + 1);
        } else if (i + 1 < argc) {
            options[argument] = argv[++i];
        } else {
            options[argument] = "";
        }
    }
    return options;
}

bool known(const std::map<std::string, std::string>& options) {
    for (const auto& [name, value] : options) {
        bool fits = false;
        for (const char* option :
             {"--only", "--benchmark_out", "--benchmark_out_format", "--make-reference",
              "--queries", "--seconds", "--seed", "--date"}) {
            fits = fits || name == option;
        }
        if (fits && !value.empty()) continue;
        std::fprintf(stderr, "unknown option or missing value: %s\n", name.c_str());
        return false;
    }
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    auto options = options_from(argc, argv);
    if (!known(options)) return 2;
    const auto number = [&](const char* name, double otherwise) {
        return options.count(name) != 0 ? std::atof(options[name].c_str()) : otherwise;
    };
    if (options.count("--make-reference") != 0) {
        if (options.count("--date") == 0) {
            std::fprintf(stderr, "state the day that goes into the file: --date 2026-11-22\n");
            return 2;
        }
        make_reference(options["--make-reference"], static_cast<int>(number("--queries", 200)),
                       number("--seconds", 10),
                       static_cast<std::uint64_t>(number("--seed", 20261122)), options["--date"]);
        return 0;
    }
    const std::string only = options["--only"];
    nlohmann::json json;
    bool passed = true;
    for (const Section& section : kSections) {
        if (only.empty() || only == section.name) json[section.name] = section.measure(passed);
    }
    if (json.empty()) {
        std::fprintf(stderr, "no section %s\n", only.c_str());
        return 2;
    }
    const std::filesystem::path path(
        options.count("--benchmark_out") != 0 ? options["--benchmark_out"] : "motion.json");
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << json.dump(2) << '\n';
    std::printf("written to %s\n", path.c_str());
    return passed ? 0 : 1;
}
