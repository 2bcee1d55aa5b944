// Repeats a paper's experiment in simulation and prints its table beside the paper's.
// usage: experiments [NAME] [--seed N] [--runs N]; all of them without a name
#include "tests/experiments/experiments.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <opencv2/core/utility.hpp>

int main(int argc, char** argv) {
    using namespace pulseline::experiments;
    CLI::App app("The papers' experiments, repeated in simulation");
    std::string name = "all";
    Options options;
    options.folder = PULSELINE_EXPERIMENTS;
    app.add_option("NAME", name)
        ->check(CLI::IsMember({"all", "igps", "landmark-accuracy", "navigation", "segments",
                               "self-positioning", "stop-adjustment", "stops"}));
    app.add_option("--seed", options.seed);
    app.add_option("--runs", options.runs)->check(CLI::Range(1, 100'000));
    app.add_option("--stretch", options.stretch,
                   "of the navigation: codes so many times farther apart than computed")
        ->check(CLI::Range(1.0, 100.0));
    app.add_option("--errors", options.errors, "of stops and navigation: nominal, kind, harsh")
        ->check(CLI::IsMember({"nominal", "kind", "harsh"}));
    app.add_option("--spoil", options.spoil_mm, "mm that each measured stop is off unnoticed");
    CLI11_PARSE(app, argc, argv);
    // Beside the program, which lies in the build tree.
    const auto plots =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "experiments-plots";
    std::filesystem::create_directories(plots);
    options.plots = plots.string();
    cv::setNumThreads(1);
    bool good = true;
    if (name == "all" || name == "igps") good &= igps(options);
    if (name == "all" || name == "landmark-accuracy") good &= landmark_accuracy(options);
    if (name == "all" || name == "navigation") good &= navigation(options);
    if (name == "all" || name == "segments") good &= segments(options);
    if (name == "all" || name == "self-positioning") good &= self_positioning(options);
    if (name == "all" || name == "stop-adjustment") good &= stop_adjustment(options);
    if (name == "all" || name == "stops") good &= stops(options);
    return good ? 0 : 1;
}
