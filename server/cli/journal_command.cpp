#include "server/cli/journal_command.hpp"

#include <fmt/ostream.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "db/plant/plant_store.hpp"
#include "server/cli/journal_verify.hpp"

namespace pulseline::server::cli {
namespace {

void print_json(const JournalReport& report, std::ostream& out) {
    nlohmann::ordered_json object = {
        {"snapshots", report.snapshots}, {"rows", report.rows},
        {"inputs", report.inputs},       {"steps", report.steps},
        {"events", report.events},       {"passed_over", report.passed_over},
        {"difference", nullptr}};
    if (const auto& found = report.difference) {
        object["difference"] = {{"journal_seq", found->journal_seq}, {"what", found->what}};
    }
    out << object.dump() << '\n';
}

void print_text(const JournalReport& report, std::ostream& out) {
    for (const auto& why : report.passed_over) fmt::print(out, "passed over: {}\n", why);
    fmt::print(out,
               "replayed {} inputs ({} rows, {} steps) from {} snapshots, compared {} events\n",
               report.inputs, report.rows, report.steps, report.snapshots, report.events);
    if (report.difference) {
        fmt::print(out, "first difference at journal row {}: {}\n", report.difference->journal_seq,
                   report.difference->what);
    } else if (report.snapshots == 0) {
        fmt::print(out, "there is no snapshot to replay from\n");
    } else {
        fmt::print(out, "no difference\n");
    }
}

}  // namespace

int verify_journal(const std::string& path, bool json, std::ostream& out) {
    try {
        db::ReadOnly database(path);
        const auto plant = db::load_plant(database);
        if (!plant) {
            fmt::print(stderr, "pulseline: {}: no plant was imported, so nothing ran\n", path);
            return kJournalUnreadable;
        }
        const JournalReport report = verify_journal(database, *plant);
        json ? print_json(report, out) : print_text(report, out);
        return report.difference ? kJournalDiffers : kJournalSame;
    } catch (const std::exception& e) {
        fmt::print(stderr, "pulseline: {}\n", e.what());
        return kJournalUnreadable;
    }
}

void add_journal_command(CLI::App& app, int& exit_code) {
    auto* journal = app.add_subcommand("journal", "The fleet core's inputs");
    journal->require_subcommand(1);
    auto* verify = journal->add_subcommand(
        "verify", "Replay them from every snapshot and compare with what is stored");
    const auto path = std::make_shared<std::string>();
    const auto json = std::make_shared<bool>(false);
    verify->add_option("--db", *path, "Database file")->required();
    verify->add_flag("--json", *json, "One JSON object");
    verify->callback(
        [path, json, &exit_code] { exit_code = verify_journal(*path, *json, std::cout); });
}

}  // namespace pulseline::server::cli
