#include <fmt/core.h>
#include <sodium.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <opencv2/core/utility.hpp>

#include "server/cli/access_commands.hpp"
#include "server/cli/calibrate_command.hpp"
#include "server/cli/exit_code.hpp"
#include "server/cli/journal_command.hpp"
#include "server/cli/locate_command.hpp"
#include "server/cli/markers_commands.hpp"
#include "server/cli/plan_command.hpp"
#include "server/cli/plant_commands.hpp"
#include "server/cli/serve_command.hpp"
#include "server/server.hpp"

int main(int argc, char** argv) {
    using namespace pulseline::server;
    std::signal(SIGPIPE, SIG_IGN);
    // A file over the size limit is a write that fails, not a death.
    std::signal(SIGXFSZ, SIG_IGN);
    // Images are too small to share, and the server's other threads need the other cores.
    cv::setNumThreads(1);
    if (sodium_init() < 0) {
        fmt::print(stderr, "pulseline: libsodium cannot start\n");
        return cli::kFailed;
    }
    CLI::App app("Pulseline: fleet service for vehicles between assembly stations");
    app.require_subcommand(1);
    int exit_code = 0;
    cli::add_serve_command(app, exit_code);
    cli::add_plan_command(app, exit_code);
    cli::add_plant_commands(app, exit_code);
    cli::add_access_commands(app, exit_code);
    cli::add_locate_command(app, exit_code);
    cli::add_calibrate_command(app, exit_code);
    cli::add_markers_commands(app, exit_code);
    cli::add_journal_command(app, exit_code);
    app.add_subcommand("version", "Print the version")->callback([] {
        fmt::print("pulseline {}\n", kVersion);
    });
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : cli::kUsage;
    } catch (const std::exception& e) {
        fmt::print(stderr, "pulseline: {}\n", e.what());
        return cli::kFailed;
    }
    return exit_code;
}
