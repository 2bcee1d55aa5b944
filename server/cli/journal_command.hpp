#pragma once

#include <CLI/CLI.hpp>
#include <iosfwd>
#include <string>

namespace pulseline::server::cli {

constexpr int kJournalSame = 0;
constexpr int kJournalDiffers = 1;
constexpr int kJournalUnreadable = 2;

/// Replays the journal of a database and prints what came of it. Opens it for reading only, also
/// beside a running server.
int verify_journal(const std::string& database, bool json, std::ostream& out);

/// `pulseline journal verify`.
void add_journal_command(CLI::App& app, int& exit_code);

}  // namespace pulseline::server::cli
