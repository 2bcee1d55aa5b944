#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/plant/plant.hpp"
#include "db/database.hpp"

namespace pulseline::server::cli {

struct JournalDifference {
    std::int64_t journal_seq = 0;  // row of the journal
    std::string what;
};

struct JournalReport {
    std::int64_t snapshots = 0;  // replayed from
    std::int64_t rows = 0;
    std::int64_t inputs = 0;
    std::int64_t steps = 0;  // outputs taken
    std::int64_t events = 0;
    std::vector<std::string> passed_over;  // snapshots that cannot be replayed, and why
    std::optional<JournalDifference> difference;
};

/// Replays every stored snapshot to the next one or to the end, and compares what the replay gives
/// with what is stored: the next snapshot byte for byte, every event, and that none is missing.
/// Throws db::Error when the file cannot be read.
JournalReport verify_journal(db::ReadOnly& database, const plant::Plant& plant);

}  // namespace pulseline::server::cli
