#include "server/cli/serve_command.hpp"

#include <fmt/core.h>
#include <malloc.h>

#include <chrono>
#include <memory>
#include <set>

#include "api/plant/plant_file.hpp"
#include "core/plant/validate.hpp"
#include "server/base/config_file.hpp"
#include "server/base/descriptors.hpp"
#include "server/base/log.hpp"
#include "server/cli/exit_code.hpp"
#include "server/cli/storage.hpp"
#include "server/server.hpp"

namespace pulseline::server::cli {
namespace {

constexpr std::size_t kDescriptorsBesides = 256;  // the database, the log, threads
/// The C library gives each thread a heap of its own. What one thread takes and another gives back
/// leaves holes there that nobody fills: the process grew by megabytes an hour though it held no
/// more. Two heaps cost no measurable time (tests/load), one does.
constexpr int kHeaps = 2;

/// The stored plant; into an empty database the plant file is imported first.
Result<plant::Plant> load_plant(Storage& storage, const Options& options) {
    auto stored = storage.plant();
    if (stored) return std::move(*stored);
    if (options.plant_file.empty()) {
        return fail(Errc::kInvalid, "plant_missing",
                    "the database holds no plant yet; name a plant file with --plant");
    }
    auto plant = api::plant_file::load_plant_file(options.plant_file);
    if (!plant) return plant;
    const auto faults = plant::validate(*plant);
    if (!faults.empty()) {
        const auto& first = faults.front();
        return fail(
            Errc::kInvalid, "plant_invalid",
            fmt::format("{}: {}: {}; {} ({} faults in all, `pulseline plant validate` "
                        "lists them)",
                        options.plant_file, first.element, first.what, first.remedy, faults.size()),
            first.element);
    }
    plant->revision = storage.import_plant(*plant);
    return plant;
}

int serve(const Options& options) {
    const auto begin = std::chrono::steady_clock::now();
    mallopt(M_ARENA_MAX, kHeaps);  // before the first thread
    log::start(options.log_json);
    if (options.database.empty()) {
        fmt::print(stderr, "pulseline: name the database file with --db\n");
        return kUsage;
    }
    if (const auto sound = Server::check(options); !sound) return failed(sound.error());
    const auto descriptors = raise_descriptor_limit();
    if (const auto needed = options.limits.connections + kDescriptorsBesides;
        descriptors < needed) {
        log::warn("few_descriptors", {{"allowed", std::to_string(descriptors)},
                                      {"needed", std::to_string(needed)},
                                      {"remedy", "raise the hard limit of open files"}});
    }
    auto storage = open_storage(options.database);
    if (!storage) return failed(storage.error());
    (*storage)->keep_events(options.events_kept, std::chrono::hours(24 * options.events_kept_days));
    const auto plant = load_plant(**storage, options);
    if (!plant) return failed(plant.error());
    Server server(options,
                  {*plant, (*storage)->fleet(), (*storage)->history(), (*storage)->access()});
    if (const auto started = server.start(); !started) return failed(started.error());
    server.stop_on_signals();
    const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(
        std::chrono::steady_clock::now() - begin);
    if (!server.tls_fingerprint().empty()) {
        fmt::print("certificate SHA-256 {}\n", server.tls_fingerprint());
    }
    fmt::print("pulseline {} serves {} ready in {} ms\n", kVersion, server.url(), took.count());
    std::fflush(stdout);
    server.run();
    log::flush();
    return 0;
}

/// Options given on the command line, by their names in the configuration file.
std::set<std::string> given_options(const CLI::App& command) {
    std::set<std::string> given;
    for (const auto* option : command.get_options()) {
        if (option->count() == 0) continue;
        std::string name = option->get_single_name();
        for (char& c : name) {
            if (c == '-') c = '_';
        }
        given.insert(name == "allow_origin" ? "allow_origins" : name);
    }
    return given;
}

}  // namespace

void add_serve_command(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<Options>();
    const auto config = std::make_shared<std::string>();
    auto* serve_command = app.add_subcommand("serve", "Run the server");
    serve_command->add_option("--db", options->database, "Database file, made when missing");
    serve_command->add_option("--listen", options->listen, "Address and port");
    serve_command->add_option("--plant", options->plant_file,
                              "Plant file, imported into an empty database");
    serve_command->add_option("--tls-cert", options->tls_cert, "PEM certificate chain");
    serve_command->add_option("--tls-key", options->tls_key, "PEM key of the certificate");
    serve_command->add_flag("--tls-self-signed", options->tls_self_signed,
                            "Make a certificate; its fingerprint is printed");
    serve_command
        ->add_option(
            "--behind-proxy", options->behind_proxy,
            "Address or block (10.0.0.0/24) of a proxy in front that ends TLS; X-Forwarded "
            "headers are believed from there and nowhere else")
        ->delimiter(',');
    serve_command->add_option("--allow-origin", options->allow_origins,
                              "Further origin of pages that may sign in, exact");
    serve_command->add_option("--config", *config, "TOML file; options on the command line win");
    serve_command->add_flag("--log-json", options->log_json, "Log one JSON object a line");
    serve_command->callback([options, config, serve_command, &exit_code] {
        if (!config->empty()) {
            const auto read = read_config_file(*config, given_options(*serve_command), *options);
            if (!read) {
                exit_code = failed(read.error());
                return;
            }
        }
        exit_code = serve(*options);
    });
}

}  // namespace pulseline::server::cli
